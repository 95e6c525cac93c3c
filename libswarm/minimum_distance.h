// SPDX-License-Identifier: MIT
#pragma once

#include "libswarm/model.h"

namespace swarmfit {

// Pushes agents that are too near to each other apart along the line that joins them, each of a pair by half of what lacks: X. Wang et al.,
// CGF 33(6), 2014 (doi:10.1111/cgf.12277), section 4. One sweep: all pushes are found from the positions before it and added up, so that a
// pair by itself ends exactly at `least`, and a crowd needs several steps. Two at the same place part in a drawn direction.
struct MinimumDistance {
  double least;  // > 0 [unit]
  double cell;   // pairs in different cubic cells of this side from the origin on are left alone, as in the paper; 0: none are [unit]
};
// Returns how many agents were moved. Uses c.near.
std::uint64_t enforce(const MinimumDistance& distance, State& state, const World& world, const StepContext& c);

}  // namespace swarmfit
