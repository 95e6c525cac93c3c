// SPDX-License-Identifier: MIT
// Order statistics of a few numbers.
#pragma once

#include <utility>
#include <vector>

namespace swarmfit {

// Linear interpolation between order statistics, p in [0, 1] (Hyndman & Fan's type 7); NaN without values.
double quantile(std::vector<double> values, double p);

inline double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

}  // namespace swarmfit
