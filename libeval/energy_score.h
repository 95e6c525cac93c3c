// SPDX-License-Identifier: MIT
// How far a recording lies from a law that is known by several runs of it.
#pragma once

#include <vector>

#include "libeval/energy.h"

namespace swarmfit {

// Mean L1 distances of the runs of one law from each other, per column: of each run from all others, and over all pairs. A run without
// samples is as far from one that has some as can be (`worst`). 0 for fewer than two runs. Time grows with the square of their number.
struct Spread {
  std::vector<Energies> of;
  Energies mean;
};
Spread spread(const std::vector<Densities>& runs, double worst);

// The energy score of a recording y under a law X: E d(X, y) - E d(X, X') / 2 (Gneiting and Raftery 2007, Eq 21, with the L1 distance d,
// which is of negative type). Over recordings, its expectation is least for the law that made them: it is a proper score. The distance
// between y and the pooled runs is not: a law whose runs all lie wide of y, each elsewhere, can look like y when pooled.
struct EnergyScore {
  Energies value;              // in [0, worst], but for chance
  std::vector<Energies> runs;  // have that mean; their scatter is that of the estimate: its standard error is their sd / sqrt(runs)
};

// away: distance of each run from the recording. At least one run.
EnergyScore energy_score(std::vector<Energies> away, const Spread& own);

}  // namespace swarmfit
