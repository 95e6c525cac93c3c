// SPDX-License-Identifier: MIT
// Which models can a recording tell apart, and how much longer would it have to be?
#pragma once

#include "fit/results/comparison.h"
#include "fit/results/recovery.h"
#include "libtrack/nan.h"

namespace swarmfit {

// A model that made recordings, and a rival.
struct PowerPair {
  std::size_t planted, rival;  // indices into Recovery::planted and Recovery::compared
  int recordings = 0;
  int first = 0;                       // in how many had the planted model the higher score
  int told_apart = 0;                  // in how many was the rival moreover not in the best group
  double lead = kNaN, lead_sd = kNaN;  // of the planted model's score over the rival's
  // How many times as many independent samples – minutes, or animals – it would take for the planted model to lead in 95 % of recordings,
  // if leads keep their mean and scatter as one over the root of that number; at least 1. Infinite if the mean lead is not positive.
  double factor = kNaN;
};

struct Power {
  Recovery recovery;  // planted as compared, in the order of the options; a recording that blew up is left out
  std::vector<PowerPair> pairs;
  Comparison fitted;  // of the recording itself, whose parameters were planted
};

}  // namespace swarmfit
