// SPDX-License-Identifier: MIT
#include "libtrack/ellipsoid.h"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "libtrack/nan.h"

namespace swarmfit {

double ellipsoid_density(const Eigen::Ref<const Rows>& places, int dims) {
  const auto count = static_cast<double>(places.rows());
  if (places.rows() == 0) return kNaN;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (Index row = 0; row < places.rows(); ++row) middle += places.row(row).transpose().matrix();
  middle /= count;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (Index row = 0; row < places.rows(); ++row) {
    const Eigen::Vector3d r = places.row(row).transpose().matrix() - middle;
    spread += r * r.transpose() / count;
  }
  const double determinant = dims == 2 ? spread(0, 0) * spread(1, 1) - spread(0, 1) * spread(1, 0) : spread.determinant();
  const double unit = dims == 2 ? std::numbers::pi * 4 : 4.0 / 3 * std::numbers::pi * 8;
  return determinant > 0 ? count / (unit * std::sqrt(determinant)) : kNaN;
}

}  // namespace swarmfit
