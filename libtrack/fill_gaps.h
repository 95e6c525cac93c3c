// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "libtrack/tracks.h"

namespace swarmfit {

// Adds rows by linear interpolation of position, recorded velocity and acceleration wherever an individual is missing for at most
// `most` frames, never across the start of an episode. The rows must be grouped by track and ascend in time. Adds a note.
void fill_gaps(TrackColumns& columns, int most, std::vector<std::string>& notes);

}  // namespace swarmfit
