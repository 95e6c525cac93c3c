// SPDX-License-Identifier: MIT
// Places in the world, on a drawing without perspective.
#pragma once

#include <Eigen/Core>

namespace swarmfit {

// To the right, upwards, and away from the eye.
using SeenPoint = Eigen::Array3d;

// From above and aside; in two dimensions from straight above.
SeenPoint seen_from_aside(const Eigen::Array3d& place, int dims);

// From the plane of projection to the page.
struct PageFrame {
  double margin, left, top, scale;  // top is the greatest height, since the page counts downwards
  double x(const SeenPoint& p) const { return margin + (p[0] - left) * scale; }
  double y(const SeenPoint& p) const { return margin + (top - p[1]) * scale; }
};

}  // namespace swarmfit
