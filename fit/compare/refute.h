// SPDX-License-Identifier: MIT
// Is a fitted model refuted by what anybody sees, whatever the metrics say?
#pragma once

#include "fit/results/comparison.h"

namespace swarmfit {

// The facts: mean speed, polarisation, extent along each axis, mean distance to the nearest neighbour, and velocity memory.
//
// A fact refutes the model if the recording differs from its runs
//   - by more than chance: |recording - mean| > t hypot(sd √(1 + 1/R), se), sd being the standard deviation over R single runs and se the
//     recording's own standard error. t is Student's with R - 1 degrees of freedom, so that of recordings made by the model half a per cent
//     would be refuted by any of the facts if se were 0 (1/200 shared among the facts; 24 runs, seven facts: t = 3.9). That the parameters
//     were fitted to one recording, which scatters as well, is what se is for;
//   - and visibly: by more than a tenth of the recording's value, of polarisation by more than .05.
//
// Velocity memory is compared at the earlier of the two first zeros of the velocity autocorrelation, the recording's and that of the mean
// of the runs: by the correlations there, visibly if the one that is left exceeds .1. So one that has no zero at all can be told from one
// that has.
//
// Nothing is said of facts that are undefined in the recording or in all runs, or whose standard error is unknown.
std::vector<Refutation> refutations(const PanelPlan& plan, const PanelEstimate& recording, const std::vector<Panel>& runs);

// One sentence for each model that is first or of the first group and is refuted, from a finished result.
std::vector<Warning> warnings_of_facts(const Comparison& result);

}  // namespace swarmfit
