// SPDX-License-Identifier: MIT
// What a regression of accelerations has on either side: accelerations, and every term of a force law at the same places.
#pragma once

#include "libswarm/force_law.h"
#include "libswarm/instrumental_regression.h"

namespace swarmfit {

RegressionDesign force_design(const Tracks& tracks, const ForceBasis& basis);

}  // namespace swarmfit
