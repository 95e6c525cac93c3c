// SPDX-License-Identifier: MIT
// A number and how sure it is.
#pragma once

#include "libtrack/nan.h"

namespace swarmfit {

// A number and its standard error; NaN: undefined.
struct Estimate {
  double value = kNaN, se = kNaN;
};

// Level of tests, intervals and groups.
inline constexpr double kAlpha = 0.05;

}  // namespace swarmfit
