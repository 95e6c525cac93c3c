// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace swarmfit {

// Insects per unit volume at a temperature in degrees Celsius: Ren et al. 2016 (doi:10.1371/journal.pone.0155698), Eq 1, a fit to the field
// counts of Grüebler et al. 2008; nobody below 8.74 and above 35.66. The paper does not say which volume.
constexpr double insects_at(double celsius) { return std::max(0.0, (-0.1073 * celsius + 4.7643) * celsius - 33.4556); }

}  // namespace swarmfit
