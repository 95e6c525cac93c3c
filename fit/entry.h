// SPDX-License-Identifier: MIT
// How individuals enter the simulations: where and as fast as they were recorded, and no more surely than the recording tells.
#pragma once

#include <vector>

#include "libswarm/world.h"
#include "libtrack/tracks.h"

namespace swarmfit {

// One visit per track and episode, in the order of tracks; gaps are kept inside a visit, where the agent lives on unseen.
//
// Velocities are recorded ones where there are any, without error. Otherwise they are derivatives, at the first frame, of polynomials
// fitted by least squares to the first five frames (fewer where the track breaks sooner; 0 for a single one). One difference would carry
// sqrt(2) localisation errors. A line carries a third of one, but lags two frames behind; a parabola carries 1.1 and does not. Which of
// them errs less, on the mean over all visits, is decided per axis: the squared difference of the two exceeds its expectation without
// curvature. `vel_error` is the standard error of the better: simulations draw what they start with, so that models without chance, and
// those in which small differences grow, do not all tell one story. [unit/s]
std::vector<Presence::Visit> recorded_visits(const Tracks& tracks);

}  // namespace swarmfit
