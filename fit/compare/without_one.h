// SPDX-License-Identifier: MIT
// How much does the ranking depend on who was ranked?
#pragma once

#include <vector>

#include "fit/results/comparison.h"

namespace swarmfit {

// The ranking of the others without each model; models in order of rank. Empty for fewer than three.
std::vector<LeftOut> without_each(const std::vector<ModelFit>& models, const RecordingFacts& recording);

}  // namespace swarmfit
