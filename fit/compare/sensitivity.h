// SPDX-License-Identifier: MIT
// What each single weight does to the ranking (Ren et al. 2016, Fig 18).
#pragma once

#include <vector>

#include "fit/results/model_fit.h"

namespace swarmfit {

// From the normalised energies of all models and the weights: the weight of each column in turn is set to zero or doubled, the others keep
// their ratios, and weights sum to 1 again; p1 and p2 stay. NaN and rank 0 where the metric has no weight, and where nothing is left
// without it.
std::vector<Sensitivity> sensitivities(const std::vector<Energies>& models, const PerColumn<double>& weights);

}  // namespace swarmfit
