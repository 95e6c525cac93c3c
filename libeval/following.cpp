// SPDX-License-Identifier: MIT
#include "libeval/following.h"

#include <algorithm>
#include <cmath>

namespace swarmfit {

Following following(const Tracks& tracks, std::span<const FrameRange> frames, const Curve& curve, double reach) {
  constexpr std::size_t places = 200;
  const auto along = places_along(curve, places);
  const Rows& pos = tracks.pos();
  double distance = 0, covered = 0;
  Index rows = 0;
  for (const FrameRange& frame : frames) {
    const auto near = [&](const Eigen::Array3d& place) {
      for (Index row = frame.first; row < frame.first + frame.count; ++row)
        if ((pos.row(row).transpose() - place).square().sum() < reach * reach) return true;
      return false;
    };
    for (Index row = frame.first; row < frame.first + frame.count; ++row) distance += distance_to(curve, pos.row(row).transpose());
    covered += static_cast<double>(std::count_if(along.begin(), along.end(), near));
    rows += frame.count;
  }
  if (rows == 0) return {};
  return {distance / static_cast<double>(rows), covered / static_cast<double>(places * frames.size())};
}

}  // namespace swarmfit
