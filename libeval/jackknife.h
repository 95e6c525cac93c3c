// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace swarmfit {

// Jackknife standard error of one number from its values with each block left out (Efron and Tibshirani 1993, Eq 11.5).
double jackknife(const std::vector<double>& without);

}  // namespace swarmfit
