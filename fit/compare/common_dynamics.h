// SPDX-License-Identifier: MIT
// The paper's way of comparing noise functions: the dynamics are "common parameters" of all variants (Ren et al. 2016, noise comparison).
#pragma once

#include "fit/compare/compare.h"

namespace swarmfit {

// Names of the parameters that are searched in every one of the models, in the order of the first one's table.
std::vector<std::string> shared_parameters(const std::vector<ModelChoice>& models, const Scales& scales, const ParameterRequests& requests);

// Fits the first model alone and keeps what it finds for the shared parameters: in the options returned they are set, and no longer
// searched, in all models. Throws InputError if the models share nothing, or if nothing else is left to compare them by.
CompareOptions with_common_dynamics(const Tracks& recording, const CompareOptions& options, const OnCompareProgress& on_progress = {},
                                    const Runtime& runtime = {});

}  // namespace swarmfit
