// SPDX-License-Identifier: MIT
// Derived motion. Everything follows Tracks::next(), so nothing reaches across a gap or an episode.
#pragma once

#include "libtrack/tracks.h"

namespace swarmfit {

// (position of the same individual one frame later - position) / dt, [unit/s], one row per row of `tracks`; NaN where there is no next
// frame. With zero z in two dimensions.
Rows forward_velocity(const Tracks& tracks);

// Positions smoothed by a Gaussian of standard deviation `sigma_frames` [frames] along every unbroken run; recorded velocity and
// acceleration are smoothed alike. The kernel is cut at four sigma, and its weights are renormalised near the ends of a run, so that a
// resting individual stays where it is. 0 changes nothing. Adds a note. Throws InputError when sigma is negative or not finite.
Tracks smooth(const Tracks& tracks, double sigma_frames);

}  // namespace swarmfit
