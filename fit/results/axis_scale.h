// SPDX-License-Identifier: MIT
// The axis along which a parameter is searched, for the search and for whoever draws what it found (docs/search.md).
#pragma once

#include <algorithm>
#include <cmath>

namespace swarmfit {

enum class AxisScale { linear, root, logarithmic };

// A zero lower bound cannot be logarithmic. On a linear axis whatever is an order of magnitude below the upper bound would be crowded into
// a tenth of it: strengths are searched by their square roots.
inline AxisScale scale_of(bool logarithmic, double lower) {
  return logarithmic ? AxisScale::logarithmic : lower == 0 ? AxisScale::root : AxisScale::linear;
}

// Where a value lies between the bounds, 0 at the lower and 1 at the upper; outside of them beyond, on a root axis not below zero.
inline double place_on(AxisScale scale, double lower, double upper, double value) {
  if (scale == AxisScale::logarithmic) return std::log(value / lower) / std::log(upper / lower);
  if (scale == AxisScale::root && lower != 0) {
    const double from = std::sqrt(std::max(lower, 0.0));
    return (std::sqrt(std::max(value, 0.0)) - from) / (std::sqrt(upper) - from);
  }
  const double share = (value - lower) / (upper - lower);
  return scale == AxisScale::root ? std::sqrt(std::max(share, 0.0)) : share;
}

// Its inverse.
inline double value_at(AxisScale scale, double lower, double upper, double place) {
  if (scale == AxisScale::logarithmic) return lower * std::exp(place * std::log(upper / lower));
  if (scale == AxisScale::root && lower != 0) {
    const double from = std::sqrt(std::max(lower, 0.0)), root = from + place * (std::sqrt(upper) - from);
    return root * root;
  }
  return lower + (scale == AxisScale::root ? place * place : place) * (upper - lower);
}

}  // namespace swarmfit
