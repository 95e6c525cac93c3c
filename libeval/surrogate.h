// SPDX-License-Identifier: MIT
// Surrogates: recordings made of a recording's own tracks with one property destroyed. What a metric says of the recording and not of its
// surrogates is due to that property (Theiler et al. 1992, doi:10.1016/0167-2789(92)90102-S).
#pragma once

#include <span>

#include "libeval/energy.h"
#include "libtrack/rng.h"

namespace swarmfit {

// No interaction: every track of an episode is shifted in time by a random number of frames, circularly within the episode, so everybody
// moves as recorded but nobody reacts to those who happen to be near. What runs over the end comes back at the beginning as a track of its
// own, so nothing is differenced across the seam; gaps stay gaps. Of a few random shifts per track the one is taken that keeps the number
// of individuals per frame nearest to the recorded one. A group that travels farther than it is wide is shifted in its own frame of
// reference (group_path): each track keeps its motion within the group and gets the group's motion of its new time.
// Pure function of the tracks and rng.seed.
Tracks timeshift(const Tracks& tracks, const Rng& rng);

// No memory of direction: every step keeps its length and gets the direction of another step of the recording (a random permutation of all
// directions), positions are the sums of steps from where each unbroken run starts. Recorded velocities are treated alike; recorded
// accelerations are dropped. Speeds are the recording's own. Pure function of the tracks and rng.seed.
Tracks shuffled_walker(const Tracks& tracks, const Rng& rng);

// No memory of steps: within an episode every individual is where it was recorded, at other times (a random permutation of its positions,
// and of recorded velocities with them); recorded accelerations are dropped. Of a group that travels, the places are those within the
// group. Pure function of the tracks and rng.seed.
Tracks shuffled_places(const Tracks& tracks, const Rng& rng);

// Is this one of them? p = (1 + number of surrogates at least as far out) / (1 + number of surrogates); how far out a histogram is: total
// variation distance to all others, observed and surrogates pooled. Under the null hypothesis all are exchangeable, so p <= x has
// probability at most x. NaN without surrogates or samples. Throws std::invalid_argument if bins differ.
double surrogate_p(const Histogram& observed, std::span<const Histogram> surrogates);
// The same of several columns together, how far out being the sum over the columns with `used`. NaN if one of those has no samples, or none
// is used.
double surrogate_p(const PerColumn<Histogram>& observed, std::span<const PerColumn<Histogram>> surrogates, const PerColumn<bool>& used);

}  // namespace swarmfit
