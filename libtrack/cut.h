// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "libtrack/tracks.h"

namespace swarmfit {

// The rows of frames [first, last), with no memory of the rest: nothing is differenced across the cuts. All columns are kept, and so are
// the numbers and names of all tracks, also of those that are not in it, and where the recording came from.
Tracks cut(const Tracks& tracks, std::int64_t first, std::int64_t last);

// The rows of one kind of agent, as if nobody else had been there: only those who were of that kind remain, numbered anew in the same
// order. Row k is the k-th of that kind in `tracks`.
Tracks of_kind(const Tracks& tracks, std::uint8_t kind);

// The kind of this name or number. Throws InputError naming those that are there.
std::uint8_t kind_named(const Tracks& tracks, const std::string& name);

}  // namespace swarmfit
