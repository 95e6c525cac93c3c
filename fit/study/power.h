// SPDX-License-Identifier: MIT
// Before any ranking: which models could this recording tell apart, and how much longer would it have to be?
#pragma once

#include <functional>

#include "fit/results/power.h"
#include "fit/study/recovery.h"

namespace swarmfit {

struct PowerOptions {
  CompareOptions compare;  // models, budget, conditions: as in the comparison that is planned
  int seeds = 3;           // recordings made by each model; at least 2, or nothing can be said of longer ones
};

// Told what was done: 0 of 1 + models × seeds comparisons and so on.
using OnPower = std::function<void(std::size_t done, std::size_t all)>;

// Fits every model to the recording, lets each make recordings with these parameters under the recording's own conditions (frames,
// individuals, gaps, localisation error, start), and compares all models on each. Parameters that are not fitted, and time steps, are those
// of the recording throughout. Throws as compare.
Power power(const Tracks& recording, const PowerOptions& options, const OnPower& on_power = {}, const StudyHooks& hooks = {});

// The pairs of a recovery.
std::vector<PowerPair> power_pairs(const Recovery& recovery);

}  // namespace swarmfit
