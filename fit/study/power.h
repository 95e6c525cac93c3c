// SPDX-License-Identifier: MIT
// Before any ranking: which models could this recording tell apart, and how much longer would it have to be?
#pragma once

#include <functional>

#include "fit/study/recovery.h"

namespace swarmfit {

struct PowerOptions {
  CompareOptions compare;  // models, budget, conditions: as in the comparison that is planned
  int seeds = 3;           // recordings made by each model; at least 2, or nothing can be said of longer ones
};

// A model that made recordings, and a rival.
struct PowerPair {
  std::size_t planted, rival;  // indices into Recovery::planted and Recovery::compared
  int recordings = 0;
  int first = 0;                     // in how many had the planted model the higher score
  int told_apart = 0;                // in how many was the rival moreover not in the best group
  double lead = NAN, lead_sd = NAN;  // of the planted model's score over the rival's
  // How many times as many independent samples – minutes, or animals – it would take for the planted model to lead in 95 % of recordings,
  // if leads keep their mean and scatter as one over the root of that number; at least 1. Infinite if the mean lead is not positive.
  double factor = NAN;
};

struct Power {
  Recovery recovery;  // planted as compared, in the order of the options; a recording that blew up is left out
  std::vector<PowerPair> pairs;
  Comparison fitted;  // of the recording itself, whose parameters were planted
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
