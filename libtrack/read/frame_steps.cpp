// SPDX-License-Identifier: MIT
#include "libtrack/read/frame_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace swarmfit {
namespace {

// Every individual in every second frame, say, but some in the even and some in the odd ones.
void note_phases(const TrackColumns& columns, TrackMeta& meta) {
  std::vector<std::int64_t> last(columns.names.size(), 0), step(columns.names.size(), 0);
  std::vector<bool> seen(columns.names.size(), false);
  for (std::size_t i = 0; i < columns.frame.size(); ++i) {
    const auto k = columns.track[i];
    if (seen[k]) step[k] = std::gcd(step[k], columns.frame[i] - last[k]);
    seen[k] = true;
    last[k] = columns.frame[i];
  }
  std::int64_t common = 0;
  for (const auto s : step) common = std::gcd(common, s);
  if (common < 2) return;
  meta.from.notes.push_back(fmt::format(
      "every individual is seen in every {}. frame only, but not all in the same frames: no two of its rows are one frame apart, "
      "and all are gaps (--fill-gaps {} closes them)",
      common, common - 1));
}

}  // namespace

void merge_steps(TrackColumns& columns, TrackMeta& meta) {
  const auto [low, high] = std::minmax_element(columns.frame.begin(), columns.frame.end());
  const std::int64_t first = *low;
  std::int64_t step = 0;
  for (const auto f : columns.frame) {
    step = std::gcd(step, f - first);
    if (step == 1) return note_phases(columns, meta);
  }
  if (step == 0 || *high - first < 3 * step || !columns.episodes.empty()) return;
  const std::int64_t offset = ((first % step) + step) % step;
  for (auto& f : columns.frame) f = (f - offset) / step;
  meta.t0 += static_cast<double>(offset) * meta.dt;
  meta.dt *= static_cast<double>(step);
  meta.from.notes.push_back(
      fmt::format("frame numbers advance in steps of {0}: they were divided by {0}, one step being {1:.6g} s", step, meta.dt));
}

}  // namespace swarmfit
