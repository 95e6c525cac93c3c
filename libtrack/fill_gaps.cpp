// SPDX-License-Identifier: MIT
#include "libtrack/fill_gaps.h"

#include <fmt/format.h>

#include <algorithm>

#include "libtrack/interpolate.h"

namespace swarmfit {
void fill_gaps(TrackColumns& columns, int most, std::vector<std::string>& notes) {
  std::vector<Between> sources;
  TrackColumns out;
  std::size_t gaps = 0;
  const std::size_t n = columns.frame.size();
  for (std::size_t i = 0; i < n; ++i) {
    const auto add = [&](std::int64_t frame, double part) {
      sources.push_back({static_cast<Index>(i), part});
      out.track.push_back(columns.track[i]);
      out.frame.push_back(frame);
      if (!columns.kind.empty()) out.kind.push_back(columns.kind[i]);
    };
    add(columns.frame[i], 0);
    if (i + 1 == n || columns.track[i + 1] != columns.track[i]) continue;
    const std::int64_t from = columns.frame[i], to = columns.frame[i + 1];
    if (to - from < 2 || to - from - 1 > most || !one_take(columns.episodes, from, to)) continue;
    ++gaps;
    for (auto frame = from + 1; frame < to; ++frame) add(frame, static_cast<double>(frame - from) / static_cast<double>(to - from));
  }
  const std::size_t added = sources.size() - n;
  notes.push_back(fmt::format("{} missing row{} in {} gap{} of at most {} frames were filled by linear interpolation", added,
                              added == 1 ? "" : "s", gaps, gaps == 1 ? "" : "s", most));
  columns.pos = interpolated(columns.pos, sources);
  columns.vel = interpolated(columns.vel, sources);
  columns.acc = interpolated(columns.acc, sources);
  columns.track = std::move(out.track);
  columns.frame = std::move(out.frame);
  columns.kind = std::move(out.kind);
}

}  // namespace swarmfit
