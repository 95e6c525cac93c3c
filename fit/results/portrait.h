// SPDX-License-Identifier: MIT
// Two sets of tracks beside each other.
#pragma once

#include "fit/results/comparison.h"

namespace swarmfit {

// Two sets of tracks as a comparison whose only model is the second, under the axes of their evaluation.
struct PairPortrait {
  Comparison comparison;  // command "evaluate"; the films of both begin at their own first frames, under the recording's numbers
  DataFacts simulation;
};

}  // namespace swarmfit
