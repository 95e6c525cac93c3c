// SPDX-License-Identifier: MIT
#pragma once

#include "libtrack/tracks.h"

namespace swarmfit {

// atan2(y, x) of `count` finite numbers with y >= 0, within 3 units in the last place of the library's; 0 for (0, 0). NaN stays NaN. The
// same bits on every machine, four at a time. S. L. Moshier, Methods and Programs for Mathematical Functions, 1989:
// atan.
void angles(const double* y, const double* x, Index count, double* out);

}  // namespace swarmfit
