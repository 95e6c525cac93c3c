// SPDX-License-Identifier: MIT
#include "reports/draw/sparkline.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "reports/write/number.h"
#include "reports/write/unit_text.h"

namespace swarmfit {
namespace {

constexpr std::size_t kLine = 80, kApart = 2;
constexpr double kTail = 0.01;

// Cells of `per_cell` bins each, from bin `first` on.
struct Cells {
  std::size_t first = 0, per_cell = 1, count = 1;
};

// Where the recording is, but for a hundredth on either side. The end bins are passed over: they hold all that lies beyond.
Cells cells_for(const Histogram& recording, std::size_t count) {
  const auto& counts = recording.counts;
  if (counts.size() < 3) return {0, 1, count};
  const double total = static_cast<double>(std::accumulate(counts.begin() + 1, counts.end() - 1, std::uint64_t{0}));
  std::size_t first = counts.size(), last = 0;
  double sum = 0;
  for (std::size_t k = 1; k + 1 < counts.size(); ++k) {
    const double before = sum;
    sum += static_cast<double>(counts[k]);
    if (sum <= kTail * total || before >= (1 - kTail) * total) continue;
    first = std::min(first, k);
    last = k;
  }
  if (first > last) return {0, (counts.size() + count - 1) / count, count};
  return {first, (last - first + count) / count, count};
}

std::vector<std::uint64_t> gathered(const Histogram& histogram, const Cells& cells) {
  if (histogram.samples == 0) return {};
  std::vector<std::uint64_t> out(cells.count);
  for (std::size_t k = 0; k < histogram.counts.size(); ++k) {
    const std::size_t cell = k < cells.first ? 0 : (k - cells.first) / cells.per_cell;
    out[std::min(cell, cells.count - 1)] += histogram.counts[k];
  }
  return out;
}

std::size_t cell_count(const Shapes& s, std::size_t columns, const std::string& title) {
  std::size_t names = display_width(title);
  for (const Shapes::Row& row : s.rows) names = std::max(names, display_width(row.name));
  const std::size_t left = kLine - 1 - std::min(names, kLine / 2);
  return std::clamp<std::size_t>(left / columns - kApart, 5, 12);
}

}  // namespace

std::string sparkline(const std::vector<std::uint64_t>& counts) {
  constexpr std::array<std::string_view, 8> kHeights = {"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
  const std::uint64_t most = counts.empty() ? 0 : *std::max_element(counts.begin(), counts.end());
  if (most == 0) return kUndefined;
  std::string out;
  for (const std::uint64_t n : counts) {
    const double share = static_cast<double>(n) / static_cast<double>(most);
    out += kHeights[std::min<std::size_t>(static_cast<std::size_t>(share * 8), 7)];
  }
  return out;
}

std::string shapes_text(const Shapes& s, std::size_t first, const std::string& title, TextStyle style) {
  if (!style.unicode || s.rows.empty()) return {};
  const std::size_t columns = std::min(first == 0 ? kMetrics : kMotionMetrics, s.columns.size() - first);
  const std::size_t count = cell_count(s, columns, title);
  std::vector<Align> align(columns + 1, Align::right);
  align.front() = Align::left;
  TextTable table(align, style);
  std::vector<std::string> head = {title}, from = {"from"}, to = {"to"}, unit = {""};
  std::vector<std::vector<std::string>> lines;
  for (const Shapes::Row& row : s.rows) lines.push_back({row.name});
  for (std::size_t m = first; m < first + columns; ++m) {
    const Cells cells = cells_for((*s.rows.front().distributions)[m].histogram, count);
    const auto edge = [&](std::size_t bin) { return s.axis_lower[m] + static_cast<double>(bin) * s.axis_width[m]; };
    head.push_back(s.columns[m].symbol());
    const bool signed_values = s.columns[m].metric == kAngularAcceleration;
    from.push_back(brief(signed_values ? edge(cells.first) : std::max(0.0, edge(cells.first)), 2));
    to.push_back(brief(edge(cells.first + cells.per_cell * cells.count), 2));
    unit.push_back(metric_unit(s.columns[m].metric, s.unit));
    for (std::size_t k = 0; k < s.rows.size(); ++k) lines[k].push_back(sparkline(gathered((*s.rows[k].distributions)[m].histogram, cells)));
  }
  table.row(head, Paint::bold);
  for (std::size_t k = 0; k < lines.size(); ++k) table.row(lines[k], s.rows[k].paint);
  for (const auto& line : {from, to, unit}) table.row(line, Paint::dim);
  return table.folded();
}

std::string shapes_text(const Summary& s, TextStyle style) {
  if (!style.unicode) return {};
  TextTable t({Align::left, Align::right, Align::right, Align::right, Align::right, Align::right, Align::right}, style);
  t.row({"5 to 95 %", "speed", "acceleration", "nearest", "rms radius", "polarisation", "milling"}, Paint::bold);
  std::vector<std::string> cells = {"distribution"};
  for (const Quantiles* q : {&s.speed, &s.acceleration, &s.nearest, &s.extent, &s.polarisation, &s.milling})
    cells.push_back(sparkline(q->shape));
  t.row(cells);
  return '\n' + t.folded();
}

std::string what_shapes_mean(const Binning& binning) {
  if (binning.normalisation == Normalisation::separate)
    return "distribution: each scaled to its own peak and standardised by itself, so only its shape is shown; end cells count all values "
           "beyond";
  return "distribution: each scaled to its own peak, over the recording's range; end cells count all values beyond";
}

}  // namespace swarmfit
