// SPDX-License-Identifier: MIT
#include "libeval/centre.h"

namespace swarmfit {

std::vector<Eigen::Array3d> group_path(const Tracks& tracks) {
  std::vector<Eigen::Array3d> path;
  Eigen::Array3d here = Eigen::Array3d::Zero();
  for (const FrameRange& frame : tracks.frames()) {
    path.push_back(here);
    Eigen::Array3d step = Eigen::Array3d::Zero();
    double count = 0;
    for (Index row = frame.first; row < frame.first + frame.count; ++row) {
      const Index next = tracks.next()[static_cast<std::size_t>(row)];
      if (next < 0) continue;
      step += (tracks.pos().row(next) - tracks.pos().row(row)).transpose();
      ++count;
    }
    if (count > 1) here += step / count;
  }
  return path;
}

std::vector<Eigen::Array3d> centroids(const Tracks& tracks) {
  std::vector<Eigen::Array3d> out;
  for (const FrameRange& frame : tracks.frames()) {
    Eigen::Array3d sum = Eigen::Array3d::Zero();
    for (Index row = frame.first; row < frame.first + frame.count; ++row) sum += tracks.pos().row(row).transpose();
    out.emplace_back(sum / static_cast<double>(frame.count));
  }
  return out;
}

}  // namespace swarmfit
