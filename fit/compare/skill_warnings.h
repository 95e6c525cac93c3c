// SPDX-License-Identifier: MIT
// What a reader must be told of the skill, and of what the recording shows at all.
#pragma once

#include "fit/results/comparison.h"

namespace swarmfit {

// One sentence each, from a finished result.
std::vector<Warning> warnings_of_skill(const Comparison& result);

// And of models that take their motion from the recording: what their place is worth.
std::vector<Warning> warnings_of_learning(const Comparison& result);

}  // namespace swarmfit
