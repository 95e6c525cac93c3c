// SPDX-License-Identifier: MIT
// Runs of a model at points of its search, as features: what posteriors are learned from.
#pragma once

#include <string>

#include "fit/experiment/ensemble.h"
#include "fit/infer/posterior.h"
#include "fit/model_fit/search_space.h"

namespace swarmfit {

// For posterior(): one batch per round, kept under this name. A run that blew up or shows nobody has no features. Holds references, so all
// arguments must outlive it.
using Features = std::function<Eigen::VectorXd(const Tracks&)>;
Simulator feature_runs(const SearchSpace& space, const Ensemble& ensemble, const std::string& name, const Features& features);

}  // namespace swarmfit
