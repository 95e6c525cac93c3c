// SPDX-License-Identifier: MIT
// Order parameters of a group, per frame.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "libtrack/tracks.h"

namespace swarmfit {

// One value per frame with anybody in it. A heading is v/|v|, v being the forward difference of positions; who has no next frame or stands
// still has none.
struct OrderSeries {
  std::vector<std::int64_t> frame;
  std::vector<double> polarisation;  // |sum of headings| / n, in [0, 1]; NaN if fewer than two have a heading
  std::vector<double> milling;       // |sum of r̂ × v̂| / n, r from the centroid, in [0, 1]; NaN if fewer than two have both
  std::vector<double> extent;        // root-mean-square distance to the centroid of all in the frame [unit]; NaN for one alone
};
// Of one kind of agent only, as if the others had not been there, or of all.
OrderSeries order_parameters(const Tracks& tracks, std::optional<std::uint8_t> kind = {});

double mean_defined(const std::vector<double>& values);  // mean of the finite values, NaN if there are none

}  // namespace swarmfit
