// SPDX-License-Identifier: MIT
// Distances between two histograms on the same bins, beside the L1 energy. They shrink with the number of samples: compare them only at
// equal counts.
#pragma once

#include "libeval/energy.h"

namespace swarmfit {

// Total variation: half the sum of differences of the bins' shares, in [0, 1]; with clipped end bins 1 means disjoint. NaN if a histogram
// is empty. Throws std::invalid_argument if the bins differ.
double total_variation(const Histogram& a, const Histogram& b);

// 1-Wasserstein (earth mover's) distance: area between the distribution functions, in units of `width`, the width of a bin. Samples in one
// bin count as one place, those beyond the end bins as in them. NaN and throws as above.
double wasserstein(const Histogram& a, const Histogram& b, double width);

}  // namespace swarmfit
