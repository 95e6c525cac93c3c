// SPDX-License-Identifier: MIT
// What is in a recording, for the terminal.
#include <fmt/format.h>

#include "reports/number.h"
#include "reports/sparkline.h"
#include "reports/terminal.h"
#include "reports/terminal_parts.h"
#include "reports/words.h"

namespace swarmfit {

using namespace terminal;

namespace {

std::string count_of(std::size_t n) { return counted(static_cast<std::int64_t>(n)); }

TextTable contents_table(const TrackMeta& meta, const Summary& s, TextStyle style) {
  TextTable t({Align::left, Align::right, Align::left}, style);
  t.row({"tracks", count_of(s.tracks),
         fmt::format("in {} unbroken segments; {} with {} missing frames", count_of(s.segments),
                     counted(static_cast<std::int64_t>(s.gaps), "gap"), count_of(s.missing_frames))});
  t.row({"frames", count_of(s.frames),
         fmt::format("numbers {} to {}, {} s at {} Hz", s.first_frame, s.last_frame, brief(s.duration), brief(1 / meta.dt))});
  t.row({"observations", counted(s.rows), ""});
  for (int axis = 0; axis < meta.dims; ++axis)
    t.row({std::string("range of ") + "xyz"[axis], "", fmt::format("{} to {} {}", brief(s.lower[axis]), brief(s.upper[axis]), meta.unit)});
  return t;
}

void quantile_row(TextTable& t, const std::string& what, const Quantiles& q, const std::string& unit, const std::string& note = "") {
  t.row({what, brief(q.median, 3), brief(q.q05, 3) + " – " + brief(q.q95, 3), brief(q.min, 3) + " – " + brief(q.max, 3), brief(q.mean, 3),
         brief(q.sd, 3), unit, note});
}

TextTable quantile_table(const TrackMeta& meta, const Summary& s, TextStyle style) {
  TextTable t({Align::left, Align::right, Align::right, Align::right, Align::right, Align::right, Align::left, Align::left}, style);
  const auto outliers = [](std::size_t n) { return n == 0 ? std::string() : counted(static_cast<std::int64_t>(n), "outlier"); };
  t.row({"", "median", "5 – 95 %", "min – max", "mean", "sd", "", ""}, Paint::bold);
  quantile_row(t, "individuals per frame", s.individuals, "");
  quantile_row(t, "length of a track", s.track_length, "frames");
  quantile_row(t, "unbroken segment", s.segment_length, "frames");
  quantile_row(t, "speed", s.speed, metric_unit(kSpeed, meta.unit), outliers(s.speed_outliers));
  quantile_row(t, "acceleration", s.acceleration, metric_unit(kAcceleration, meta.unit), outliers(s.acceleration_outliers));
  quantile_row(t, "nearest neighbour", s.nearest, meta.unit);
  quantile_row(t, "rms radius of the group", s.extent, meta.unit);
  quantile_row(t, "polarisation", s.polarisation, "0 .. 1");
  quantile_row(t, "milling", s.milling, "0 .. 1");
  return t;
}

// Nothing where only ASCII is known.
std::string shape_lines(const Summary& s, TextStyle style) {
  if (!style.unicode) return {};
  TextTable t({Align::left, Align::right, Align::right, Align::right, Align::right, Align::right, Align::right}, style);
  t.row({"5 to 95 %", "speed", "acceleration", "nearest", "rms radius", "polarisation", "milling"}, Paint::bold);
  std::vector<std::string> cells = {"distribution"};
  for (const Quantiles* q : {&s.speed, &s.acceleration, &s.nearest, &s.extent, &s.polarisation, &s.milling})
    cells.push_back(sparkline(q->shape));
  t.row(cells);
  return t.text() + '\n';
}

std::string localisation_lines(const TrackMeta& meta, const Localisation& l) {
  if (l.samples == 0) return "Localisation error: nothing can be told, the tracks are too short.\n";
  std::string sigma;
  for (int axis = 0; axis < meta.dims; ++axis) sigma += fmt::format("{}{} {}", axis > 0 ? ", " : "", "xyz"[axis], rounded(l.sigma[axis]));
  if (l.rounding) return paragraph(fmt::format("Localisation error: no more than the rounding of the file ({} {}).", sigma, meta.unit));
  const std::string caveat = l.white ? "" : " (not white: the positions were smoothed, or the motion itself is this rough)";
  return paragraph(fmt::format("Localisation error: {} {}{}; it explains {} of the acceleration and {} of the jerk (squared medians).",
                               sigma, meta.unit, caveat, percent(l.acceleration_share), percent(l.jerk_share)));
}

std::string suspicion_text(const Suspicion& s) {
  return fmt::format("{}: {}{}", s.what, s.message, s.examples.empty() ? "" : " (" + s.examples + ')');
}

}  // namespace

std::string describe_text(const TrackMeta& meta, const Summary& s, TextStyle style) {
  std::string out = paint(printable(meta.from.path), Paint::bold, style) + (meta.from.synthetic ? " (synthetic)" : "") + '\n';
  out += paragraph(fmt::format("{}-D positions in {}, one frame every {} s; read as {}{}", meta.dims, meta.unit, brief(meta.dt, 6),
                               meta.from.format, meta.from.columns.empty() ? "" : ", columns " + meta.from.columns)) +
         '\n';
  out += contents_table(meta, s, style).text() + '\n';
  out += quantile_table(meta, s, style).text() + '\n';
  out += shape_lines(s, style);
  out += localisation_lines(meta, s.localisation);

  out += bullets("Repaired while reading", meta.from.notes, Paint::bold, style);
  std::vector<std::string> suspicions;
  for (const Suspicion& one : s.suspicions) suspicions.push_back(suspicion_text(one));
  out += bullets("Look at these before trusting the file", suspicions, Paint::warning, style);
  if (suspicions.empty()) out += "\nNothing suspicious found.\n";
  return finish(std::move(out), style);
}

}  // namespace swarmfit
