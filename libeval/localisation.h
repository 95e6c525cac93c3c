// SPDX-License-Identifier: MIT
// How much of a recording's motion is measurement error.
#pragma once

#include "libeval/metrics.h"

namespace swarmfit {

// Localisation error estimated from the positions alone. The error is taken as white: independent from frame to frame, normal.
struct Localisation {
  Eigen::Array3d sigma = Eigen::Array3d::Zero();  // standard deviation per axis [unit]; 0 where nothing can be told
  Index samples = 0;                              // segments' differences it rests on
  bool white = false;       // do differences of rising order agree, as they must for white error?
  double acceleration_share = 0;  // share of the mean squared acceleration that this error explains, 0..1
  double jerk_share = 0;          // likewise for the jerk
};
Localisation estimate_localisation(const Tracks& tracks);

// Share of each metric's variance that is due to an error of this size: adds the same error once more (fixed seed) and looks how far the
// variance rises (one step of SIMEX, Cook & Stefanski 1994). 0..1; NaN if the metric is undefined.
PerMetric<double> error_share(const Tracks& tracks, const Eigen::Array3d& sigma, std::uint64_t seed);

}  // namespace swarmfit
