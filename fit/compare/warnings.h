// SPDX-License-Identifier: MIT
// What a reader must be told of a finished comparison.
#pragma once

#include "fit/results/comparison.h"

namespace swarmfit {

// The gravest first. Of equal gravity: what the recording can show at all, what contradicts the best models, then the searches, model by
// model.
std::vector<Warning> all_warnings(const Comparison& result);

}  // namespace swarmfit
