// SPDX-License-Identifier: MIT
#include "reports/recording/summary_words.h"

#include <fmt/format.h>

#include "reports/comparison/words.h"
#include "reports/write/number.h"
#include "reports/write/unit_text.h"

namespace swarmfit {
namespace {

std::string count_of(std::size_t n) { return counted(static_cast<std::int64_t>(n)); }

std::vector<std::string> quantile_row(const std::string& what, const Quantiles& q, const std::string& unit, const std::string& note = "") {
  return {what,
          brief(q.median, 3),
          brief(q.q05, 3) + " – " + brief(q.q95, 3),
          brief(q.min, 3) + " – " + brief(q.max, 3),
          brief(q.mean, 3),
          brief(q.sd, 3),
          unit,
          note};
}

}  // namespace

TextRows contents_rows(const TrackMeta& meta, const Summary& s) {
  TextRows rows;
  rows.push_back({"tracks", count_of(s.tracks),
                  fmt::format("in {} unbroken segments; {} with {} missing frames", count_of(s.segments),
                              counted(static_cast<std::int64_t>(s.gaps), "gap"), count_of(s.missing_frames))});
  rows.push_back({"frames", count_of(s.frames),
                  fmt::format("numbers {} to {}, {} s at {} Hz", s.first_frame, s.last_frame, brief(s.duration), brief(1 / meta.dt))});
  rows.push_back({"observations", counted(s.rows), ""});
  for (int axis = 0; axis < meta.dims; ++axis)
    rows.push_back(
        {std::string("range of ") + "xyz"[axis], "", fmt::format("{} to {} {}", brief(s.lower[axis]), brief(s.upper[axis]), meta.unit)});
  return rows;
}

TextRows quantile_rows(const TrackMeta& meta, const Summary& s) {
  const auto outliers = [](std::size_t n) { return n == 0 ? std::string() : counted(static_cast<std::int64_t>(n), "outlier"); };
  return {{"", "median", "5 – 95 %", "min – max", "mean", "sd", "", ""},
          quantile_row("individuals", s.individuals, ""),
          quantile_row("frames per track", s.track_length, ""),
          quantile_row("frames unbroken", s.segment_length, ""),
          quantile_row("speed", s.speed, metric_unit(kSpeed, meta.unit), outliers(s.speed_outliers)),
          quantile_row("acceleration", s.acceleration, metric_unit(kAcceleration, meta.unit), outliers(s.acceleration_outliers)),
          quantile_row("nearest neighbour", s.nearest, meta.unit),
          quantile_row("rms radius", s.extent, meta.unit),
          quantile_row("polarisation", s.polarisation, ""),
          quantile_row("milling", s.milling, "")};
}

std::string localisation_words(const TrackMeta& meta, const Localisation& l) {
  if (l.samples == 0) return "Measurement error: not known, the tracks are too short.";
  std::string sigma;
  for (int axis = 0; axis < meta.dims; ++axis) sigma += fmt::format("{}{} {}", axis > 0 ? ", " : "", "xyz"[axis], rounded(l.sigma[axis]));
  if (l.rounding) return fmt::format("Measurement error: no more than the rounding of the file ({} {}).", sigma, meta.unit);
  const std::string caveat =
      l.white ? "" : " (not independent from frame to frame: the positions were smoothed, or the motion itself is this rough)";
  const auto share = [](double of) { return of < 1e-3 ? "less than 0.1 %" : percent(of); };
  return fmt::format("Measurement error: {} {}{}. It explains {} of the squared median acceleration and {} of the squared median jerk.",
                     sigma, meta.unit, caveat, share(l.acceleration_share), share(l.jerk_share));
}

std::string suspicion_words(const Suspicion& s) {
  return fmt::format("{}: {}{}", s.what, s.message, s.examples.empty() ? "" : " (" + s.examples + ')');
}

}  // namespace swarmfit
