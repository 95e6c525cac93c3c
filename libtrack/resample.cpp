// SPDX-License-Identifier: MIT
#include "libtrack/resample.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libtrack/error.h"
#include "libtrack/interpolate.h"

namespace swarmfit {
namespace {

constexpr double kMostRows = 1e6, kMostPerRow = 100;  // of the result
constexpr double kJoined = 1.5;                       // of the usual interval: jitter, but no missed frame
constexpr double kSame = 1e-9;                        // of a frame: the same moment

bool same_track(const TrackColumns& c, std::size_t i) { return i + 1 < c.track.size() && c.track[i + 1] == c.track[i]; }

// Old frames between two rows of one individual, as is usual; 0: nobody is seen twice.
double usual_step(const TrackColumns& c) {
  std::vector<double> steps;
  for (std::size_t i = 0; i < c.frame.size(); ++i)
    if (same_track(c, i)) steps.push_back(static_cast<double>(c.frame[i + 1] - c.frame[i]));
  if (steps.empty()) return 0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>((steps.size() - 1) / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

}  // namespace

void resample(TrackColumns& columns, TrackMeta& meta, double hz) {
  const double ratio = meta.dt * hz, usual = usual_step(columns), longest = std::max(1 / ratio, kJoined * usual) + kSame;
  std::vector<Between> sources;
  TrackColumns out;
  std::size_t holes = 0;
  const auto add = [&](std::size_t i, double part, std::int64_t frame) {
    if (!out.track.empty() && out.track.back() == columns.track[i] && out.frame.back() == frame) return;
    if (static_cast<double>(sources.size()) > kMostRows + kMostPerRow * static_cast<double>(columns.frame.size()))
      throw InputError(fmt::format("`resample` {:.6g}: that makes more than {:g} rows of each; expected a lower rate", hz, kMostPerRow));
    sources.push_back({static_cast<Index>(i), part});
    out.track.push_back(columns.track[i]);
    out.frame.push_back(frame);
    if (!columns.kind.empty()) out.kind.push_back(columns.kind[i]);
  };
  for (std::size_t i = 0; i < columns.frame.size(); ++i) {
    const double here = static_cast<double>(columns.frame[i]) * ratio;
    if (const double frame = std::round(here); std::abs(frame - here) <= kSame * std::max(1.0, std::abs(here)))
      add(i, 0, static_cast<std::int64_t>(frame));
    if (!same_track(columns, i)) continue;
    const auto steps = static_cast<double>(columns.frame[i + 1] - columns.frame[i]);
    if (steps > longest || !one_take(columns.episodes, columns.frame[i], columns.frame[i + 1])) {
      ++holes;
      continue;
    }
    for (double frame = std::ceil(here); frame < here + steps * ratio; ++frame) {
      const double part = (frame - here) / (steps * ratio);
      if (part > kSame && part < 1 - kSame) add(i, part, static_cast<std::int64_t>(frame));
    }
  }
  if (sources.empty())
    throw InputError(fmt::format("`resample` {:.6g}: no individual is seen often enough for it; expected a lower rate", hz));
  meta.from.notes.push_back(
      fmt::format("resampled to {:.6g} frames per second by linear interpolation: {} rows of {}; {} hole{} of more than {:.4g} s were left",
                  hz, sources.size(), columns.frame.size(), holes, holes == 1 ? "" : "s", longest * meta.dt));
  for (auto& start : columns.episodes) start = static_cast<std::int64_t>(std::ceil(static_cast<double>(start) * ratio));
  columns.pos = interpolated(columns.pos, sources);
  columns.vel = interpolated(columns.vel, sources);
  columns.acc = interpolated(columns.acc, sources);
  columns.track = std::move(out.track);
  columns.frame = std::move(out.frame);
  columns.kind = std::move(out.kind);
  meta.dt = 1 / hz;
}

}  // namespace swarmfit
