// SPDX-License-Identifier: MIT
#include "fit/optimise/quadratic_model.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace swarmfit {
namespace {

// Minimum of g·z + zᵀHz/2 within |z| <= 1 (Moré and Sorensen 1983): (H + λ) z = -g with the least λ >= 0 that is positive definite and
// keeps z inside.
Point minimum_in_ball(const Eigen::VectorXd& g, const Eigen::MatrixXd& hessian) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(hessian);
  const Eigen::ArrayXd curvature = eigen.eigenvalues().array();
  const Eigen::ArrayXd slope = (eigen.eigenvectors().transpose() * g).array();
  const auto step = [&](double lambda) -> Point { return (-slope / (curvature + lambda)).matrix(); };

  const double margin = 1e-12 * std::max(curvature.abs().maxCoeff(), slope.abs().maxCoeff());
  if (!(margin > 0)) return Point::Zero(g.size());
  double low = std::max(0.0, margin - curvature.minCoeff());
  double high = low + 2 * slope.matrix().norm();  // the smallest curvature + λ is then at least 2|g|
  if (step(low).norm() <= 1) high = low;
  for (int i = 0; i < 100 && high - low > margin; ++i) {
    const double middle = (low + high) / 2;
    (step(middle).norm() > 1 ? low : high) = middle;
  }
  return eigen.eigenvectors() * step(high);
}

// Design matrix: 1, z_a, z_a z_b (a <= b).
Eigen::MatrixXd design_matrix(const std::vector<Point>& z) {
  const Eigen::Index d = z.front().size();
  Eigen::MatrixXd design(static_cast<Eigen::Index>(z.size()), quadratic_coefficients(static_cast<int>(d)));
  for (Eigen::Index i = 0; i < design.rows(); ++i) {
    Eigen::Index column = 0;
    design(i, column++) = 1;
    for (Eigen::Index a = 0; a < d; ++a) design(i, column++) = z[i][a];
    for (Eigen::Index a = 0; a < d; ++a) {
      for (Eigen::Index b = a; b < d; ++b) design(i, column++) = z[i][a] * z[i][b];
    }
  }
  return design;
}

Eigen::MatrixXd hessian_of(const Eigen::VectorXd& coefficients, Eigen::Index d) {
  Eigen::MatrixXd hessian(d, d);
  Eigen::Index column = d + 1;
  for (Eigen::Index a = 0; a < d; ++a) {
    for (Eigen::Index b = a; b < d; ++b) hessian(a, b) = hessian(b, a) = (a == b ? 2 : 1) * coefficients[column++];
  }
  return hessian;
}

}  // namespace

Neighbourhood around_leaders(const std::vector<Evaluated>& points, int leaders) {
  assert(!points.empty() && leaders > 0);
  std::vector<int> order(std::min(points.size(), static_cast<std::size_t>(leaders)));
  std::vector<int> all(points.size());
  std::iota(all.begin(), all.end(), 0);
  std::partial_sort_copy(all.begin(), all.end(), order.begin(), order.end(),
                         [&](int a, int b) { return points[a].cost < points[b].cost || (points[a].cost == points[b].cost && a < b); });
  const Eigen::Index d = points.front().x.size();
  const auto n = static_cast<double>(order.size());
  Neighbourhood around{Point::Zero(d), Eigen::MatrixXd::Zero(d, d)};
  for (const int i : order) around.centre += points[i].x / n;
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(d, d);
  for (const int i : order) {
    const Point offset = points[i].x - around.centre;
    covariance += offset * offset.transpose() / n;
  }
  // Keeps the ellipsoid from being flat when the leaders are few or lie in a plane.
  covariance.diagonal().array() += 1e-6 * covariance.trace() / static_cast<double>(d) + 1e-30;
  around.axes = covariance.llt().matrixL();
  return around;
}

std::optional<QuadraticModel> fit_quadratic(const std::vector<Evaluated>& points, const Neighbourhood& around, int nearest) {
  const Eigen::Index d = around.centre.size();
  const int coefficients = quadratic_coefficients(static_cast<int>(d));
  if (nearest > static_cast<int>(points.size()) || nearest < coefficients + 2) return {};

  struct Near {
    double distance;
    int index;
    auto operator<=>(const Near&) const = default;  // NOLINT(modernize-use-nullptr): clang-tidy 14 misreads it
  };
  std::vector<Point> white(points.size());
  std::vector<Near> near(points.size());
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    white[i] = around.axes.triangularView<Eigen::Lower>().solve(points[i].x - around.centre);
    near[i] = {white[i].norm(), i};
  }
  std::partial_sort(near.begin(), near.begin() + nearest, near.end());
  const double radius = near[nearest - 1].distance;
  if (!(radius > 0)) return {};

  std::vector<Point> z;
  Eigen::VectorXd y(nearest);
  for (int i = 0; i < nearest; ++i) {
    z.push_back(white[near[i].index] / radius);
    y[i] = points[near[i].index].cost;
  }
  const double variance = (y.array() - y.mean()).square().sum() / (nearest - 1);
  if (!(variance > 0) || !std::isfinite(variance)) return {};

  const Eigen::MatrixXd design = design_matrix(z);
  const Eigen::VectorXd solution = design.colPivHouseholderQr().solve(y);
  if (!solution.allFinite()) return {};
  const double residual_variance = (y - design * solution).squaredNorm() / (nearest - coefficients);
  const Point inside = minimum_in_ball(solution.segment(1, d), hessian_of(solution, d));
  const Point minimum = around.centre + around.axes * (radius * inside);
  return QuadraticModel{minimum.cwiseMax(0.0).cwiseMin(1.0), std::sqrt(residual_variance), 1 - residual_variance / variance, nearest};
}

std::optional<QuadraticModel> fit_widest_quadratic(const std::vector<Evaluated>& points, const Neighbourhood& around) {
  const int coefficients = quadratic_coefficients(static_cast<int>(around.centre.size()));
  const auto all = static_cast<int>(points.size());
  std::optional<QuadraticModel> widest;
  for (int nearest = 3 * coefficients; nearest <= all; nearest = nearest < all ? std::min(nearest + nearest / 2, all) : all + 1) {
    const auto model = fit_quadratic(points, around, nearest);
    if (!model) continue;
    if (widest) {
      const double relative_error = 1 / std::sqrt(2.0 * (widest->points - coefficients));  // of a standard deviation
      if (model->residual_sd > widest->residual_sd * (1 + 3 * relative_error)) break;
    }
    widest = model;
  }
  return widest;
}

std::optional<QuadraticModel> response_surface(const std::vector<Evaluated>& points) {
  if (points.empty()) return {};
  const int coefficients = quadratic_coefficients(static_cast<int>(points.front().x.size()));
  return fit_widest_quadratic(points, around_leaders(points, std::max(static_cast<int>(points.size()) / 10, coefficients)));
}

}  // namespace swarmfit
