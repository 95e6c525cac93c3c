// SPDX-License-Identifier: MIT
// A swarm that draws a curve: Xiang et al. 2020 (doi:10.1002/cav.1957), section 5.1.2.
#pragma once

#include "fit/synthesis/extend.h"
#include "libeval/following.h"
#include "libtrack/read/read_curve.h"

namespace swarmfit {

struct ShapeOptions {
  Pilot pilot;  // w_oa 0.5, w_cos 0, w_n 1 and w_user 1, as in the paper's Table 1, where its `set` does not say otherwise
  DrawnCurve drawn;
  int agents = 500;
  std::int64_t frames = 500, warm_up = 0;  // frames written, and before them
};

struct Shape {
  Tracks tracks;
  Curve curve;  // where it was drawn
  Following following;
  std::vector<double> parameters;
};

// Agents begin near a random key point each, at a random recorded velocity, and fly along the curve in either direction. A curve whose
// numbers are no lengths is as large as makes its key points twenty mean steps of the recording apart; it stands upright in three
// dimensions. A key point is reached within a quarter of that spacing. Throws InputError where the model has no w_user.
Shape fly_along(const Tracks& reference, const ShapeOptions& options);

}  // namespace swarmfit
