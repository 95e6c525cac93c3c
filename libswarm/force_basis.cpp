// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <vector>

#include "libswarm/force_law.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

constexpr double kQuantiles[] = {0.02, 0.1, 0.25, 0.45, 0.7, 0.98};  // of distances of pairs, for knots
constexpr double kCommon = 0.99;                                     // of speeds and distances

double at_quantile(std::vector<double> values, double q) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

Array3d place_of(const Tracks& tracks, Index row) { return tracks.pos().row(row).transpose(); }

// Every how many frames pairs are looked at.
std::size_t stride(const Tracks& tracks) { return std::max<std::size_t>(1, tracks.frames().size() / 100); }

std::vector<double> pair_distances(const Tracks& tracks) {
  std::vector<double> out;
  for (std::size_t f = 0; f < tracks.frames().size(); f += stride(tracks)) {
    const FrameRange& frame = tracks.frames()[f];
    const Index some = std::max<Index>(1, frame.count / 100);
    for (Index i = 0; i < frame.count; i += some)
      for (Index j = i + 1; j < frame.count; ++j) {
        const double d = std::sqrt((place_of(tracks, frame.first + i) - place_of(tracks, frame.first + j)).square().sum());
        if (d > 0) out.push_back(d);
      }
  }
  return out;
}

}  // namespace

ForceBasis force_basis(const Tracks& recording) {
  ForceBasis out;
  out.dims = recording.dims();
  for (Index row = 0; row < recording.rows(); ++row) out.centre += place_of(recording, row);
  if (recording.rows() > 0) out.centre /= static_cast<double>(recording.rows());
  std::vector<double> speeds, distances;
  for (Index row = 0; row < recording.rows(); ++row) {
    distances.push_back(std::sqrt((place_of(recording, row) - out.centre).square().sum()));
    const Index next = recording.next()[static_cast<std::size_t>(row)];
    if (next >= 0) speeds.push_back(std::sqrt((place_of(recording, next) - place_of(recording, row)).square().sum()) / recording.dt());
  }
  if (!speeds.empty()) out.top_speed = at_quantile(std::move(speeds), kCommon);
  if (!distances.empty()) out.reach = at_quantile(std::move(distances), kCommon);
  if (const auto pairs = pair_distances(recording); !pairs.empty())
    for (const double q : kQuantiles)
      if (const double knot = at_quantile(pairs, q); out.knots.empty() || knot > out.knots.back()) out.knots.push_back(knot);
  if (out.knots.size() < 2) out.knots.clear();
  return out;
}

}  // namespace swarmfit
