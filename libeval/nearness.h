// SPDX-License-Identifier: MIT
// Is motion new, or does it repeat what it was made from?
#pragma once

#include "libtrack/tracks.h"

namespace swarmfit {

// How far a path is from the nearest one of a library: the median over paths of up to `kPaths` unbroken pieces of `frames` frames, evenly
// spread over the recording, of the distance to the nearest of up to `kLibrary` such pieces of `library`. Paths are compared from where
// they begin: root mean square over time of the difference of their displacements [unit]. NaN if either has no unbroken piece so long.
inline constexpr std::size_t kPaths = 300, kLibrary = 5000;
double distance_to_nearest(const Tracks& tracks, const Tracks& library, std::int64_t frames);

// The time after which velocities, less the mean of everybody in that frame, are correlated with themselves by less than 1/e [s]: pooled
// over individuals along their unbroken runs. At most a tenth of the recording; that too where nothing is left but the mean, as of a single
// individual.
double correlation_time(const Tracks& tracks);

}  // namespace swarmfit
