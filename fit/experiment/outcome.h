// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "libeval/energy.h"
#include "libswarm/simulate.h"

namespace swarmfit {

// One candidate over its replicates.
struct Outcome {
  // Energy score, or energy of the pooled replicates (Binning::pooled). Replicates that blew up count with the worst energy; NaN: undefined
  // in the recording.
  Energies raw;
  Energies guided;                        // raw, and a little more the farther off the means are: what a search minimises
  Energies first;                         // guided energies of the first replicates alone, where a race asked for them
  std::vector<Energies> replicates;       // of each replicate: EnergyScore::runs, or alone
  PerColumn<Distribution> distributions;  // pooled replicates
  int failed = 0;                         // replicates that blew up
  Counters count;                         // summed
};

// One run, binned on the recording's axes.
struct SingleRun {
  PerColumn<Distribution> distributions;  // without samples if it blew up
  bool failed = false;
};

}  // namespace swarmfit
