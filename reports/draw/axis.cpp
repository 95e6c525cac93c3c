// SPDX-License-Identifier: MIT
#include "reports/draw/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "fit/results/axis_scale.h"
#include "reports/write/number.h"

namespace swarmfit::plot {
namespace {

constexpr double kHair = 1e-9;  // rounding that does not push a tick off the end

// Exact, and the same with and without optimisation.
double power_of_ten(int exponent) { return std::strtod(fmt::format("1e{}", exponent).c_str(), nullptr); }

int decade(double value) { return static_cast<int>(std::floor(std::log10(value) + kHair)); }

// The least of 1, 2, 5 times a power of ten that is no less than this.
double round_step(double least) {
  const int exponent = decade(least);
  for (const int times : {1, 2, 5})
    if (times * power_of_ten(exponent) >= least * (1 - kHair)) return times * power_of_ten(exponent);
  return power_of_ten(exponent + 1);
}

int label_exponent(double largest) {
  if (!(largest > 0) || (largest < 1e4 && largest >= 1e-2 * (1 - kHair))) return 0;
  return 3 * static_cast<int>(std::floor(decade(largest) / 3.0));
}

svg::Text logarithmic_label(double value) {
  const int exponent = decade(value);
  if (exponent >= -2 && exponent <= 3) return svg::plain(brief(value));
  const auto times = std::lround(value / power_of_ten(exponent));
  return svg::with_power(times == 1 ? "" : fmt::format("{}·", times), exponent, "");
}

}  // namespace

double Axis::place(double value) const {
  const AxisScale scale = logarithmic ? AxisScale::logarithmic : root ? AxisScale::root : AxisScale::linear;
  return place_on(scale, lower, upper, value);
}

namespace {

// Do the labels stand too close on so many points?
bool crowded(const Axis& axis, double room) {
  constexpr double kApart = 4;
  if (room <= 0 || axis.ticks.size() < 2) return false;
  double widest = 0;
  for (const Tick& tick : axis.ticks) widest = std::max(widest, tick.label.width);
  return room * (axis.place(axis.ticks[1].value) - axis.place(axis.ticks[0].value)) < widest + kApart;
}

void set_ticks(Axis& axis, int intervals, int exponent) {
  const double span = axis.upper - axis.lower, step = round_step(span / intervals), hair = kHair * span;
  axis.ticks.clear();
  axis.exponent = exponent;
  const double unit = power_of_ten(exponent), last = std::floor((axis.upper + hair) / step);
  const int decimals = std::max(0, -decade(step / unit));
  for (double k = std::ceil((axis.lower - hair) / step); k <= last; ++k)
    axis.ticks.push_back({k * step, svg::plain(in_print(fixed(k * step / unit, decimals)))});
}

int usual_exponent(const Axis& axis, int intervals) {
  const int exponent = label_exponent(std::max(std::abs(axis.lower), std::abs(axis.upper)));
  const double largest = std::max(std::abs(axis.lower), std::abs(axis.upper));
  // Three decimals of what is near 1, two of what is smaller.
  const bool long_labels = round_step((axis.upper - axis.lower) / intervals) < (largest < 0.1 ? 0.01 : 0.001) * (1 - kHair);
  return exponent == 0 && long_labels ? -3 : exponent;
}

}  // namespace

Axis linear(double lower, double upper, const TickWishes& wishes) {
  constexpr std::size_t kFew = 3;
  Axis axis;
  if (lower == upper && upper != 0 && std::isfinite(upper))
    lower -= 0.5 * std::abs(upper), upper += 0.5 * std::abs(upper);  // in the middle
  axis.lower = std::isfinite(lower) ? lower : 0;
  axis.upper = std::isfinite(upper) && upper > axis.lower ? upper : axis.lower + std::max(1.0, std::abs(axis.lower));
  int intervals = wishes.intervals;
  int exponent = wishes.factored ? usual_exponent(axis, intervals) : 0;
  set_ticks(axis, intervals, exponent);
  while (axis.ticks.size() < kFew && intervals < 2 * wishes.intervals) set_ticks(axis, ++intervals, exponent);
  const bool thousands = std::max(std::abs(axis.lower), std::abs(axis.upper)) >= 1000;
  if (wishes.factored && exponent == 0 && thousands && crowded(axis, wishes.room)) set_ticks(axis, intervals, exponent = 3);
  while (intervals > 1 && crowded(axis, wishes.room)) set_ticks(axis, --intervals, exponent);
  return axis;
}

Axis logarithmic(double lower, double upper) {
  Axis axis;
  axis.logarithmic = true;
  const bool usable = lower > 0 && std::isfinite(lower) && std::isfinite(upper) && upper >= lower;
  if (!usable) lower = 0.1, upper = 1;
  axis.lower = power_of_ten(decade(lower));
  for (const int times : {2, 5})
    if (times * power_of_ten(decade(lower)) <= lower * (1 + kHair)) axis.lower = times * power_of_ten(decade(lower));
  axis.upper = round_step(upper);
  if (!(axis.upper > axis.lower)) axis.upper = 10 * axis.lower;
  const bool few = axis.upper / axis.lower < 150;
  for (int exponent = decade(axis.lower); power_of_ten(exponent) <= axis.upper * (1 + kHair); ++exponent)
    for (int times = 1; times < 10; ++times) {
      const double value = times * power_of_ten(exponent);
      if (value < axis.lower * (1 - kHair) || value > axis.upper * (1 + kHair)) continue;
      const bool labelled = times == 1 || (few && (times == 2 || times == 5));
      axis.ticks.push_back({value, labelled ? logarithmic_label(value) : svg::Text{}});
    }
  return axis;
}

svg::Text in_units(const Axis& axis, const std::string& unit) {
  if (axis.exponent == 0) return unit.empty() ? svg::Text{} : svg::plain(" [" + unit + ']');
  const bool reciprocal = unit.rfind("1/", 0) == 0;
  const std::string rest = unit.empty() ? "]" : reciprocal ? unit.substr(1) + ']' : ' ' + unit + ']';
  return svg::with_power(" [", axis.exponent, rest);
}

Range::Range() : lower(INFINITY), upper(-INFINITY) {}

void Range::include(double value) {
  if (!std::isfinite(value)) return;
  lower = std::min(lower, value);
  upper = std::max(upper, value);
}

}  // namespace swarmfit::plot
