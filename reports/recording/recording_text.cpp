// SPDX-License-Identifier: MIT
#include "reports/recording/recording_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/draw/sparkline.h"
#include "reports/recording/evaluation_words.h"
#include "reports/recording/summary_words.h"
#include "reports/write/number.h"
#include "reports/write/plain_text.h"

namespace swarmfit {

std::string describe_text(const TrackMeta& meta, const Summary& s, TextStyle style) {
  std::string out = paint(printable(meta.from.path), Paint::bold, style) + (meta.from.synthetic ? " (synthetic)" : "") + '\n';
  out += paragraph(fmt::format("{}-D positions in {}, one frame every {} s; read as {}{}", meta.dims, meta.unit, brief(meta.dt, 6),
                               meta.from.format, meta.from.columns.empty() ? "" : ", columns " + meta.from.columns)) +
         '\n';
  const Align l = Align::left, r = Align::right;
  out += TextTable(contents_rows(meta, s), {l, r, l}, false, style).text() + '\n';
  TextRows quantiles = quantile_rows(meta, s);
  std::vector<std::string> outliers;  // too wide for the table
  for (auto& row : quantiles) {
    if (!row.back().empty()) outliers.push_back(row.front() + ' ' + row.back());
    row.pop_back();
  }
  out += TextTable(quantiles, {l, r, r, r, r, r, l}, true, style).text();
  if (!outliers.empty()) out += paragraph(enumerate(outliers) + " (beyond the median by 10 robust standard deviations)", " ");
  out += '\n';
  out += paragraph(localisation_words(meta, s.localisation));

  out += shapes_text(s, style);
  out += bullets("Repaired while reading", meta.from.notes, Paint::bold, style);
  std::vector<std::string> suspicions;
  for (const Suspicion& one : s.suspicions) suspicions.push_back(suspicion_words(one));
  out += bullets("Check these before using the file", suspicions, Paint::warning, style);
  if (suspicions.empty()) out += "\nNothing suspicious found.\n";
  return finished(std::move(out), style);
}

std::string first_rows_text(const Tracks& tracks, TextStyle style) {
  constexpr Index most = 5;
  TextRows rows = {{"individual", "frame", "t [s]"}};
  std::vector<Align> columns = {Align::left, Align::right, Align::right};
  for (int axis = 0; axis < tracks.dims(); ++axis) {
    rows[0].push_back(fmt::format("{} [{}]", "xyz"[axis], printable(tracks.meta().unit)));
    columns.push_back(Align::right);
  }
  for (Index i = 0; i < std::min(most, tracks.rows()); ++i) {
    const auto row = static_cast<std::size_t>(i);
    rows.push_back(
        {printable(tracks.names()[tracks.track()[row]]), std::to_string(tracks.frame()[row]), brief(tracks.time(tracks.frame()[row]), 9)});
    for (int axis = 0; axis < tracks.dims(); ++axis) rows.back().push_back(brief(tracks.pos()(i, axis), 6));
  }
  return finished("\nThe first rows as they were understood:\n" + TextTable(rows, columns, true, style).text(), style);
}

std::string evaluation_text(const Evaluation& e, TextStyle style) {
  TextRows rows = energy_rows(e);
  for (std::size_t m = 0; !style.unicode && m < e.columns.size(); ++m) {  // before columns are aligned
    rows[m + 1][0] = e.columns[m].key();
    for (const std::size_t k : {3U, 4U}) rows[m + 1][k] = ascii(rows[m + 1][k]);
  }
  const Align l = Align::left, r = Align::right;
  const TextTable t = TextTable(rows, {l, l, r, r, r, r, r, l}, true, style), order = TextTable(order_rows(e), {l, r, r}, true, style);
  const auto source = [](const TrackMeta& meta) { return printable(meta.from.path) + (meta.from.synthetic ? " (synthetic)" : ""); };
  std::string out = fmt::format("recording   {}\nsimulation  {}\n\n", source(e.real), source(e.simulated));
  out += t.folded() + '\n';
  const Shapes shapes{
      {{"recording", &e.real_distribution}, {"simulation", &e.simulated_distribution}}, e.columns, e.axis_lower, e.axis_width, e.real.unit};
  for (std::size_t first = 0; style.unicode && first < e.columns.size(); first += first == 0 ? kMetrics : kMotionMetrics)
    out += shapes_text(shapes, first, "distribution", style) + '\n';
  if (style.unicode) out += paragraph(what_shapes_mean(e.binning), " ") + '\n';
  out += order.text() + '\n';
  out += paragraph(energy_words(e)) + paragraph(lag_words(e));
  return finished(std::move(out), style);
}

}  // namespace swarmfit
