// SPDX-License-Identifier: MIT
// From a finished search to what is reported of it.
#pragma once

#include "fit/model_fit/model_search.h"
#include "fit/results/comparison.h"

namespace swarmfit {

// What the selected parameters of a search came to. Posterior, standing, likeness and film are not known yet.
ModelFit model_fit_of(const ModelSearch& search);

// Its parameters of maximum likelihood (fit/model_fit/likelihood.h); nothing is done for models that have none.
void fill_likelihood(ModelFit& fit, const ModelSearch& search, const Rng& rng);

// The posterior of its searched parameters (fit/model_fit/parameter_posterior.h); nothing is done where nothing was searched.
void fill_posterior(ModelFit& fit, const ModelSearch& search, const Rng& rng);

}  // namespace swarmfit
