// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "fit/results/comparison.h"

namespace swarmfit {

// curve,model,x,value,sd: forces of the recording, with standard errors, and of every model, with robust standard deviations over its
// simulations.
std::string forces_csv(const Comparison&);

}  // namespace swarmfit
