// SPDX-License-Identifier: MIT
// A recording or a simulation by itself, as the pages that show it take it.
#pragma once

#include "fit/results/comparison.h"
#include "libeval/evaluation.h"

namespace swarmfit {

// A comparison with nobody: facts, the distributions of the seven metrics at lag 1, and a film. Throws InputError for tracks without rows.
Comparison portrait(const Tracks& tracks);

// Two sets of tracks as a comparison whose only model is the second, under the axes of their evaluation.
struct PairPortrait {
  Comparison comparison;  // command "evaluate"; the films of both begin at their own first frames, under the recording's numbers
  DataFacts simulation;
};

// Throws InputError as above.
PairPortrait portrait(const Tracks& real, const Tracks& simulated, const Evaluation& evaluation);

}  // namespace swarmfit
