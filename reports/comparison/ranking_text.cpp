// SPDX-License-Identifier: MIT
#include "reports/comparison/ranking_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "libtrack/nan.h"
#include "reports/comparison/quantities.h"
#include "reports/comparison/second_opinions.h"
#include "reports/comparison/words.h"
#include "reports/draw/sparkline.h"
#include "reports/write/number.h"
#include "reports/write/plain_text.h"

namespace swarmfit {

namespace {

std::string symbol_of(const Column& column, TextStyle style) { return style.unicode ? column.symbol() : column.key(); }

std::string data_line(const DataFacts& d) {
  return fmt::format("{}{} · {}-D · {} · {} at {} s · {} individuals per frame", printable(d.path), d.synthetic ? " (synthetic)" : "",
                     d.dims, counted(static_cast<std::int64_t>(d.tracks), "track"), counted(static_cast<std::int64_t>(d.frames), "frame"),
                     brief(d.dt), brief(d.individuals_per_frame, 3));
}

Paint paint_of(const ModelFit& r) { return r.standing.rank == 1 ? Paint::good : Paint::plain; }

std::string marks(const ModelFit& r) { return std::string(contradictions(r).empty() ? "" : " !") + (at_bounds(r).empty() ? "" : " *"); }

TextTable ranking_table(const Comparison& c, const std::vector<const Quantity*>& columns, TextStyle style) {
  const auto row = [](const std::string& first, const std::string& model, const auto& rest) {
    std::vector<std::string> cells = {first, model};
    for (std::size_t k = 1; k < rest.size(); ++k) cells.push_back(rest[k]);
    return cells;
  };
  const auto cells_of = [&](auto text) {
    std::vector<std::string> out;
    for (const Quantity* q : columns) out.push_back(text(*q));
    return out;
  };
  std::vector<Align> align(columns.size() + 1, Align::right);
  align[1] = Align::left;
  TextTable table(align, style);
  const auto heads = cells_of([](const Quantity& q) { return std::string(q.head); });
  table.row(row(heads.front(), "model", heads), Paint::bold);
  for (const ModelFit& r : c.models) {
    const auto cells = cells_of([&](const Quantity& q) { return q.print(c, r, Audience::terminal); });
    table.row(row(cells.front(), r.model + marks(r), cells), paint_of(r));
  }
  const Estimate& walker = c.recording.skill.walker;
  if (std::isfinite(walker.value))
    table.row(row("", "random walk", cells_of([&](const Quantity& q) { return q.key == "skill" ? fixed(walker.value, 2) : ""; })),
              Paint::dim);
  return table;
}

// As many columns as fit; the last are left out first.
std::string ranking_lines(const Comparison& c, TextStyle style) {
  auto columns = ranking_columns(c, Audience::terminal);
  std::vector<std::string> left_out;
  while (columns.size() > 2 && ranking_table(c, columns, style).width() > kTextWidth) {
    left_out.emplace_back(columns.back()->head);
    columns.pop_back();
  }
  std::reverse(left_out.begin(), left_out.end());
  std::string out = ranking_table(c, columns, style).text();
  if (!left_out.empty()) out += paragraph(fmt::format("Too wide for this line: {}; see report.html.", enumerate(left_out)), " ");
  return out;
}

// The columns of one lag; d and eta, which have none, beside those of the first.
TextTable energy_table(const Comparison& c, std::size_t first, TextStyle style) {
  const std::size_t count = std::min(first == 0 ? kMetrics : kMotionMetrics, c.recording.columns.size() - first);
  std::vector<Align> align(count + 1, Align::right);
  align.front() = Align::left;
  TextTable table(align, style);
  const int lag = c.recording.columns[first].lag;
  const bool several = c.recording.columns.size() > kMetrics;
  std::vector<std::string> head = {several ? fmt::format("energy, {}", lag_name(c, lag)) : "energy"};
  std::vector<std::string> weights = {"weight in score"};
  for (std::size_t m = first; m < first + count; ++m) {
    head.push_back(marked(c, m, symbol_of(c.recording.columns[m], style)));
    weights.push_back(counts(c, m) ? fixed(c.ranking.weights[m], 2) : kUndefined);
  }
  table.row(head, Paint::bold);
  for (const ModelFit& r : c.models) {
    std::vector<std::string> cells = {r.model};
    for (std::size_t m = first; m < first + count; ++m) cells.push_back(fixed(r.runs.raw_energies[m], 2));
    table.row(cells, paint_of(r));
  }
  table.row(weights, Paint::dim);
  return table;
}

std::string energy_tables(const Comparison& c, TextStyle style) {
  std::string out;
  for (std::size_t first = 0; first < c.recording.columns.size(); first += first == 0 ? kMetrics : kMotionMetrics)
    out += '\n' + energy_table(c, first, style).folded();
  return out;
}

std::vector<std::string> left_out(const Comparison& c, TextStyle style) {
  std::vector<std::string> out;
  for (std::size_t m = 0; m < c.recording.columns.size(); ++m)
    if (!counts(c, m))
      out.push_back(
          fmt::format("({}) {}: {}", symbol_of(c.recording.columns[m], style), c.recording.columns[m].name(), why_left_out(c, m)));
  return out;
}

constexpr std::string_view kGroup = "group_msd_";

struct Shown {
  std::size_t item;  // of the panel
  std::string title;
  bool root;  // of a square
};

// A few of the panel, in its order.
std::vector<Shown> shown_of_panel(const Comparison& c) {
  const std::map<std::string_view, std::string_view> titles{{"vacf_zero", "VACF zero [s]"},
                                                            {"k_x", "k_x [1/s²]"},
                                                            {"polarisation", "polarisation"},
                                                            {"nearest_ratio", "d/Poisson"},
                                                            {"kurtosis", "kurtosis a"}};
  std::vector<Shown> out;
  for (std::size_t k = 0; k < c.recording.panel.items.size(); ++k) {
    const std::string& key = c.recording.panel.items[k].key;
    if (const auto at = titles.find(key); at != titles.end()) out.push_back({k, std::string(at->second), false});
    if (key.starts_with(kGroup)) out.push_back({k, fmt::format("drift [{}]", c.recording.data.unit), true});
  }
  return out;
}

// A few of the observables that were not fitted, the recording in the first row.
std::string panel_text(const Comparison& c, TextStyle style) {
  if (c.recording.panel.recording.empty()) return {};
  const auto shown = shown_of_panel(c);
  std::vector<Align> align(shown.size() + 1, Align::right);
  align.front() = Align::left;
  TextTable table(align, style);
  std::vector<std::string> head = {"not fitted"};
  for (const Shown& s : shown) head.push_back(s.title);
  table.row(head, Paint::bold);
  const auto row = [&](const std::string& name, const std::vector<Estimate>& values, Paint paint) {
    std::vector<std::string> cells = {name};
    for (const Shown& s : shown) {
      const double value = s.item < values.size() ? values[s.item].value : kNaN;
      cells.push_back(rounded(s.root ? std::sqrt(value) : value, 2));
    }
    table.row(cells, paint);
  };
  row("recording", c.recording.panel.recording, Paint::plain);
  for (const ModelFit& r : c.models) row(r.model, r.likeness.panel, r.standing.rank == 1 ? Paint::good : Paint::plain);
  return '\n' + table.folded();
}

// The fitted parameters of every model; those with a posterior are shown with it.
std::string parameters_text(const Comparison& c, TextStyle style) {
  std::vector<std::string> fits;
  for (const ModelFit& r : c.models)
    if (const std::string values = fitted_values(r); !values.empty() && r.posterior.simulations == 0)
      fits.push_back(r.model + ": " + values);
  std::vector<std::string> likely, regressed;
  for (const ModelFit& r : c.models) {
    if (const std::string values = most_likely_values(r); !values.empty()) likely.push_back(r.model + ": " + values);
    if (const std::string values = regressed_values(r); !values.empty()) regressed.push_back(r.model + ": " + values);
  }
  return bullets("Maximum likelihood, 95 % intervals in brackets", likely, Paint::bold, style) +
         bullets("Regression of accelerations, 95 % intervals in brackets", regressed, Paint::bold, style) +
         bullets(c.recording.hold_out.used() ? "Fitted parameters (in brackets: range of the fits to halves)" : "Fitted parameters", fits,
                 Paint::bold, style);
}

// What the recording says about the parameters of every model that has a posterior.
std::string posterior_text(const Comparison& c, TextStyle style) {
  std::string out;
  for (const ModelFit& r : c.models) {
    if (r.posterior.simulations == 0) continue;
    TextTable table({Align::left, Align::right, Align::right, Align::right, Align::left, Align::left, Align::left}, style);
    table.row({r.model, "best", "median", "95 %", "unit", "verdict", "correlated with"}, Paint::bold);
    for (const ParameterResult& p : r.parameters)
      if (!p.posterior.verdict.empty())
        table.row({p.name, rounded(p.value), rounded(p.posterior.median), interval_text(p.posterior), unit_in_print(p.unit),
                   verdict_text(p), partner_text(p.posterior)},
                  p.posterior.verdict == "flat" ? Paint::dim : Paint::plain);
    out += '\n' + table.folded();
  }
  if (!out.empty()) out += paragraph(what_posteriors_mean(), " ");
  return out;
}

std::string shapes_of(const Comparison& c, TextStyle style) {
  Shapes s{{{"recording", &c.recording.distributions}},
           c.recording.columns,
           c.recording.axis_lower,
           c.recording.axis_width,
           c.recording.data.unit};
  for (const ModelFit& r : c.models) s.rows.push_back({r.model, &r.runs.distributions, paint_of(r)});
  const std::string text = shapes_text(s, 0, "distribution", style);
  return text.empty() ? text : '\n' + text + paragraph(what_shapes_mean(c.recording.binning), " ");
}

// What the marks behind names mean, where there are any.
std::string legend(const Comparison& c) {
  const auto any = [&](const auto& what) {
    return std::any_of(c.models.begin(), c.models.end(), [&](const ModelFit& r) { return !what(r).empty(); });
  };
  std::string out;
  if (any(contradictions)) out += " ! contradicted by simple observables, whatever its rank\n";
  if (any(at_bounds)) out += " * ended on a bound of its search\n";
  return out;
}

std::vector<std::string> failures(const Comparison& c) {
  std::vector<std::string> out;
  for (const ModelFit& r : c.models)
    if (r.search.failed_simulations > 0)
      out.push_back(fmt::format("{}: {} of {} simulations", r.model, counted(r.search.failed_simulations), counted(r.search.simulations)));
  return out;
}

// What the page shows as well.
std::string details(const Comparison& c, TextStyle style) {
  std::vector<std::string> models;
  for (const ModelFit& r : c.models)
    if (!r.summary.empty()) models.push_back(r.model + ": " + r.summary);
  std::string out = bullets("Models", models, Paint::bold, style) + parameters_text(c, style);
  if (const std::string fixed = kept_fixed(c); !fixed.empty()) out += paragraph("kept fixed: " + fixed, " ");
  out += paragraph("steps per frame: " + steps_taken(c), " ");
  out += energy_tables(c, style);
  out += paragraph("energy: " + what_energy_means(c), " ");
  if (const std::string error_dominated = what_drowned_means(c); !error_dominated.empty()) out += paragraph(error_dominated, " ");
  if (const std::string lags = lag_weights(c) + lags_measured(c); !lags.empty()) out += paragraph(lags, " ");
  out += shapes_of(c, style);
  out += panel_text(c, style);
  out += posterior_text(c, style);
  out += bullets("In brackets: not in the score", left_out(c, style), Paint::bold, style);
  return out + bullets("Simulations that diverged (counted as the worst energy)", failures(c), Paint::warning, style);
}

// The gravest, or all by gravity.
std::string warnings(const Comparison& c, TextStyle style, Detail detail) {
  constexpr std::size_t kFew = 3;
  std::string out;
  if (detail == Detail::all) {
    for (const Gravity gravity : {Gravity::claim, Gravity::result, Gravity::meaning, Gravity::note}) {
      std::vector<std::string> some;
      for (const Warning& w : c.warnings)
        if (w.gravity == gravity) some.push_back(w.text);
      out += bullets(std::string(gravity_title(gravity)), some, gravity == Gravity::note ? Paint::bold : Paint::warning, style);
    }
    return out;
  }
  const std::size_t shown = std::min(kFew, c.warnings.size());
  const std::vector<std::string> gravest(c.warnings.begin(), c.warnings.begin() + static_cast<std::ptrdiff_t>(shown));
  out += bullets(c.warnings.size() > shown ? fmt::format("Warnings (the gravest {} of {})", shown, c.warnings.size()) : "Warnings", gravest,
                 Paint::warning, style);
  return out + '\n' + paragraph("All warnings, energies and parameters: report.html, or --verbose.");
}

}  // namespace

std::string ranking_text(const Comparison& c, TextStyle style, Detail detail) {
  const Headline answer = headline(c);
  std::string out = paragraph(data_line(c.recording.data)) + '\n';
  out += paint(wrapped(printable(answer.sentence), kTextWidth), Paint::bold, style) + '\n';
  out += paragraph(answer.detail) + '\n';
  out += ranking_lines(c, style);
  out += legend(c);
  if (const std::string ranks = what_ranks_mean(c); !ranks.empty()) out += paragraph(ranks, " ");
  if (const std::string scores = what_held_out_means(c); !scores.empty()) out += paragraph(scores, " ");
  if (const std::string skill = what_skill_means(c); !skill.empty()) out += paragraph("skill: " + skill, " ");
  if (detail == Detail::all) out += details(c, style);
  out += warnings(c, style, detail);
  return finished(std::move(out), style);
}

std::string weights_text(const WeighedTable& table, TextStyle style) {
  std::vector<Align> align = {Align::left, Align::right};
  align.insert(align.end(), table.metrics.size(), Align::right);
  TextTable t(align, style);
  std::vector<std::string> head = {"model", "score"}, weights = {"weight", ""};
  for (std::size_t j = 0; j < table.metrics.size(); ++j) {
    head.push_back(printable(table.metrics[j]));
    weights.push_back(fixed(table.weighting.weights[j], 4));
  }
  t.row(head, Paint::bold);
  for (std::size_t i = 0; i < table.models.size(); ++i) {
    std::vector<std::string> cells = {printable(table.models[i]), fixed(table.scores[i], 4)};
    for (Index j = 0; j < table.energies.cols(); ++j) cells.push_back(rounded(table.energies(static_cast<Index>(i), j), 4));
    t.row(cells);
  }
  t.row(weights, Paint::dim);
  return finished(t.text(), style);
}

}  // namespace swarmfit
