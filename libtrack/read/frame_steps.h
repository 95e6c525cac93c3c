// SPDX-License-Identifier: MIT
#pragma once

#include "libtrack/tracks.h"

namespace swarmfit {

// Frame numbers 0, 10, 20, ... mean that one step of the recording is ten frames: they are divided, with a note. Where every individual
// advances so but not all in the same frames, a note says that there are only gaps.
void merge_steps(TrackColumns& columns, TrackMeta& meta);

}  // namespace swarmfit
