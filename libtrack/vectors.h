// SPDX-License-Identifier: MIT
// Products of vectors in space. Sums run in the order of the components, so that every build gives the same bits.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace swarmfit {

inline double dot(const Eigen::Array3d& a, const Eigen::Array3d& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline Eigen::Array3d cross(const Eigen::Array3d& a, const Eigen::Array3d& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline double length(const Eigen::Array3d& a) { return std::sqrt(dot(a, a)); }

}  // namespace swarmfit
