// SPDX-License-Identifier: MIT
// From a finished search to what is reported of it.
#pragma once

#include "fit/model_fit/calibration.h"
#include "fit/results/results.h"

namespace swarmfit {

// What the selected parameters of a search came to: energies, ratios and counts. Rank, skill, certainty, scales and film are not known yet.
FitResult fit_result(const ModelSearch& search, const Weighting& weighting);

// The posterior of its searched parameters (fit/model_fit/parameter_posterior.h); nothing is done where nothing was searched.
void fill_posterior(FitResult& fit, const ModelSearch& search, const Rng& rng);

}  // namespace swarmfit
