// SPDX-License-Identifier: MIT
#pragma once

#include "libtrack/curve.h"
#include "libtrack/nan.h"
#include "libtrack/tracks.h"

namespace swarmfit {

// How well a group draws a curve, over all frames.
struct Following {
  double distance = kNaN;  // mean distance of individuals to the curve [unit]
  double coverage = kNaN;  // mean share of 200 evenly spaced places of the curve that have somebody within `reach`
};
Following following(const Tracks& tracks, const Curve& curve, double reach);

}  // namespace swarmfit
