// SPDX-License-Identifier: MIT
// The first screen, and the pictures: which model, how sure, where it misses, what it looks like.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libtrack/nan.h"
#include "reports/comparison/figure_parts.h"
#include "reports/comparison/html_sections.h"
#include "reports/comparison/words.h"
#include "reports/draw/inline_svg.h"
#include "reports/write/number.h"
#include "reports/write/plain_text.h"

namespace swarmfit::sections {

namespace {

using Cells = std::vector<HtmlTable::Cell>;

constexpr int kShades = 5;  // as in report.css

// What a model is; of a variant beside its base, what sets it apart.
std::string description(const Comparison& c, const ModelFit& r) {
  const auto end = r.summary.find(". ");
  const std::string base = r.model.substr(0, r.model.find('['));
  const bool beside = std::any_of(c.models.begin(), c.models.end(), [&](const ModelFit& other) { return other.model == base; });
  return end == std::string::npos || !beside || base == r.model ? r.summary : r.summary.substr(0, end);
}

struct Scale {
  double lower = 0, upper = 0;
  void include(double x) {
    if (std::isfinite(x)) lower = std::min(lower, x), upper = std::max(upper, x);
  }
};

// Score relative to the best, and the interval of that difference.
struct Difference {
  double value = kNaN, lower = kNaN, upper = kNaN;
};

Difference difference(const Comparison& c, std::size_t k) {
  if (k == 0) return {0, kNaN, kNaN};
  const Certainty& sure = c.models[k].standing.certainty;
  return {c.models[k].standing.score - c.models.front().standing.score, -sure.lead_upper, -sure.lead_lower};
}

Html fit_verdict(const Comparison& c, const ModelFit& r) {
  const Certainty& sure = r.standing.certainty;
  if (!std::isfinite(sure.gof_q)) return escaped(kUndefined);
  const std::string p = fit_p(c, r);
  const bool rejected = sure.gof_q <= 0.05;
  return element("span", rejected ? "flag" : "good",
                 escaped(fmt::format("{} (p {}{})", rejected ? "rejected" : "not rejected", p.starts_with("≤") ? "" : "= ", p)));
}

// How far an energy is beyond what a true model would have, 0 to kShades.
int shade(const Comparison& c, const ModelFit& r, std::size_t m) {
  const double energy = r.runs.raw_energies[m], own = m < r.standing.certainty.own.size() ? r.standing.certainty.own[m] : kNaN;
  if (!std::isfinite(energy)) return 0;
  // A model without noise repeats its own recordings: energies of rounding.
  const double least = 1e-3 * worst_energy(c.recording.binning);
  // One shade from 1.5 times the expected energy on, or from 1/32 of the largest possible, and one more with every doubling.
  const double level =
      std::isfinite(own) ? std::log2(energy / std::max(own, least) / 1.5) + 1 : std::log2(energy / worst_energy(c.recording.binning)) + 6;
  return std::clamp(static_cast<int>(std::floor(level)), 0, kShades);
}

// +1: the model's values are too large, or too widely spread about zero; −1: too small; 0: neither.
int direction(const Comparison& c, const ModelFit& r, std::size_t m) {
  constexpr double kSame = 0.02;
  const bool about_zero = c.recording.columns[m].metric == kAngularAcceleration;
  const double ratio = about_zero ? r.runs.sd_ratio[m] : r.runs.mean_ratio[m];
  return !std::isfinite(ratio) || std::abs(ratio - 1) < kSame ? 0 : ratio > 1 ? 1 : -1;
}

HtmlTable::Cell misfit_cell(const Comparison& c, const ModelFit& r, std::size_t m) {
  constexpr const char* kArrows[] = {" ▼", "", " ▲"};
  const int way = direction(c, r, m), level = shade(c, r, m);
  const std::string look = level == 0 ? "mid" : fmt::format("mid {} q{}", way > 0 ? "wrong" : way < 0 ? "right" : "neither", level);
  const double own = m < r.standing.certainty.own.size() ? r.standing.certainty.own[m] : kNaN;
  return {.content = escaped(fixed(r.runs.raw_energies[m], 2) + (level > 0 ? kArrows[way + 1] : "")),
          .soft = !counts(c, m),
          .also = look,
          .note = std::isfinite(own) ? fmt::format("expected if {} were true: {}", r.model, fixed(own, 2)) : std::string()};
}

Html model_name(const Comparison& c, std::size_t k) {
  Html out = key_drawing(k);
  out += escaped(c.models[k].model);
  return out;
}

// Letters only: what is within the drawing must not be called as in another one.
std::string prefix_of(const std::string& name) {
  std::string out = "fig";
  for (const char ch : name) out += ch >= '0' && ch <= '9' ? static_cast<char>('a' + (ch - '0')) : ch == '_' ? 'x' : ch;
  return out;
}

Html svg_figure(const Figure& f, const std::string& title) {
  if (f.svg.empty()) return {};
  Html out = title.empty() ? Html{} : element("h3", "", escaped(title));
  out += sheet_of(f.svg, prefix_of(f.name));
  out += element("figcaption", "", escaped(f.caption));
  return element("figure", "wide", out);
}

}  // namespace

Html result_figure(const Comparison& c) {
  if (c.models.size() < 2 && (c.models.empty() || c.models.front().summary.empty())) return {};
  HtmlTable table("Models, best first");
  table.look("verdicts frozen");
  const bool paired = c.models.size() > 1;
  Cells head{column("model")};
  if (paired) head.insert(head.end(), {column("score relative to the best, 95 % interval of the difference"), column("group")});
  head.insert(head.end(), {column("fit to the recording")});
  table.head(head);
  Scale scale;
  for (std::size_t k = 0; k < c.models.size(); ++k)
    for (const double x : {difference(c, k).value, difference(c, k).lower, difference(c, k).upper}) scale.include(x);
  for (std::size_t k = 0; k < c.models.size(); ++k) {
    const ModelFit& r = c.models[k];
    Html name = model_name(c, k);
    if (const std::string what = description(c, r); !what.empty()) name += element("span", "what", escaped(what));
    Cells cells{name_cell(name)};
    if (paired) {
      const Difference d = difference(c, k);
      Html drawn = interval_drawing(d.value, d.lower, d.upper, scale.lower - 0.02, scale.upper + 0.02, k);
      drawn += element("span", "n", escaped(k == 0 ? "best" : in_print(fixed(d.value, 2))));
      cells.insert(cells.end(), {{.content = drawn, .also = "lead-cell"}, text_cell(group_letter(r))});
    }
    cells.push_back({.content = fit_verdict(c, r)});
    table.row(cells, r.standing.rank == 1 ? "first" : "");
  }
  Html out = table.html();
  if (paired && c.ranking.bootstrap_recordings > 0)
    out += element("p", "note",
                   markup("Models with the same letter are not distinguishable. Rejected: few recordings simulated from the fitted "
                          "model are as far from the model as yours is."));
  return out;
}

Html strip(const Comparison& c) { return svg_figure(parts::trajectory_strip(c), ""); }

Html heat_map(const Comparison& c) {
  if (c.models.empty()) return {};
  HtmlTable table("Energy of every model in every metric");
  table.look("frozen heat");
  Cells head{column("model")};
  for (std::size_t m = 0; m < c.recording.columns.size(); ++m) {
    const Column& col = c.recording.columns[m];
    head.push_back({.content = escaped(fmt::format("{} {}", col.name(), marked(c, m, col.symbol()))),
                    .head = true,
                    .soft = !counts(c, m),
                    .also = "mid"});
  }
  table.head(head);
  for (std::size_t k = 0; k < c.models.size(); ++k) {
    Cells cells{name_cell(model_name(c, k))};
    for (std::size_t m = 0; m < c.recording.columns.size(); ++m) cells.push_back(misfit_cell(c, c.models[k], m));
    table.row(cells);
  }
  Cells weights{name_cell(markup("weight in the score"))};
  for (std::size_t m = 0; m < c.recording.columns.size(); ++m)
    weights.push_back({.content = escaped(counts(c, m) ? fixed(c.ranking.weights[m], 2) : kUndefined), .also = "mid"});
  table.foot(weights);
  Html out = table.html();
  const bool expected = c.ranking.bootstrap_recordings > 0;
  const PerColumn<bool>& used = c.recording.observation.used;
  const bool bracketed = std::any_of(used.begin(), used.end(), [](bool u) { return !u; });
  out += element("p", "note",
                 escaped(fmt::format(
                     "Energy: {}. ▲ orange: the model's values are too large (α: too widely spread); ▼ blue: too small; grey: equal mean, "
                     "wrong shape. The darker, the larger the energy{}.{}",
                     what_energy_means(c),
                     expected ? " relative to the energy expected if the model were true (unshaded: less than about 1.5 times)"
                              : " relative to its maximum",
                     bracketed ? " In brackets: not in the score." : "")));
  if (const std::string error_dominated = what_drowned_means(c); !error_dominated.empty())
    out += element("p", "note", escaped(error_dominated));
  out += svg_figure(parts::energies(c), "");
  return out;
}

Html pictures(const Comparison& c) {
  Html out = svg_figure(parts::neighbours(c), "Where are the neighbours?");
  out += svg_figure(parts::responses(c), "How do animals respond to them?");
  out += svg_figure(parts::curves(c), "How does motion decay with delay and distance?");
  out += svg_figure(parts::order(c), "How ordered is the group?");
  out += svg_figure(parts::space(c), "Where do they go?");
  return out;
}

Html forces_figure(const Comparison& c) { return svg_figure(parts::forces(c), ""); }

Html quality(const Comparison& c) { return svg_figure(parts::data_quality(c), ""); }

Html convergence(const Comparison& c) { return svg_figure(parts::convergence(c), ""); }

Html posteriors(const Comparison& c) {
  Html out;
  for (std::size_t k = 0; k < c.models.size(); ++k) out += svg_figure(parts::posterior(c, k), "Posterior of " + c.models[k].model);
  return out;
}

}  // namespace swarmfit::sections
