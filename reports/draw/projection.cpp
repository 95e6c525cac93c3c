// SPDX-License-Identifier: MIT
#include "reports/draw/projection.h"

#include <cmath>
#include <numbers>

namespace swarmfit {

SeenPoint seen_from_aside(const Eigen::Array3d& x, int dims) {
  if (dims == 2) return {x[0], x[1], 0};
  constexpr double azimuth = 30 * std::numbers::pi / 180, elevation = 25 * std::numbers::pi / 180;
  const double ca = std::cos(azimuth), sa = std::sin(azimuth), ce = std::cos(elevation), se = std::sin(elevation);
  return {ca * x[1] - sa * x[0], ce * x[2] - se * (ca * x[0] + sa * x[1]), -(ce * (ca * x[0] + sa * x[1]) + se * x[2])};
}

}  // namespace swarmfit
