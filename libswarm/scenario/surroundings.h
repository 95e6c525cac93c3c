// SPDX-License-Identifier: MIT
// Arena and obstacles, as scenario files and files of a recording's surroundings tell them.
#pragma once

#include <string>
#include <vector>

#include "libswarm/scenario/table.h"
#include "libswarm/walls.h"

namespace swarmfit {

// All of these throw InputError "file:line:column: what is wrong; what was expected".

// Corners of a box, the upper above the lower.
void read_corners(Table& table, int dims, Eigen::Array3d& lower, Eigen::Array3d& upper);
Bounds read_bounds(Table table, int dims);
// A mesh is read from its file, which is looked for beside the file of the table, and then among those of scenarios/.
Obstacle read_obstacle(Table table, int dims);

struct Surroundings {
  Bounds bounds = {};
  std::vector<Obstacle> obstacles = {};
};

// A file with [bounds] and [[obstacle]] and nothing else. `path` is where it is, or what errors call it.
Surroundings read_surroundings(const std::string& path, const std::string& text, int dims);

}  // namespace swarmfit
