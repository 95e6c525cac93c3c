// SPDX-License-Identifier: MIT
// How much of a rough motion is white error, told by how long second differences remember.
#pragma once

#include "libtrack/tracks.h"

namespace swarmfit {

// White error of variance s² gives second differences of positions the autocovariances 6, -4, 1, 0, 0 times s² at lags of 0 to 4 frames.
// Kicks once per frame give those of lag 0 alone, kicks in continuous time those of lags 0 and 1 (2/3 and 1/6), a random walk of positions
// 2 and -1; accelerations that last give them slowly falling ones. All but the error vanish in
//   g2 - (g3 + g4 / 2 - g6 / 2)   g2 less the line through g3 to g6: tells whether there is error at all;
//   (g0 - 4 g1 + 5 g2 - 2 g3)/27  leaves out the walk and the kicks once per frame, and scatters a sixth as much.
// Values beyond four robust standard deviations (identity jumps, wild detections) are counted as four.
struct WhitePart {
  Eigen::Array3d variance = Eigen::Array3d::Zero();  // s² per axis by the second, 0 where it is negative [unit²]
  double significance = 0;                           // the first, over all axes, in its standard errors
  double apart = 0;                                  // the second less the first, likewise: large where the motion is none of the above
};
WhitePart white_part(const Tracks& tracks);

}  // namespace swarmfit
