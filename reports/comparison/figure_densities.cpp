// SPDX-License-Identifier: MIT
// What recording and models look like to the evaluator: one density per metric.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/comparison/figure_parts.h"
#include "reports/comparison/tables.h"
#include "reports/comparison/words.h"
#include "reports/write/number.h"
#include "reports/write/plain_text.h"
#include "reports/write/unit_text.h"

namespace swarmfit::parts {
namespace {

using plot::Curve;
using svg::Point;

constexpr double kRecorded = 0.01, kSimulated = 0.02;  // shares of the samples on either side of what is shown
constexpr double kTallest = 2;                         // a model's peak beyond this many of the recording's is cut
constexpr std::size_t kMost = 8;                       // models that can be told apart in one panel
constexpr double kMuch = 0.05;                         // share of samples beyond the axis that is worth saying

// One column, ready to be drawn.
struct Density {
  std::size_t column = 0;
  Curve lower, upper;         // of the first model's band
  std::vector<Curve> curves;  // the recording's, then the models'; without points where there are no samples
  double left = 0, right = 1, top = 1;
  std::vector<std::string> absent, cut, beyond;  // models
  bool drawn() const { return !curves.empty() && !curves.front().empty(); }
};

std::size_t drawn_models(const Comparison& c) { return std::min(kMost, c.models.size()); }

// " Not drawn: ..."; empty if all are.
std::string too_many(const Comparison& c) {
  std::vector<std::string> names;
  for (std::size_t k = drawn_models(c); k < c.models.size(); ++k) names.push_back(c.models[k].model);
  return names.empty() ? std::string() : fmt::format(" Not drawn: {}.", enumerate(names));
}

// The bins that are drawn of a histogram: its end bins hold all that lies beyond them.
std::pair<std::size_t, std::size_t> inner_bins(const Comparison& c, std::size_t bins) {
  return c.recording.binning.clip && bins > 2 ? std::pair(std::size_t{1}, bins - 1) : std::pair(std::size_t{0}, bins);
}

Curve curve_of(const Comparison& c, std::size_t m, const std::vector<double>& q) {
  const auto [first, last] = inner_bins(c, q.size());
  Curve out;
  for (std::size_t bin = first; bin < last && bin < q.size(); ++bin)
    out.push_back({c.recording.axis_lower[m] + (static_cast<double>(bin) + 0.5) * c.recording.axis_width[m], q[bin]});
  return out;
}

double peak_of(const Curve& curve) {
  double peak = 0;
  for (const Point& p : curve) peak = std::max(peak, p.y);
  return peak;
}

// The part of a curve that holds all but a share of the samples at either end.
void include_most(plot::Range& across, const Curve& curve, double share) {
  double total = 0, sum = 0;
  for (const Point& p : curve) total += p.y;
  for (const Point& p : curve) {
    if (sum + p.y > share * total && sum < (1 - share) * total) across.include(p.x);
    sum += p.y;
  }
}

// Where somebody can be seen, and how high.
void set_frame(const Comparison& c, Density& d) {
  const double peak = peak_of(d.curves.front()), half = 0.5 * c.recording.axis_width[d.column];
  plot::Range across;
  double highest = peak;
  for (std::size_t k = 0; k < d.curves.size(); ++k) {
    highest = std::max(highest, peak_of(d.curves[k]));
    include_most(across, d.curves[k], k == 0 ? kRecorded : kSimulated);
  }
  if (across.empty()) across.include(d.curves.front().front().x), across.include(d.curves.front().back().x);
  const bool signed_values = c.recording.columns[d.column].metric == kAngularAcceleration;
  constexpr double kNear = 0.25;  // an axis that begins as near to 0 as this begins there
  d.left = across.lower - half;
  d.right = across.upper + half;
  if (!signed_values && d.left < kNear * d.right) d.left = 0;
  d.top = 1.06 * std::min(highest, kTallest * peak);
  if (!(d.top > 0)) d.top = 1;
}

Curve curve_of(const Comparison& c, std::size_t m, const Histogram& histogram) {
  return curve_of(c, m, physical_density(histogram, c.recording.axis_width[m]));
}

Density density_at(const Comparison& c, std::size_t m) {
  Density d;
  d.column = m;
  d.curves.push_back(curve_of(c, m, c.recording.distributions[m].histogram));
  if (!d.drawn()) return d;
  const auto [lower, upper] = physical_band(c, m);
  d.lower = curve_of(c, m, lower);
  d.upper = curve_of(c, m, upper);
  for (std::size_t k = 0; k < drawn_models(c); ++k) {
    const ModelFit& r = c.models[k];
    d.curves.push_back(curve_of(c, m, r.runs.distributions[m].histogram));
    if (d.curves.back().empty()) d.absent.push_back(r.model);
    if (r.runs.outside_fraction[m] > kMuch) d.beyond.push_back(fmt::format("{} ({})", r.model, percent(r.runs.outside_fraction[m])));
  }
  set_frame(c, d);
  for (std::size_t k = 0; k + 1 < d.curves.size(); ++k)
    if (peak_of(d.curves[k + 1]) > d.top) d.cut.push_back(c.models[k].model);
  return d;
}

// With one point on either side, where the frame cuts the line.
Curve within(const Density& d, const Curve& curve, double bin) {
  Curve out;
  for (const Point& p : curve)
    if (p.x > d.left - bin && p.x < d.right + bin) out.push_back(p);
  return out;
}

void draw_curves(plot::Panel& panel, const Comparison& c, const Density& d) {
  const double bin = c.recording.axis_width[d.column];
  panel.area(within(d, d.curves.front(), bin));
  panel.band(within(d, d.lower, bin), within(d, d.upper, bin), 0);
  for (std::size_t k = d.curves.size() - 1; k > 0; --k)
    panel.curve(within(d, d.curves[k], bin), k - 1, k == 1 ? 1.1 : 0.9);  // the winner last, on top
}

svg::Text density_title(const Comparison& c, const Density& d, const plot::Axis& y) {
  return svg::plain("density") + plot::in_units(y, density_unit(c.recording.columns[d.column].metric, c.recording.data.unit));
}

svg::Text symbol_and_unit(const Comparison& c, const Density& d, const plot::Axis& x) {
  const MetricInfo& info = c.recording.columns[d.column].info();
  return svg::italic(info.symbol) + plot::in_units(x, metric_unit(c.recording.columns[d.column].metric, c.recording.data.unit)) +
         svg::plain(counts(c, d.column) ? "" : ", not scored");
}

// What has no samples, in the figure itself.
std::string absences(const Comparison& c, const Density& d) {
  const std::string symbol = c.recording.columns[d.column].symbol();
  if (!d.drawn()) return fmt::format(" No samples of {} in the recording.", symbol);
  return d.absent.empty() ? std::string() : fmt::format(" No samples of {}: {}.", symbol, enumerate(d.absent));
}

// What is not drawn in full, in the caption.
std::string limits(const Comparison& c, const std::vector<Density>& all) {
  std::vector<std::string> cut, beyond;
  for (const Density& d : all) {
    const std::string symbol = c.recording.columns[d.column].symbol();
    if (!d.cut.empty()) cut.push_back(fmt::format("{} ({})", symbol, enumerate(d.cut)));
    if (!d.beyond.empty()) beyond.push_back(fmt::format("{} of {}", symbol, enumerate(d.beyond)));
  }
  std::string out;
  if (!cut.empty()) out += fmt::format(" Model peaks cropped at {} times the recording's peak: {}.", brief(kTallest), enumerate(cut));
  if (!beyond.empty()) out += fmt::format(" Samples outside the binned interval: {}.", enumerate(beyond));
  return out;
}

std::string about_binning(const Comparison& c) {
  if (c.recording.binning.normalisation != Normalisation::separate) return {};
  return " Every set was standardised by its own mean and standard deviation; the models are drawn with the recording's.";
}

std::string about_band(const Comparison& c, const std::vector<Density>& all) {
  if (std::all_of(all.begin(), all.end(), [](const Density& d) { return d.lower.empty(); })) return {};
  return fmt::format(" Shaded: range of 95 % of recordings simulated from {}, bin by bin.", c.models.front().model);
}

std::vector<plot::Entry> entries(const Comparison& c) {
  std::vector<plot::Entry> out = model_entries(c, plot::Sample::line);
  out.resize(drawn_models(c));
  out.insert(out.begin(), plot::Entry{plot::Sample::area, 0, "recording"});
  return out;
}

constexpr std::size_t kAcross = 5;                            // panels in a row: the metrics of motion
constexpr double kPlotHeight = 62, kAbove = 17, kBelow = 31;  // of a panel
constexpr double kLeft = 22, kRight = 6, kRowTitle = 10;

void draw_small(svg::Sheet& sheet, const Comparison& c, const Density& d, const svg::Box& cell) {
  const svg::Box box{cell.left + kLeft, cell.top + kAbove, cell.width - kLeft - kRight, kPlotHeight};
  const plot::Axis x = plot::linear(d.left, d.right, {5, box.width, true}), y = plot::linear(0, d.top, {4, 0, true});
  plot::Panel panel(sheet, box, x, y);
  draw_curves(panel, c, d);
  panel.x_axis({});
  panel.y_axis({});
  sheet.text({cell.left, cell.top + 10}, density_title(c, d, y));
  const double middle = box.left + box.width / 2, base = box.bottom() + 3.5 + 2 * svg::kTextSize + 2;
  sheet.text({middle, base}, svg::plain(c.recording.columns[d.column].info().name), svg::Anchor::middle);
  sheet.text({middle, base + 8}, symbol_and_unit(c, d, x), svg::Anchor::middle);
}

// Columns of entries from `left` on.
void draw_legend(svg::Sheet& sheet, double left, double top, const std::vector<plot::Entry>& all) {
  const auto rows = static_cast<std::ptrdiff_t>((kAbove + kPlotHeight + kBelow) / plot::kEntryHeight) - 2;
  for (auto from = all.begin(); from < all.end(); from += std::min(rows, all.end() - from)) {
    const std::vector<plot::Entry> some(from, from + std::min(rows, all.end() - from));
    plot::legend_column(sheet, {left, top + kAbove + 6}, some);
    double widest = 0;
    for (const plot::Entry& e : some) widest = std::max(widest, plot::entry_width(e));
    left += widest;
  }
}

}  // namespace

Figure densities(const Comparison& c) {
  svg::Sheet sheet(svg::kTwoColumns);
  const bool titled = c.recording.columns.size() > kMetrics;
  const double left = titled ? kRowTitle : 2, across = (sheet.width() - left) / kAcross, down = kAbove + kPlotHeight + kBelow;
  std::string absent = too_many(c);
  std::vector<Density> all;
  std::size_t place = 0;
  bool any = false;
  for (const std::size_t m : drawing_order(c)) {
    const Density d = density_at(c, m);
    const std::size_t row = place / kAcross;
    const double top = static_cast<double>(row) * down;
    if (place % kAcross == 0 && titled && c.recording.columns[m].motion())
      sheet.turned_text({7, top + kAbove + kPlotHeight / 2}, svg::plain(lag_title(c, m)));
    absent += absences(c, d);
    all.push_back(d);
    if (d.drawn()) draw_small(sheet, c, d, {left + across * static_cast<double>(place % kAcross), top, across, down});
    any = any || d.drawn();
    ++place;
  }
  if (!any) return {"densities", "", ""};
  const std::string caption =
      fmt::format("Probability densities of the metrics of motion: the recording (grey) and the model{}, best first.{}{}",
                  c.models.size() == 1 ? "" : "s", about_binning(c), about_band(c, all) + absent + limits(c, all));
  const double legend_left = left + across * static_cast<double>(place % kAcross) + kLeft;
  const std::size_t last_row = place / kAcross;
  draw_legend(sheet, legend_left, static_cast<double>(last_row) * down, entries(c));
  double height = static_cast<double>(last_row + 1) * down;
  if (!absent.empty()) height = sheet.note(height + 8, std::string_view(absent).substr(1)) - 4;
  return {"densities", caption, sheet.document(height, "Densities of the metrics", caption)};
}

Figure density_of(const Comparison& c, std::size_t m) {
  const Column& column = c.recording.columns[m];
  const std::string name = fmt::format("density_{}{}", column.info().key, column.lag == 1 ? "" : fmt::format("_lag{}", column.lag));
  const Density d = density_at(c, m);
  if (!d.drawn()) return {name, "", ""};
  svg::Sheet sheet(svg::kOneColumn);
  const double top = plot::legend_rows(sheet, 4, sheet.width(), 9, entries(c)) + 8;
  const svg::Box box{26, top, sheet.width() - 34, 112};
  const plot::Axis x = plot::linear(d.left, d.right, {6, box.width, true}), y = plot::linear(0, d.top, {4, 0, true});
  plot::Panel panel(sheet, box, x, y);
  draw_curves(panel, c, d);
  panel.x_axis(svg::plain(column.name() + ' ') + symbol_and_unit(c, d, x));
  panel.y_axis({});
  sheet.text({4, top - 5}, density_title(c, d, y));
  const std::string absent = too_many(c) + absences(c, d);
  double height = box.bottom() + 24;
  if (!absent.empty()) height = sheet.note(height + 8, std::string_view(absent).substr(1)) - 4;
  const std::string caption =
      fmt::format("Probability density of the {}: the recording (grey) and the model{}, best first.{}{}", column.name(),
                  c.models.size() == 1 ? "" : "s", about_binning(c), about_band(c, {d}) + absent + limits(c, {d}));
  return {name, caption, sheet.document(height, "Density of the " + column.name(), caption)};
}

}  // namespace swarmfit::parts
