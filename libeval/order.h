// SPDX-License-Identifier: MIT
// Order parameters of a group, per frame.
#pragma once

#include "libtrack/tracks.h"

namespace swarmfit {

struct OrderSeries {
  std::vector<std::int64_t> frame;
  std::vector<double> polarisation;  // |sum v/|v|| / n over individuals with a defined, non-zero velocity, in [0, 1]; NaN if n < 2
  std::vector<double> milling;       // |sum r̂ × v̂| / n about the centroid of the frame, in [0, 1]; NaN if n < 2
  std::vector<double> extent;        // root-mean-square distance to the centroid [unit]
};
OrderSeries order_parameters(const Tracks& tracks);

double mean_defined(const std::vector<double>& values);  // mean of the finite values, NaN if there are none

}  // namespace swarmfit
