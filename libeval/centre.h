// SPDX-License-Identifier: MIT
// Where the group as a whole goes.
#pragma once

#include <vector>

#include "libtrack/tracks.h"

namespace swarmfit {

// Path of the group [unit], one point per entry of tracks.frames(), the first at the origin: the mean step of all who are seen in two
// frames running, summed up. Unlike the centroid it does not jump when somebody enters or leaves. It stands still where fewer than two are
// seen twice running: one alone is not a group.
std::vector<Eigen::Array3d> group_path(const Tracks& tracks);

// Centroid of each entry of tracks.frames() [unit].
std::vector<Eigen::Array3d> centroids(const Tracks& tracks);

}  // namespace swarmfit
