// SPDX-License-Identifier: MIT
// From a finished search to what is reported of it.
#pragma once

#include "fit/model_fit/model_search.h"
#include "fit/results/comparison.h"

namespace swarmfit {

// What is estimated beside the best parameters.
struct Estimates {
  bool likelihood = false;  // of models that have one (fit/model_fit/likelihood.h)
  bool regression = false;  // of models that have forces (fit/model_fit/regression.h)
  bool posterior = false;   // where anything was searched (fit/model_fit/parameter_posterior.h)
};

// What the selected parameters of a search came to, and estimates on random numbers of `root`. Standing, likeness and film are others'
// work.
ModelFit model_fit_of(const ModelSearch& search, const Estimates& wanted, const Rng& root);

}  // namespace swarmfit
