// SPDX-License-Identifier: MIT
#include "libeval/group/even_pairs.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "libtrack/rng.h"

namespace swarmfit {
namespace {

using Eigen::Vector3d;
constexpr std::uint32_t kEvenPoints = 3000;  // that stand for an even ellipsoid

}  // namespace

std::vector<double> even_pairs(const Eigen::Matrix3d& of, int dims, double width, std::size_t bins) {
  const double stretch = std::sqrt(dims + 2.0);  // from standard deviations to the semi-axes of a uniform ellipsoid
  Eigen::Matrix3d covariance = of;
  if (dims == 2) covariance(2, 2) = 0;
  covariance += 1e-9 * covariance.trace() * Eigen::Matrix3d::Identity();  // of places on a line, too
  const Eigen::Matrix3d root = covariance.llt().matrixL();
  std::vector<Vector3d> points;
  const Rng rng{1};
  for (std::uint32_t k = 0; k < kEvenPoints; ++k) {
    const auto u = rng.uniform2(Stream::probe, 0, k, 0);
    const double radius = std::pow(rng.uniform(Stream::probe, 1, k, 0), 1.0 / dims);
    const double angle = 2 * std::numbers::pi * u[0], z = dims == 3 ? 2 * u[1] - 1 : 0, rho = std::sqrt(1 - z * z);
    Vector3d p = root * Vector3d(radius * stretch * Vector3d(rho * std::cos(angle), rho * std::sin(angle), z));
    if (dims == 2) p[2] = 0;
    points.push_back(p);
  }
  std::vector<double> share(bins, 0);
  double all = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      const auto b = static_cast<std::size_t>((points[i] - points[j]).norm() / width);
      if (b < bins) ++share[b];
      ++all;
    }
  for (double& s : share) s /= all;
  return share;
}

}  // namespace swarmfit
