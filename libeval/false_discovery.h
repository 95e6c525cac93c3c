// SPDX-License-Identifier: MIT
// Many tests at once: the false discovery rate (Benjamini and Hochberg 1995).
#pragma once

#include <vector>

namespace swarmfit {

// Adjusted p, in the order given: rejecting all that are at most q keeps the expected share of wrong rejections at q, for tests that are
// independent or positively dependent. Undefined ones (NaN) stay so, and count for nothing.
std::vector<double> adjusted_p(const std::vector<double>& p);

}  // namespace swarmfit
