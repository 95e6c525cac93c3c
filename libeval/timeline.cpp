// SPDX-License-Identifier: MIT
#include "libeval/timeline.h"

#include <algorithm>

#include "libtrack/quantile.h"

namespace swarmfit {
namespace {

constexpr std::int64_t kBins = 120;
constexpr double kJump = 20;  // median steps

}  // namespace

Timeline timeline(const Tracks& tracks) {
  Timeline out;
  if (tracks.frames().empty()) return out;
  out.first = tracks.frames().front().number;
  const std::int64_t frames = tracks.frames().back().number - out.first + 1;
  out.stride = (frames + kBins - 1) / kBins;
  const auto bins = static_cast<std::size_t>((frames + out.stride - 1) / out.stride);
  out.seen.assign(bins, 0), out.missing.assign(bins, 0), out.jumps.assign(bins, 0);
  const auto bin = [&](std::int64_t frame) { return static_cast<std::size_t>((frame - out.first) / out.stride); };
  for (const FrameRange& f : tracks.frames()) out.seen[bin(f.number)] += static_cast<double>(f.count);
  std::vector<double> steps;
  std::vector<std::size_t> when;
  for (std::uint32_t t = 0; t < tracks.track_count(); ++t) {
    const auto rows = tracks.rows_of(t);
    for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
      const std::int64_t now = tracks.frame()[static_cast<std::size_t>(rows[k])],
                         later = tracks.frame()[static_cast<std::size_t>(rows[k + 1])];
      for (std::int64_t lost = now + 1; lost < later; ++lost) ++out.missing[bin(lost)];
      if (tracks.next()[static_cast<std::size_t>(rows[k])] < 0) continue;
      steps.push_back((tracks.pos().row(rows[k + 1]) - tracks.pos().row(rows[k])).matrix().norm());
      when.push_back(bin(later));
    }
  }
  for (std::size_t k = 0; k < bins; ++k) {
    const double length = static_cast<double>(std::min(out.stride, frames - static_cast<std::int64_t>(k) * out.stride));
    out.seen[k] /= length, out.missing[k] /= length;
  }
  if (steps.empty()) return out;
  const double usual = median(steps);
  for (std::size_t k = 0; k < steps.size(); ++k)
    if (usual > 0 && steps[k] > kJump * usual) ++out.jumps[when[k]];
  return out;
}

}  // namespace swarmfit
