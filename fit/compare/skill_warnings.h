// SPDX-License-Identifier: MIT
// What a reader must be told of the skill, and of what the recording shows at all.
#pragma once

#include "fit/results/comparison.h"

namespace swarmfit {

// One sentence each, from a finished result.
std::vector<std::string> warnings_of_skill(const Comparison& result);

}  // namespace swarmfit
