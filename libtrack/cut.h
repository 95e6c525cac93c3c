// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "libtrack/tracks.h"

namespace swarmfit {

// The rows of frames [first, last), with no memory of the rest: nothing is differenced across the cuts. All columns are kept, and so are
// the numbers and names of all tracks, also of those that are not in it, and where the recording came from.
Tracks cut(const Tracks& tracks, std::int64_t first, std::int64_t last);

}  // namespace swarmfit
