// SPDX-License-Identifier: MIT
#include "libeval/nearness.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "libtrack/kinematics.h"
#include "libtrack/nan.h"
#include "libtrack/quantile.h"

namespace swarmfit {
namespace {

constexpr std::size_t kPoints = 10;    // at which paths are compared, evenly spaced
constexpr double kLongestShare = 0.1;  // of the recording
constexpr double kDecayed = 0.36787944117144233;

using Path = std::array<double, 3 * kPoints>;  // displacements from the first place

// Pieces of so many frames, at most `most` of them, evenly spread over all there are.
std::vector<Path> paths_of(const Tracks& tracks, std::int64_t frames, std::size_t most) {
  std::vector<std::pair<std::span<const Index>, std::size_t>> pieces;  // a run and where in it a piece begins
  const auto length = static_cast<std::size_t>(frames);
  for_each_segment(tracks, frames + 1, [&](std::span<const Index> rows) {
    for (std::size_t k = 0; k + length < rows.size(); ++k) pieces.emplace_back(rows, k);
  });
  std::vector<Path> out;
  const std::size_t count = std::min(most, pieces.size());
  for (std::size_t n = 0; n < count; ++n) {
    const auto& [rows, first] = pieces[n * pieces.size() / count];
    Path path;
    for (std::size_t p = 0; p < kPoints; ++p) {
      const Index row = rows[first + (p + 1) * length / kPoints];
      for (Index axis = 0; axis < 3; ++axis)
        path[3 * p + static_cast<std::size_t>(axis)] = tracks.pos()(row, axis) - tracks.pos()(rows[first], axis);
    }
    out.push_back(path);
  }
  return out;
}

double nearest(const Path& path, const std::vector<Path>& library) {
  double best = INFINITY;
  for (const Path& other : library) {
    double sum = 0;
    for (std::size_t k = 0; k < path.size() && sum < best; ++k) sum += (path[k] - other[k]) * (path[k] - other[k]);
    best = std::min(best, sum);
  }
  return std::sqrt(best / static_cast<double>(kPoints));
}

// Velocities less the mean of their frame; NaN where there is none.
Rows fluctuations(const Tracks& tracks) {
  Rows velocity = forward_velocity(tracks);
  for (const FrameRange& frame : tracks.frames()) {
    Eigen::Array<double, 1, 3> sum = Eigen::Array<double, 1, 3>::Zero();
    int count = 0;
    for (Index row = frame.first; row < frame.first + frame.count; ++row)
      if (std::isfinite(velocity(row, 0))) sum += velocity.row(row), ++count;
    for (Index row = frame.first; row < frame.first + frame.count && count > 1; ++row) velocity.row(row) -= sum / count;
  }
  return velocity;
}

double autocovariance(const std::vector<std::vector<Index>>& runs, const Rows& v, std::size_t lag) {
  double sum = 0, count = 0;
  for (const auto& rows : runs)
    for (std::size_t k = 0; k + lag < rows.size(); ++k) {
      const double product = (v.row(rows[k]) * v.row(rows[k + lag])).sum();
      if (std::isfinite(product)) sum += product, ++count;
    }
  return count > 0 ? sum / count : kNaN;
}

}  // namespace

double distance_to_nearest(const Tracks& tracks, const Tracks& library, std::int64_t frames) {
  const auto paths = paths_of(tracks, frames, kPaths), known = paths_of(library, frames, kLibrary);
  if (paths.empty() || known.empty()) return kNaN;
  std::vector<double> distances;
  for (const Path& path : paths) distances.push_back(nearest(path, known));
  return median(std::move(distances));
}

double correlation_time(const Tracks& tracks) {
  const Rows v = fluctuations(tracks);
  std::vector<std::vector<Index>> runs;
  for_each_segment(tracks, 2, [&](std::span<const Index> rows) { runs.emplace_back(rows.begin(), rows.end() - 1); });
  const auto frames = static_cast<double>(tracks.frames().back().number - tracks.frames().front().number + 1);
  const auto longest = static_cast<std::size_t>(kLongestShare * frames);
  const double variance = autocovariance(runs, v, 0);
  for (std::size_t lag = 1; lag < longest; ++lag)
    if (!(autocovariance(runs, v, lag) > kDecayed * variance)) return static_cast<double>(lag) * tracks.dt();
  return static_cast<double>(longest) * tracks.dt();
}

}  // namespace swarmfit
