// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "libtrack/tracks.h"

namespace swarmfit {

// The rows of frames [first, last), with no memory of the rest: nothing is differenced across the cuts. Tracks keep their numbers, but lose
// their names, their origin and recorded accelerations.
Tracks cut(const Tracks& tracks, std::int64_t first, std::int64_t last);

}  // namespace swarmfit
