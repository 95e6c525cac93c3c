// SPDX-License-Identifier: MIT
// What each single weight does to the ranking (Ren et al. 2016, Fig 18).
#pragma once

#include "fit/results/results.h"

namespace swarmfit {

// Fills FitResult::sensitivity of every model from its normalised energies and the comparison's weights. The weight of each column in turn
// is set to zero or doubled, the others keep their ratios, and weights sum to 1 again; p1 and p2 stay. NaN and rank 0 where the metric has
// no weight, and where nothing is left without it.
void fill_sensitivity(Comparison& comparison);

}  // namespace swarmfit
