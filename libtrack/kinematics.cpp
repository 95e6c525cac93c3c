// SPDX-License-Identifier: MIT
#include "libtrack/kinematics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libtrack/error.h"
#include "libtrack/nan.h"

namespace swarmfit {
namespace {

std::vector<double> gaussian(double sigma) {
  const auto reach = static_cast<std::size_t>(std::ceil(4 * sigma));
  std::vector<double> weight(reach + 1);
  for (std::size_t k = 0; k <= reach; ++k) {
    const double u = static_cast<double>(k) / sigma;
    weight[k] = std::exp(-0.5 * u * u);
  }
  return weight;
}

// One unbroken run of one individual.
void smooth_run(const Rows& in, Rows& out, std::span<const Index> run, const std::vector<double>& weight) {
  const auto n = static_cast<Index>(run.size()), reach = static_cast<Index>(weight.size()) - 1;
  const auto row = [&](Index i) { return run[static_cast<std::size_t>(i)]; };
  for (Index i = 0; i < n; ++i) {
    double total = 0, sum[3] = {0, 0, 0};
    for (Index j = std::max<Index>(0, i - reach); j <= std::min(n - 1, i + reach); ++j) {
      const double w = weight[static_cast<std::size_t>(std::abs(i - j))];
      total += w;
      for (Index axis = 0; axis < 3; ++axis) sum[axis] += w * in(row(j), axis);
    }
    for (Index axis = 0; axis < 3; ++axis) out(row(i), axis) = sum[axis] / total;
  }
}

Rows smoothed(const Tracks& tracks, const Rows& in, const std::vector<double>& weight) {
  Rows out(in.rows(), 3);
  if (in.rows() > 0) for_each_segment(tracks, 1, [&](std::span<const Index> run) { smooth_run(in, out, run, weight); });
  return out;
}

}  // namespace

Rows forward_velocity(const Tracks& tracks) {
  Rows out = Rows::Constant(tracks.rows(), 3, kNaN);
  const auto next = tracks.next();
  for (Index axis = 0; axis < 3; ++axis) {
    for (Index row = 0; row < tracks.rows(); ++row) {
      const Index after = next[static_cast<std::size_t>(row)];
      if (after >= 0) out(row, axis) = (tracks.pos()(after, axis) - tracks.pos()(row, axis)) / tracks.dt();
    }
  }
  return out;
}

Tracks smooth(const Tracks& tracks, double sigma_frames) {
  if (!(sigma_frames >= 0) || !std::isfinite(sigma_frames))
    throw InputError(fmt::format("`smooth`: {} is not allowed; expected a number of frames, at least 0", sigma_frames));
  if (sigma_frames == 0) return tracks;
  const auto weight = gaussian(sigma_frames);
  TrackColumns columns = tracks.columns();
  columns.pos = smoothed(tracks, tracks.pos(), weight);
  columns.vel = smoothed(tracks, tracks.vel(), weight);
  columns.acc = smoothed(tracks, tracks.acc(), weight);
  TrackMeta meta = tracks.meta();
  meta.from.notes.push_back(fmt::format("positions were smoothed by a Gaussian of {:.3g} frames", sigma_frames));
  return Tracks(std::move(columns), std::move(meta));
}

}  // namespace swarmfit
