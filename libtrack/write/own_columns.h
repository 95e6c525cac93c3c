// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "libtrack/tracks.h"

namespace swarmfit {

// A column of a recording as our own containers hold it.
struct OwnColumn {
  std::string name;  // track, frame, t, x, ..., kind
  std::vector<double> values;
};

// track and frame first; one value per row of `tracks`, sorted by frame.
std::vector<OwnColumn> own_columns(const Tracks& tracks);

}  // namespace swarmfit
