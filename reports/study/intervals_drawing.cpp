// SPDX-License-Identifier: MIT
// Intervals against the truth, one drawing per parameter of a recovery.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/results/axis_scale.h"
#include "reports/draw/axis.h"
#include "reports/study/parameter_recovery_html.h"
#include "reports/write/number.h"

namespace swarmfit {
namespace {

// In points, as plot's labels are; the page stretches the drawing.
constexpr double kLeft = 34, kTop = 15, kWidth = 162, kHeight = 108, kRight = kLeft + kWidth, kBottom = kTop + kHeight;
constexpr double kTick = 2.5;

// Both axes of a drawing in physical units, scaled as the search's axis is: linear, logarithmic, or by square roots.
struct Frame {
  plot::Axis truth, found;
  double x(double value) const { return kLeft + kWidth * std::clamp(truth.place(value), 0.0, 1.0); }
  double y(double value) const { return kBottom - kHeight * std::clamp(found.place(value), 0.0, 1.0); }
};

// A little wider than what is drawn, so that nothing lies on the frame; not below zero where there are square roots.
plot::Axis axis_of(const plot::Range& range, AxisScale scale, double room) {
  constexpr double kMargin = 0.05;
  if (scale == AxisScale::logarithmic) {
    const double more = std::pow(range.upper / range.lower, kMargin);
    return plot::logarithmic(range.lower / more, range.upper * more);
  }
  const double more = kMargin * (range.upper - range.lower), lower = range.lower - more;
  const bool root = scale == AxisScale::root;
  plot::Axis axis = plot::linear(root ? std::max(lower, 0.0) : lower, range.upper + more, {4, room, true});
  axis.root = root;
  return axis;
}

Frame frame_of(const ParameterRecovery& r, std::size_t k) {
  plot::Range truth, found;
  for (const ParameterCase& c : r.cases) {
    truth.include(c.truth[k]);
    for (const double value : {c.truth[k], c.found[k].lower, c.found[k].median, c.found[k].upper}) found.include(value);
  }
  AxisScale scale = r.parameters[k].scale;
  if ((scale == AxisScale::logarithmic && found.lower <= 0) || (scale == AxisScale::root && found.lower < 0)) scale = AxisScale::linear;
  return {axis_of(truth, scale, kWidth), axis_of(found, scale, 0)};
}

std::string line(const char* look, double x1, double y1, double x2, double y2) {
  return fmt::format("<line class=\"{}\" x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\"/>", look, x1, y1, x2, y2);
}

std::string label(const plot::Tick& tick) { return tick.label.markup; }  // of svg::Text, which is safe markup

std::string axes(const Frame& f, const std::string& unit) {
  std::string out = line("frame", kLeft, kBottom, kRight, kBottom) + line("frame", kLeft, kTop, kLeft, kBottom);
  for (const plot::Tick& t : f.truth.ticks)
    out += line("frame", f.x(t.value), kBottom, f.x(t.value), kBottom + kTick) +
           fmt::format("<text x=\"{:.2f}\" y=\"{}\" text-anchor=\"middle\">{}</text>", f.x(t.value), kBottom + 10.5, label(t));
  for (const plot::Tick& t : f.found.ticks)
    out += line("frame", kLeft - kTick, f.y(t.value), kLeft, f.y(t.value)) +
           fmt::format("<text x=\"{}\" y=\"{:.2f}\" text-anchor=\"end\">{}</text>", kLeft - 4.5, f.y(t.value) + 2.5, label(t));
  out += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">true value{}</text>", kLeft + kWidth / 2, kBottom + 20.5,
                     plot::in_units(f.truth, unit).markup);
  return out + fmt::format("<text x=\"{}\" y=\"{}\">found{}</text>", 2, kTop - 7, plot::in_units(f.found, unit).markup);
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
  out += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"1.5\"/>", x, f.y(p.median));
  if (!holds) out += line("cross", x - 2.5, y - 2.5, x + 2.5, y + 2.5) + line("cross", x - 2.5, y + 2.5, x + 2.5, y - 2.5);
  return out + "</g>\n";
}

}  // namespace

Html intervals_drawing(const ParameterRecovery& r, std::size_t k) {
  const Frame f = frame_of(r, k);
  const ParameterCoverage& p = r.parameters[k];
  std::string out = fmt::format(
      "<svg class=\"recovered\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"95 % intervals of {} against its true value: {} of {} "
      "contain it\">",
      kRight + 8, kBottom + 24, html_escaped(p.name), p.covered, p.recordings);
  out += axes(f, unit_in_print(p.unit)) + diagonal(f);
  for (const ParameterCase& c : r.cases) out += interval(f, c, k);
  return {out + "</svg>"};
}

}  // namespace swarmfit
