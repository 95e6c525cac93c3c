// SPDX-License-Identifier: MIT
// Intervals against the truth, one drawing per parameter of a recovery.
#include <fmt/format.h>

#include <algorithm>

#include "reports/axis.h"
#include "reports/number.h"
#include "reports/parameter_recovery_html.h"

namespace swarmfit {
namespace {

constexpr double kLeft = 58, kTop = 8, kWidth = 312, kHeight = 212, kRight = kLeft + kWidth, kBottom = kTop + kHeight;

// Both axes of a drawing in physical units.
struct Frame {
  plot::Axis truth, found;
  double x(double value) const { return kLeft + kWidth * std::clamp(truth.place(value), 0.0, 1.0); }
  double y(double value) const { return kBottom - kHeight * std::clamp(found.place(value), 0.0, 1.0); }
};

Frame frame_of(const ParameterRecovery& r, std::size_t k, const Parameter& row) {
  plot::Range truth, found;
  for (const ParameterCase& c : r.cases) {
    truth.include(c.truth[k]);
    for (const double value : {c.truth[k], c.found[k].lower, c.found[k].median, c.found[k].upper}) found.include(value);
  }
  if (row.log && found.lower > 0) return {plot::logarithmic(truth.lower, truth.upper), plot::logarithmic(found.lower, found.upper)};
  return {plot::linear(truth.lower, truth.upper, {4, 0, false}), plot::linear(found.lower, found.upper, {4, 0, false})};
}

std::string line(const char* look, double x1, double y1, double x2, double y2) {
  return fmt::format("<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>", look, x1, y1, x2, y2);
}

std::string label(const plot::Tick& tick) { return tick.label.markup; }  // of svg::Text, which is safe markup

std::string axes(const Frame& f, const std::string& unit) {
  std::string out = line("frame", kLeft, kBottom, kRight, kBottom) + line("frame", kLeft, kTop, kLeft, kBottom);
  for (const plot::Tick& t : f.truth.ticks)
    out += line("frame", f.x(t.value), kBottom, f.x(t.value), kBottom + 4) +
           fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>", f.x(t.value), kBottom + 17, label(t));
  for (const plot::Tick& t : f.found.ticks)
    out += line("frame", kLeft - 4, f.y(t.value), kLeft, f.y(t.value)) +
           fmt::format("<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>", kLeft - 7, f.y(t.value) + 4, label(t));
  return out + fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">true value{}</text>", kLeft + kWidth / 2, kBottom + 34,
                           unit.empty() ? "" : html_escaped(" [" + unit_in_print(unit) + ']'));
}

// Where found and true value are equal, as far as both axes go; straight, since both have the same scale.
std::string diagonal(const Frame& f) {
  const double from = std::max(f.truth.lower, f.found.lower), to = std::min(f.truth.upper, f.found.upper);
  return from < to ? line("equal", f.x(from), f.y(from), f.x(to), f.y(to)) : "";
}

std::string interval(const Frame& f, const ParameterCase& c, std::size_t k) {
  const ParameterInterval& p = c.found[k];
  const bool holds = p.lower <= c.truth[k] && c.truth[k] <= p.upper;
  const double x = f.x(c.truth[k]), y = f.y(c.truth[k]);
  std::string out =
      fmt::format("<g class=\"{}\"><title>seed {}: true value {}, median {}, 95 % from {} to {}</title>", holds ? "holds" : "misses",
                  c.seed, rounded(c.truth[k]), rounded(p.median), rounded(p.lower), rounded(p.upper));
  out += line("reach", x, f.y(p.lower), x, f.y(p.upper));
  out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.4\"/>", x, f.y(p.median));
  if (!holds) out += line("cross", x - 4, y - 4, x + 4, y + 4) + line("cross", x - 4, y + 4, x + 4, y - 4);
  return out + "</g>\n";
}

}  // namespace

Html intervals_drawing(const ParameterRecovery& r, std::size_t k, const std::string& length_unit) {
  const ModelChoice model = parse_model(r.model);
  const Parameter& row = model.spec->parameters[r.cases.front().found[k].row];
  const Frame f = frame_of(r, k, row);
  const ParameterCoverage& p = r.parameters[k];
  std::string out = fmt::format(
      "<svg class=\"recovered\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"95 % intervals of {} against its true value: {} of {} hold "
      "it\">",
      kRight + 10, kBottom + 40, html_escaped(p.name), p.covered, p.recordings);
  out += axes(f, to_string(row.unit, length_unit)) + diagonal(f);
  for (const ParameterCase& c : r.cases) out += interval(f, c, k);
  return {out + "</svg>"};
}

}  // namespace swarmfit
