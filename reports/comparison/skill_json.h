// SPDX-License-Identifier: MIT
// The part of results.json that stands beside the score.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "fit/results/comparison.h"

namespace swarmfit {

// Adds floor, null, places, skill_scale, random_walk, memory, interaction, leave_one_out and observables to the top of a comparison.
void add_skill(nlohmann::ordered_json& top, const Comparison&);
// Adds skill, total_variation, wasserstein, refuted_by, observables and vacf to a model.
void add_skill(nlohmann::ordered_json& model, const ModelFit&, const Comparison&);

}  // namespace swarmfit
