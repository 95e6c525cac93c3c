// SPDX-License-Identifier: MIT
#pragma once

#include "libtrack/tracks.h"

namespace swarmfit {

// atan2(y, x) of `count` finite numbers with y >= 0, within 3 units in the last place of the library's; 0 for (0, 0). NaN stays NaN. In
// about a quarter of the time, with the same bits on every machine. S. L. Moshier, Methods and Programs for Mathematical Functions, 1989:
// atan.
void angles(const double* y, const double* x, Index count, double* out);

}  // namespace swarmfit
