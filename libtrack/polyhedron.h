// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace swarmfit {

// A body with flat faces; in two dimensions one polygon.
struct Polyhedron {
  std::vector<Eigen::Array3d> corners;  // [unit]
  std::vector<std::vector<int>> faces;  // corners of each, counter-clockwise as seen from outside
};

}  // namespace swarmfit
