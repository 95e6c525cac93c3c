// SPDX-License-Identifier: MIT
// Rows between rows, on straight lines.
#pragma once

#include <vector>

#include "libtrack/tracks.h"

namespace swarmfit {

// One row of the result: between rows a and a + 1 of the input, `part` of the way.
struct Between {
  Index a;
  double part;
};

// Nothing of nothing. Where `part` is 0 the row is the input's to the bit.
Rows interpolated(const Rows& rows, const std::vector<Between>& sources);

// No episode starts in (from, to].
bool one_take(const std::vector<std::int64_t>& episodes, std::int64_t from, std::int64_t to);

}  // namespace swarmfit
