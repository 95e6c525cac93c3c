// SPDX-License-Identifier: MIT
// How individuals enter the simulations: where and as fast as they were recorded, and no more surely than the recording tells.
#pragma once

#include <vector>

#include "libswarm/world.h"
#include "libtrack/tracks.h"

namespace swarmfit {

// How fast individuals enter where no velocity is recorded.
enum class EntryVelocity {
  estimated,   // as surely as the recording tells, below
  difference,  // of their first two positions, without error; at rest if there is but one
};

// One visit per track and episode, in the order of tracks; gaps are kept inside a visit, where the agent lives on unseen.
//
// Velocities are recorded ones where there are any, without error. Estimated ones are derivatives, at the first frame, of a line or
// parabola fitted by least squares to the first two to nine frames, whichever errs least: a difference of two carries sqrt(2) localisation
// errors, a line through nine an eighth of one, but it lags four frames behind. What each errs by the recording tells, per axis: from
// before and from after any frame it sees the same velocity. The estimate is then drawn towards the mean velocity of all, by as much as its
// error is to the scatter of velocities (a normal prior); who is seen in a single frame has that mean. `vel_error` is the standard error
// that remains: simulations draw what they start with, so that models without chance, and those in which small differences grow, do not all
// tell one story, and so that simulations start neither faster nor slower than the recording. [unit/s]
//
// sigma: localisation error per axis [unit]; 0 if unknown, when the variance of its share comes out up to a half too large.
std::vector<Presence::Visit> recorded_visits(const Tracks& tracks, const Eigen::Array3d& sigma,
                                             EntryVelocity how = EntryVelocity::estimated);

}  // namespace swarmfit
