// SPDX-License-Identifier: MIT
// The posterior of one model: marginals on the diagonal, pairs below it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/results/axis_scale.h"
#include "reports/comparison/figure_parts.h"
#include "reports/write/number.h"
#include "reports/write/unit_text.h"

namespace swarmfit::parts {
namespace {

constexpr std::size_t kMostParameters = 7, kBins = 20, kMostPoints = 400;
constexpr double kLabel = 62, kGap = 5;

// Between the bounds, 0 to 1, on the axis of the search.
double place(const ParameterResult& p, double value) { return place_on(scale_of(p.log, p.lower), p.lower, p.upper, value); }

struct Corner {
  const ModelFit& fit;
  std::vector<const ParameterResult*> parameters;  // searched, those that are drawn
  std::vector<std::size_t> at;                     // of these in a point of the sample
};

Corner corner_of(const ModelFit& r) {
  Corner out{r, {}, {}};
  std::size_t searched = 0;
  for (const ParameterResult& p : r.parameters) {
    if (!p.fitted) continue;
    if (out.parameters.size() < kMostParameters && p.upper > p.lower) out.parameters.push_back(&p), out.at.push_back(searched);
    ++searched;
  }
  return out;
}

void draw_marginal(svg::Sheet& sheet, const svg::Box& box, const Corner& c, std::size_t k, std::size_t series) {
  std::vector<double> share(kBins, 0);
  for (std::size_t n = 0; n < c.fit.posterior.sample.size(); ++n) {
    const double at = place(*c.parameters[k], c.fit.posterior.sample[n][c.at[k]]);
    if (std::isfinite(at)) share[static_cast<std::size_t>(std::clamp(at * kBins, 0.0, kBins - 1.0))] += c.fit.posterior.weight[n];
  }
  const double most = std::max(1e-12, *std::max_element(share.begin(), share.end()));
  const double step = box.width / kBins;
  for (std::size_t b = 0; b < kBins; ++b)
    if (share[b] > 0)
      sheet.rectangle({box.left + static_cast<double>(b) * step, box.bottom() - 0.95 * box.height * share[b] / most, step + 0.05,
                       0.95 * box.height * share[b] / most},
                      plot::look(series).colour, {"none", 0, ""});
}

void draw_pair(svg::Sheet& sheet, const svg::Box& box, const Corner& c, std::size_t x, std::size_t y, std::size_t series) {
  const std::size_t every = std::max<std::size_t>(1, c.fit.posterior.sample.size() / kMostPoints);
  std::string dots;
  for (std::size_t n = 0; n < c.fit.posterior.sample.size(); n += every) {
    const std::vector<double>& point = c.fit.posterior.sample[n];
    const double across = place(*c.parameters[x], point[c.at[x]]), up = place(*c.parameters[y], point[c.at[y]]);
    if (std::isfinite(across + up))
      dots += fmt::format("M{:.1f} {:.1f}h.8v.8h-.8z", box.left + box.width * across, box.bottom() - box.height * up);
  }
  sheet.path(dots, {"none", 0, ""}, plot::look(series).colour);
}

void draw_best(svg::Sheet& sheet, const svg::Box& box, const ParameterResult& p) {
  const double x = box.left + box.width * place(p, p.value);
  if (std::isfinite(x)) sheet.line({x, box.top}, {x, box.bottom()}, {svg::kInk, 0.6, "2 1.5"});
}

}  // namespace

Figure posterior(const Comparison& c, std::size_t k) {
  const ModelFit& r = c.models[k];
  const std::string name = fmt::format("posterior_{}", k + 1);
  const Corner corner = corner_of(r);
  const std::size_t n = corner.parameters.size();
  if (r.posterior.sample.empty() || n == 0) return {name, "", ""};
  svg::Sheet sheet(n > 3 ? svg::kTwoColumns : svg::kOneColumn);
  const double side = (sheet.width() - kLabel) / static_cast<double>(n) - kGap;
  for (std::size_t row = 0; row < n; ++row) {
    const ParameterResult& p = *corner.parameters[row];
    for (std::size_t column = 0; column <= row; ++column) {
      const svg::Box box{kLabel + static_cast<double>(column) * (side + kGap), 4 + static_cast<double>(row) * (side + kGap), side, side};
      column == row ? draw_marginal(sheet, box, corner, row, k) : draw_pair(sheet, box, corner, column, row, k);
      if (column == row) draw_best(sheet, box, p);
      sheet.rectangle(box, "none", {svg::kFaint, 0.5, ""});
    }
    const double y = 4 + static_cast<double>(row) * (side + kGap) + side / 2;
    sheet.text({kLabel - 5, y}, svg::plain(p.symbol.empty() ? p.name : p.symbol), svg::Anchor::end);
    if (!p.unit.empty()) sheet.text({kLabel - 5, y + 9}, svg::plain(unit_in_print(p.unit)), svg::Anchor::end, svg::kSoft);
    const double left = kLabel + static_cast<double>(row) * (side + kGap), base = 4 + static_cast<double>(n) * (side + kGap) + 5;
    sheet.text({left, base}, svg::plain(rounded(p.lower, 2)), svg::Anchor::start, svg::kSoft);
    sheet.text({left + side, base}, svg::plain(rounded(p.upper, 2)), svg::Anchor::end, svg::kSoft);
  }
  const std::string caption = fmt::format(
      "Posterior of {}: marginals, and below them every pair, between the bounds of the search on its own axis (linear, logarithmic or "
      "square root). Dashed: best value of the search.",
      r.model);
  return {name, caption, sheet.document(4 + static_cast<double>(n) * (side + kGap) + 10, "Posterior of " + r.model, caption)};
}

}  // namespace swarmfit::parts
