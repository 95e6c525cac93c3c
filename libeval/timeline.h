// SPDX-License-Identifier: MIT
// What is in a recording when: individuals seen, individuals lost for a while, steps too long to be true.
#pragma once

#include <cstdint>
#include <vector>

#include "libtrack/tracks.h"

namespace swarmfit {

// Bins of `stride` frames from frame `first` on. All empty for tracks without rows.
struct Timeline {
  std::int64_t first = 0, stride = 1;
  std::vector<double> seen;     // mean number of individuals per frame
  std::vector<double> missing;  // mean number per frame of those who are seen before and after, but not now
  std::vector<double> jumps;    // steps longer than 20 median steps
};
Timeline timeline(const Tracks& tracks);

}  // namespace swarmfit
