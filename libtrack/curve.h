// SPDX-License-Identifier: MIT
// Curves that a user draws: polylines through key points.
#pragma once

#include <string>
#include <vector>

#include "libtrack/tracks.h"

namespace swarmfit {

struct Curve {
  std::vector<Eigen::Array3d> points;  // at least 2; z = 0 in two dimensions [unit]
  bool closed = false;                 // does the last point lead to the first?

  std::size_t pieces() const { return closed ? points.size() : points.size() - 1; }
  const Eigen::Array3d& end_of(std::size_t piece) const { return points[(piece + 1) % points.size()]; }
  double length() const;
  double spacing() const { return length() / static_cast<double>(pieces()); }  // of the key points, on average
};

// Distance from x to the nearest place of the curve.
double distance_to(const Curve& curve, const Eigen::Array3d& x);

// So many places along it, equally far from each other.
std::vector<Eigen::Array3d> places_along(const Curve& curve, std::size_t count);

// Larger by `factor`, with the mean of its points at `centre`. Upright: what was y becomes z.
Curve placed(const Curve& curve, double factor, const Eigen::Array3d& centre, bool upright);

// Heart: x = 16 sin³ t, y = 13 cos t - 5 cos 2t - 2 cos 3t - cos 4t at 11 values of t. Star: five points at radius 1, five at 0.382.
Curve heart();
Curve star();

}  // namespace swarmfit
