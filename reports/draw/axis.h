// SPDX-License-Identifier: MIT
// The scale of a plot: from values to a place along it, with ticks at round numbers.
#pragma once

#include <string>
#include <vector>

#include "reports/draw/svg.h"

namespace swarmfit::plot {

struct Tick {
  double value = 0;
  svg::Text label{};  // empty: a small tick between labelled ones
};

struct Axis {
  double lower = 0, upper = 1;       // finite, lower < upper
  bool logarithmic = false;          // then both are positive
  bool root = false;                 // by square roots; then neither is negative
  std::vector<Tick> ticks{};         // ascending, within the ends
  int exponent = 0;                  // labels are in units of 10^exponent
  double place(double value) const;  // 0 at the lower end, 1 at the upper; beyond them outside of [0, 1]
};

struct TickWishes {
  int intervals = 4;      // about as many
  double room = 0;        // points for the labels to stand apart on; 0: there is no want of it
  bool factored = false;  // labels of large or small values in units of a power of 1000, which the axis title has to name (in_units)
};

// Ticks at multiples of 1, 2 or 5 times a power of ten; three at least where there is room. Ends that are equal, or not finite, are moved
// apart.
Axis linear(double lower, double upper, const TickWishes& wishes = {});

// The ends moved outwards to 1, 2 or 5 times a power of ten, which are labelled if there are few of them, else powers of ten alone.
Axis logarithmic(double lower, double upper);

// "[unit]", or "[10³ unit]" where labels are in those units; a unit such as "1/s" takes its place: "[10³/s]". Nothing for a pure number.
svg::Text in_units(const Axis& axis, const std::string& unit);

// The range of finite values that were shown to it.
struct Range {
  double lower, upper;  // +inf, -inf before the first
  Range();
  void include(double value);
  bool empty() const { return lower > upper; }
};

}  // namespace swarmfit::plot
