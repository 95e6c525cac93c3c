// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "libtrack/curve.h"
#include "libtrack/nan.h"
#include "libtrack/tracks.h"

namespace swarmfit {

// How well a group draws a curve, over these frames.
struct Following {
  double distance = kNaN;  // mean distance of individuals to the curve [unit]
  double coverage = kNaN;  // mean share of 200 evenly spaced places of the curve that have somebody within `reach`
};
Following following(const Tracks& tracks, std::span<const FrameRange> frames, const Curve& curve, double reach);

}  // namespace swarmfit
