// SPDX-License-Identifier: MIT
// Who is nearest to whom among places of one moment.
#pragma once

#include <vector>

#include "libtrack/tracks.h"

namespace swarmfit {

// Per place the nearest other: its row and distance [unit]; of equals the lowest row. -1 and infinity for one alone.
struct NearestOthers {
  std::vector<Index> row;
  std::vector<double> distance;
};
NearestOthers nearest_others(const Rows& places);

}  // namespace swarmfit
