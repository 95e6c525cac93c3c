// SPDX-License-Identifier: MIT
// A recording or a simulation by itself, as the pages that show it take it.
#pragma once

#include "fit/results/portrait.h"
#include "libeval/evaluation.h"

namespace swarmfit {

// A comparison with nobody: facts, the distributions of the seven metrics at lag 1, and a film. Throws InputError for tracks without rows.
Comparison portrait(const Tracks& tracks);

// Throws InputError as above.
PairPortrait portrait(const Tracks& real, const Tracks& simulated, const Evaluation& evaluation);

}  // namespace swarmfit
