// SPDX-License-Identifier: MIT
// Location and spread that a few wild values cannot move.
#pragma once

#include <cstddef>
#include <vector>

namespace swarmfit {

inline constexpr double kMadToSd = 1.4826022185056018;  // 1 / (median |z| of a standard normal)

struct Robust {
  double median, sd;  // sd: 1.4826 MAD; NaN without values
  double above(double sds) const { return median + sds * sd; }
  double below(double sds) const { return median - sds * sd; }
};
Robust robust(std::vector<double> values);

std::size_t count_outliers(const std::vector<double>& values, double sds);  // beyond median ± sds × 1.4826 MAD

}  // namespace swarmfit
