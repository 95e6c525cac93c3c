// SPDX-License-Identifier: MIT
// Parameter recovery: recordings are made with known parameters of a model; do the intervals hold them?
#pragma once

#include "fit/results/parameter_recovery.h"
#include "fit/study/recovery.h"

namespace swarmfit {

using OnParameterCase = std::function<void(std::size_t done)>;

// options.planted is one model; options.spread is not used: true values are drawn evenly from the central 90 % of the search's axes, of
// which the intervals' prior is the whole. Draws until options.seeds recordings carry a fit, or ten times as many have not;
// a part only from the first options.seeds draws.
ParameterRecovery recover_parameters(const RecoveryOptions& options, const OnParameterCase& on_case = {}, const Runtime& runtime = {},
                                     const Part& part = {});

// Central 99 % of a binomial of n at 0.95, shared among `tests`: least and most.
std::pair<int, int> coverage_band(int n, int tests);

}  // namespace swarmfit
