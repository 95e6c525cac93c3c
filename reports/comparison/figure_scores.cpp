// SPDX-License-Identifier: MIT
// Scores with intervals, and energies by metric.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/comparison/figure_parts.h"
#include "reports/comparison/words.h"
#include "reports/write/number.h"
#include "reports/write/plain_text.h"

namespace swarmfit::parts {
namespace {

using svg::Anchor;

constexpr double kWiderFont = 1.1;

double widest_name(const Comparison& c) {
  double widest = 0;
  for (const ModelFit& r : c.models) widest = std::max(widest, kWiderFont * svg::plain(r.model).width);
  return widest;
}

// ---- scores: a row per model ----------------------------------------------------------------------------------------------------

// From 0 or what lies lowest to 1 or what lies highest, with a little room.
plot::Axis score_axis(const Comparison& c, double room_for_labels) {
  plot::Range range;
  for (const double end : {0.0, 1.0}) range.include(end);
  for (const ModelFit& r : c.models) {
    for (const double x : {r.standing.score, r.standing.certainty.lower, r.standing.certainty.upper}) range.include(x);
    for (const double x : {r.standing.in_sample.score, r.standing.in_sample.lower, r.standing.in_sample.upper}) range.include(x);
  }
  const double room = 0.03 * (range.upper - range.lower);
  return plot::linear(range.lower - room, range.upper + room, {5, room_for_labels, false});
}

template <class Sure>
void draw_score(plot::Panel& panel, double y, double score, const Sure& sure, std::size_t k, plot::Fill fill) {
  panel.across(y, sure.lower, sure.upper, {plot::look(k).colour, fill == plot::Fill::none ? 0.7 : 1.4, ""});
  panel.marker({score, y}, k, fill);
}

// With halves held out, the score in sample hollow beneath that of them.
void draw_scores(plot::Panel& panel, double y, const Comparison& c, std::size_t k) {
  const ModelFit& r = c.models[k];
  if (!c.recording.hold_out.used()) return draw_score(panel, y, r.standing.score, r.standing.certainty, k, plot::Fill::of_series);
  draw_score(panel, y - 0.28, r.standing.in_sample.score, r.standing.in_sample, k, plot::Fill::none);
  draw_score(panel, y + 0.1, r.standing.score, r.standing.certainty, k, plot::Fill::full);
}

struct ScoreColumns {
  double score, group, fit;  // right ends of the columns of text
};

void write_row(svg::Sheet& sheet, double y, const Comparison& c, const ModelFit& r, const ScoreColumns& at) {
  sheet.text({2, y}, svg::plain(r.model));
  sheet.text({at.score, y}, svg::plain(in_print(fixed(r.standing.score, 3))), Anchor::end);
  sheet.text({at.group, y}, svg::plain(group_letter(r)), Anchor::middle);
  sheet.text({at.fit, y}, svg::plain(fit_p(c, r)), Anchor::end);
}

std::string unscored(const Comparison& c) {
  std::vector<std::string> names;
  for (const ModelFit& r : c.models)
    if (!std::isfinite(r.standing.score)) names.push_back(r.model);
  return names.empty() ? std::string() : fmt::format(" Without a score: {}.", enumerate(names));
}

std::string scores_caption(const Comparison& c) {
  std::string out = "Entropy-weighted scores of the models (higher is better)";
  if (c.ranking.bootstrap_recordings > 0) out += ", with intervals. " + what_ranks_mean(c);
  if (c.ranking.bootstrap_recordings == 0) out += '.';
  if (const std::string scores = what_held_out_means(c); !scores.empty()) out += ' ' + scores;
  if (c.recording.hold_out.used()) out += " Hollow: in sample.";
  return out + unscored(c);
}

// ---- energies: a place per column, a marker per model ---------------------------------------------------------------------------

constexpr double kDeepest = 1e-3;     // the axis begins at this share of the largest energy or above it
constexpr double kBetweenLags = 0.6;  // in widths of a column

// Where every column stands along x, with room between lags.
struct Places {
  std::vector<std::size_t> order;
  std::vector<double> x;
  double end = 0;
};

Places places(const Comparison& c) {
  Places out;
  out.order = drawing_order(c);
  double x = 0;
  for (std::size_t k = 0; k < out.order.size(); ++k) {
    const bool next_lag = k > 0 && lag_title(c, out.order[k]) != lag_title(c, out.order[k - 1]);
    if (next_lag) x += kBetweenLags;
    out.x.push_back(x + 0.5);
    x += 1;
  }
  out.end = x;
  return out;
}

plot::Axis energy_axis(const Comparison& c) {
  plot::Range range;
  for (const ModelFit& r : c.models)
    for (std::size_t m = 0; m < c.recording.columns.size(); ++m)
      for (const double e : {r.runs.raw_energies[m], r.runs.raw_energies[m] + r.runs.raw_se[m]})
        if (e > 0) range.include(std::min(e, worst_energy(c.recording.binning)));
  // A model without noise repeats its own recordings: energies of rounding.
  const double least = range.upper * kDeepest;
  for (const ModelFit& r : c.models)
    for (const double e : r.standing.certainty.own)
      if (e >= least) range.include(e);
  return plot::logarithmic(std::max(range.lower, least), range.upper);
}

bool any_left_out(const Comparison& c) {
  for (std::size_t m = 0; m < c.recording.columns.size(); ++m)
    if (!counts(c, m)) return true;
  return false;
}

// What a logarithmic axis cannot show.
std::string not_drawn(const Comparison& c, double lowest) {
  std::string out;
  for (const ModelFit& r : c.models) {
    std::vector<std::string> symbols;
    for (std::size_t m = 0; m < c.recording.columns.size(); ++m)
      if (!(r.runs.raw_energies[m] >= lowest)) symbols.push_back(c.recording.columns[m].symbol());
    if (!symbols.empty()) out += fmt::format(" Undefined or below the axis in {}: {}.", r.model, enumerate(symbols));
  }
  return out;
}

void draw_energies(plot::Panel& panel, const Comparison& c, const Places& at, double lowest) {
  const double slot = 0.8 / static_cast<double>(c.models.size());
  for (std::size_t j = 0; j < at.order.size(); ++j)
    for (std::size_t k = 0; k < c.models.size(); ++k) {
      const ModelFit& r = c.models[k];
      const std::size_t m = at.order[j];
      const double x = at.x[j] + slot * (static_cast<double>(k) - 0.5 * static_cast<double>(c.models.size() - 1));
      const double e = r.runs.raw_energies[m], se = r.runs.raw_se[m], own = r.standing.certainty.own[m];
      if (own >= lowest) panel.across(own, x - 0.45 * slot, x + 0.45 * slot, {plot::kRecordingLine, 1, ""});
      if (!(e >= lowest)) continue;
      if (std::isfinite(se)) panel.upright(x, std::max(lowest, e - se), e + se, {plot::look(k).colour, 0.8, ""});
      panel.marker({x, e}, k);
    }
}

void write_metrics(svg::Sheet& sheet, const plot::Panel& panel, const Comparison& c, const Places& at, double lowest) {
  const double y = panel.box().bottom();
  sheet.line({panel.box().left, y}, {panel.box().right(), y});
  for (std::size_t j = 0; j < at.order.size(); ++j) {
    const std::size_t m = at.order[j];
    const svg::Text symbol = svg::italic(c.recording.columns[m].info().symbol);
    const double x = panel.place({at.x[j], lowest}).x;
    sheet.text({x, y + 9}, counts(c, m) ? symbol : svg::plain("(") + symbol + svg::plain(")"), Anchor::middle);
    const std::string lag = lag_title(c, m);
    const bool first = j == 0 || lag_title(c, at.order[j - 1]) != lag;
    std::size_t last = j;
    while (last + 1 < at.order.size() && lag_title(c, at.order[last + 1]) == lag) ++last;
    if (!first || lag.empty()) continue;
    const double from = panel.place({at.x[j] - 0.4, lowest}).x, to = panel.place({at.x[last] + 0.4, lowest}).x;
    sheet.line({from, y + 13}, {to, y + 13}, {svg::kSoft, 0.4, ""});
    sheet.text({(from + to) / 2, y + 21}, svg::plain(lag), Anchor::middle);
  }
}

}  // namespace

Figure scores(const Comparison& c) {
  if (std::none_of(c.models.begin(), c.models.end(), [](const ModelFit& r) { return std::isfinite(r.standing.score); }))
    return {"scores", "", ""};
  const double names = widest_name(c);
  svg::Sheet sheet(names < 90 ? svg::kOneColumn : svg::kTwoColumns);
  const double right = sheet.width() - 4;
  const ScoreColumns at{right - 48, right - 32, right};
  const double row = c.recording.hold_out.used() ? 16 : 12, top = 12;
  const svg::Box box{names + 10, top, at.score - 26 - names - 10, row * static_cast<double>(c.models.size()) + 2};
  const plot::Axis x = score_axis(c, box.width);
  plot::Panel panel(sheet, box, x, plot::linear(0, static_cast<double>(c.models.size())));
  sheet.text({at.score, 9}, svg::plain("score"), Anchor::end, svg::kSoft);
  sheet.text({at.group, 9}, svg::plain("group"), Anchor::middle, svg::kSoft);
  sheet.text({at.fit, 9}, svg::plain("fit p"), Anchor::end, svg::kSoft);
  for (std::size_t k = 0; k < c.models.size(); ++k) {
    const ModelFit& r = c.models[k];
    const double y = static_cast<double>(c.models.size() - k) - 0.5;
    draw_scores(panel, y, c, k);
    write_row(sheet, panel.place({0, y}).y + 2.5, c, r, at);
  }
  panel.x_axis(svg::plain(fmt::format("score{}{}", c.ranking.bootstrap_recordings > 0 ? ", 95 % interval" : "",
                                      c.recording.hold_out.used() ? "; hollow: in sample" : "")));
  const std::string absent = unscored(c);
  double height = box.bottom() + 24;
  if (!absent.empty()) height = sheet.note(height + 8, std::string_view(absent).substr(1)) - 4;
  return {"scores", scores_caption(c), sheet.document(height, "Scores of the models", scores_caption(c))};
}

Figure energies(const Comparison& c) {
  const auto defined = [](const ModelFit& r) {
    return std::any_of(r.runs.raw_energies.begin(), r.runs.raw_energies.end(), [](double e) { return e > 0; });
  };
  if (std::none_of(c.models.begin(), c.models.end(), defined)) return {"energies", "", ""};
  svg::Sheet sheet(c.models.size() * c.recording.columns.size() > 24 ? svg::kTwoColumns : svg::kOneColumn);
  std::vector<plot::Entry> legend = model_entries(c, plot::Sample::marker);
  if (c.ranking.bootstrap_recordings > 0) legend.push_back({plot::Sample::level, 0, "expected if the model were true"});
  const double top = plot::legend_rows(sheet, 4, sheet.width(), 9, legend) + 8;
  const svg::Box box{26, top, sheet.width() - 30, 120};
  const Places at = places(c);
  plot::Axis x;
  x.upper = at.end;
  const plot::Axis y = energy_axis(c);
  plot::Panel panel(sheet, box, x, y);
  for (std::size_t j = 1; j < at.x.size(); ++j) panel.upright(0.5 * (at.x[j - 1] + at.x[j]), y.lower, y.upper, {svg::kFaint, 0.4, ""});
  draw_energies(panel, c, at, y.lower);
  write_metrics(sheet, panel, c, at, y.lower);
  panel.y_axis({});
  sheet.text({4, top - 5}, svg::plain("raw energy"));
  const std::string absent = not_drawn(c, y.lower);
  double height = box.bottom() + (c.recording.columns.size() > kMetrics ? 25 : 13);
  if (!absent.empty()) height = sheet.note(height + 8, std::string_view(absent).substr(1)) - 4;
  const std::string caption = fmt::format(
      "Raw energies ({}) with one standard error over the final "
      "replicates.{}{}{}",
      what_energy_means(c),
      c.ranking.bootstrap_recordings > 0 ? " Grey: energy expected if the model were true (mean over recordings simulated from it)." : "",
      any_left_out(c) ? " In brackets: not in the score." : "", absent);
  return {"energies", caption, sheet.document(height, "Raw energies by metric", caption)};
}

}  // namespace swarmfit::parts
