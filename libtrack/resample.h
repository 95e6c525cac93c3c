// SPDX-License-Identifier: MIT
#pragma once

#include "libtrack/tracks.h"

namespace swarmfit {

// Puts every individual on the frames k / hz [s] after the time of frame 0: position, recorded velocity and acceleration by linear
// interpolation between its two rows around that moment, the kind of the earlier one. Nothing is made up where an individual was not seen:
// two rows are joined only when they are no farther apart than a new frame interval or one and a half of what is usual (the median of the
// recording), and never across the start of an episode. The rows must be grouped by track and ascend in time. Adds a note. Nothing is
// filtered: what moves faster than hz / 2 is folded down; smooth() before it where that matters. Throws InputError when nothing is left
// or there would be more rows than memory should be asked for.
void resample(TrackColumns& columns, TrackMeta& meta, double hz);

}  // namespace swarmfit
