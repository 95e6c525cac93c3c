// SPDX-License-Identifier: MIT
// How the search went, and where it ended.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/results/axis_scale.h"
#include "libtrack/nan.h"
#include "reports/comparison/figure_parts.h"
#include "reports/comparison/words.h"
#include "reports/write/number.h"
#include "reports/write/plain_text.h"

namespace swarmfit::parts {
namespace {

using svg::Anchor;

// ---- convergence ----------------------------------------------------------------------------------------------------------------

// A hole between passes: scores under different weights are not to be joined.
plot::Curve best_so_far(const ModelFit& r) {
  plot::Curve out;
  for (std::size_t k = 0; k < r.search.convergence.size(); ++k) {
    const ConvergencePoint& p = r.search.convergence[k];
    if (k > 0 && r.search.convergence[k - 1].pass != p.pass) out.push_back({static_cast<double>(p.evaluations), kNaN});
    out.push_back({static_cast<double>(p.evaluations), p.best});
  }
  return out;
}

// ---- parameters: a block per model, a row per parameter -------------------------------------------------------------------------

constexpr double kRow = 10, kBlockHead = 13, kBlockFoot = 30;

// Between the bounds, 0 to 1, on the axis along which it was searched (docs/search.md).
double place_of(const ParameterResult& p, double value) {
  return p.upper > p.lower ? place_on(scale_of(p.log, p.lower), p.lower, p.upper, value) : kNaN;
}

std::vector<const ParameterResult*> fitted(const ModelFit& r) {
  std::vector<const ParameterResult*> out;
  for (const ParameterResult& p : r.parameters)
    if (p.fitted) out.push_back(&p);
  return out;
}

double block_height(const ModelFit& r) { return kBlockHead + kRow * static_cast<double>(fitted(r).size()) + kBlockFoot; }

bool any_posterior(const Comparison& c) {
  return std::any_of(c.models.begin(), c.models.end(), [](const ModelFit& r) { return r.posterior.simulations > 0; });
}

std::string value_text(const ParameterResult& p) {
  std::string out = rounded(p.value) + (p.at_bound ? " *" : "");
  if (!p.posterior.verdict.empty()) out += fmt::format(" ({})", interval_text(p.posterior));
  return in_print(out);
}

std::string name_text(const ParameterResult& p) { return p.unit.empty() ? p.name : fmt::format("{} [{}]", p.name, unit_in_print(p.unit)); }

// Of the text beside the plots, alike in all blocks.
struct Widths {
  double names = 30, values = 20;
};

Widths widths(const Comparison& c) {
  constexpr double kWiderFont = 1.1;
  Widths out;
  for (const ModelFit& r : c.models)
    for (const ParameterResult* p : fitted(r)) {
      out.names = std::max(out.names, kWiderFont * svg::plain(name_text(*p)).width);
      out.values = std::max(out.values, kWiderFont * svg::plain(value_text(*p)).width);
    }
  return out;
}

void draw_block(svg::Sheet& sheet, const ModelFit& r, std::size_t k, const svg::Box& at, const Widths& text) {
  const auto rows = fitted(r);
  const auto count = static_cast<double>(rows.size());
  sheet.text({at.left + 2, at.top + 9}, svg::plain(r.model));
  const svg::Box box{at.left + 8 + text.names, at.top + kBlockHead, std::max(30.0, at.width - text.names - text.values - 22), kRow * count};
  plot::Axis x;
  x.ticks = {{0, svg::plain("lower")}, {1, svg::plain("upper")}};
  plot::Panel panel(sheet, box, x, plot::linear(0, count));
  for (std::size_t j = 0; j < rows.size(); ++j) {
    const ParameterResult& p = *rows[j];
    const double y = count - static_cast<double>(j) - 0.5, base = panel.place({0, y}).y + 2.5;
    panel.across(y, 0, 1, {svg::kFaint, 0.4, ""});
    panel.across(y, place_of(p, p.posterior.lower), place_of(p, p.posterior.upper), {plot::look(k).colour, 1.4, ""});
    panel.marker({place_of(p, p.value), y}, k);
    sheet.text({at.left + 2, base}, svg::plain(name_text(p)));
    sheet.text({at.left + at.width - 4, base}, svg::plain(value_text(p)), Anchor::end);
  }
  panel.x_axis(svg::plain("bounds of the search"));
}

}  // namespace

Figure convergence(const Comparison& c) {
  plot::Range across, up;
  std::vector<std::string> absent;
  for (const ModelFit& r : c.models) {
    bool any = false;
    for (const ConvergencePoint& p : r.search.convergence) {
      if (!std::isfinite(p.best)) continue;
      any = true;
      across.include(static_cast<double>(p.evaluations));
      up.include(p.best);
    }
    if (!any) absent.push_back(r.model);
  }
  if (up.empty()) return {"convergence", "", ""};
  svg::Sheet sheet(svg::kOneColumn);
  const double top = plot::legend_rows(sheet, 4, sheet.width(), 9, model_entries(c, plot::Sample::line)) + 8;
  const svg::Box box{26, top, sheet.width() - 36, 112};
  const double room = 0.04 * (up.upper - up.lower);
  const plot::Axis x = plot::linear(0, across.upper, {5, box.width, true}),
                   y = plot::linear(up.lower - room, up.upper + room, {5, 0, false});
  plot::Panel panel(sheet, box, x, y);
  for (std::size_t k = c.models.size(); k-- > 0;) panel.steps(best_so_far(c.models[k]), k);
  panel.x_axis(svg::plain("candidates simulated") + plot::in_units(x, ""));
  panel.y_axis({});
  sheet.text({4, top - 5}, svg::plain("best score so far"));
  double height = box.bottom() + 24;
  const std::string missing = absent.empty() ? std::string() : fmt::format("No finite score: {}.", enumerate(absent));
  if (!missing.empty()) height = sheet.note(height + 8, missing) - 4;
  const std::string caption = fmt::format(
      "Best score so far against the number of candidates simulated, per model. Weights differ between passes of the calibration, so each "
      "pass "
      "is a line of its own.{}{}",
      missing.empty() ? "" : " ", missing);
  return {"convergence", caption, sheet.document(height, "Convergence of the searches", caption)};
}

Figure parameters(const Comparison& c) {
  double total = 0;
  std::size_t blocks = 0;
  for (const ModelFit& r : c.models)
    if (!fitted(r).empty()) total += block_height(r), ++blocks;
  if (blocks == 0) return {"parameters", "", ""};
  // Two columns of blocks, filled from the top: the left one takes those that end in its half.
  svg::Sheet sheet(blocks > 1 ? svg::kTwoColumns : svg::kOneColumn);
  const double between = 12, column = blocks > 1 ? (sheet.width() - between) / 2 : sheet.width();
  const Widths text = widths(c);
  svg::Box at{0, 0, column, 0};
  double height = 0, done = 0;
  for (std::size_t k = 0; k < c.models.size(); ++k) {
    const ModelFit& r = c.models[k];
    if (fitted(r).empty()) continue;
    at.height = block_height(r);
    if (at.left == 0 && blocks > 1 && done > 0 && done + 0.5 * at.height > 0.5 * total) at.left = column + between, at.top = 0;
    draw_block(sheet, r, k, at, text);
    at.top += at.height;
    done += at.height;
    height = std::max(height, at.top);
  }
  const std::string caption = fmt::format(
      "Fitted parameters between the bounds of their search, along the axis of the search (logarithmic or, from 0 on, square root). Marker "
      "and first number: best value; * on a bound.{}",
      any_posterior(c) ? " Bars and brackets: central 95 % of the posterior." : "");
  return {"parameters", caption, sheet.document(height - 4, "Fitted parameters", caption)};
}

}  // namespace swarmfit::parts
