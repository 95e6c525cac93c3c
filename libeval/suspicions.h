// SPDX-License-Identifier: MIT
// Looks for what commonly goes wrong with trajectory files.
#pragma once

#include "libeval/summary.h"

namespace swarmfit {

// A step that somebody's track makes and an animal does not.
struct IdentityEvent {
  Index row;    // the step leads from this row to its next
  Index other;  // the row it was exchanged with, in the same frame; -1: a jump without a counterpart
};

// Swaps: two individuals of a frame both leave their extrapolated paths by more than 10 robust standard deviations, and neither would if
// their next positions were exchanged. Jumps: a step that is longer than the distance to the typical nearest neighbour, 10 robust standard
// deviations beyond the median, and three times as long as the steps of the same track around it. In row order, each swap once.
std::vector<IdentityEvent> identity_events(const Tracks& tracks);

// All suspicions, the gravest first: "identity swap", "identity jump", "double detection", "frozen track", "unit", "constant column",
// "measurement error", "smoothed positions", "short segments", "few individuals". Needs the numbers of the summary.
std::vector<Suspicion> suspicions(const Tracks& tracks, const Summary& summary);

}  // namespace swarmfit
