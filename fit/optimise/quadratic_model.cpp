// SPDX-License-Identifier: MIT
#include "fit/optimise/quadratic_model.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <numeric>

#include "libtrack/linear_algebra.h"

namespace swarmfit {
namespace {

// Minimum of g·z + zᵀHz/2 within |z| <= 1 (Moré and Sorensen 1983): (H + λ) z = -g with the least λ >= 0 that is positive definite and
// keeps z inside.
Point minimum_in_ball(const Eigen::VectorXd& g, const Eigen::MatrixXd& hessian) {
  const auto [values, vectors] = symmetric_eigen(hessian);
  const Eigen::ArrayXd curvature = values.array();
  const Eigen::ArrayXd slope = (vectors.transpose() * g).array();
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
  return vectors * step(high);
}

// The nearest of a neighbourhood, in units in which the farthest of them is at distance 1: z = axes⁻¹ (x - centre) / radius.
struct NearestPoints {
  std::vector<int> which;
  std::vector<Point> z;
  double radius;
};

NearestPoints nearest_points(const std::vector<Evaluated>& points, const Neighbourhood& around, int nearest) {
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
  NearestPoints out{{}, {}, near[nearest - 1].distance};
  for (int i = 0; i < nearest; ++i) {
    out.which.push_back(near[i].index);
    out.z.push_back(white[near[i].index] / out.radius);
  }
  return out;
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
  around.axes = cholesky_factor(covariance);
  return around;
}

std::optional<QuadraticModel> fit_quadratic(const std::vector<Evaluated>& points, const Neighbourhood& around, int nearest) {
  const Eigen::Index d = around.centre.size();
  const int coefficients = quadratic_coefficients(static_cast<int>(d));
  if (nearest > static_cast<int>(points.size()) || nearest < coefficients + 2) return {};

  const auto [which, z, radius] = nearest_points(points, around, nearest);
  if (!(radius > 0)) return {};
  Eigen::VectorXd y(nearest);
  for (int i = 0; i < nearest; ++i) y[i] = points[which[i]].cost;
  const double variance = (y.array() - y.mean()).square().sum() / (nearest - 1);
  if (!(variance > 0) || !std::isfinite(variance)) return {};

  const Eigen::MatrixXd design = design_matrix(z);
  const Eigen::VectorXd solution = least_squares(design, y);
  if (!solution.allFinite()) return {};
  const double residual_variance = (y - design * solution).squaredNorm() / (nearest - coefficients);
  const Point inside = minimum_in_ball(solution.segment(1, d), hessian_of(solution, d));
  const Point minimum = around.centre + around.axes * (radius * inside);
  return QuadraticModel{minimum.cwiseMax(0.0).cwiseMin(1.0), std::sqrt(residual_variance), 1 - residual_variance / variance, nearest};
}

std::optional<Point> least_squares_minimum(const std::vector<Evaluated>& points, const Neighbourhood& around, int nearest) {
  std::vector<Evaluated> known;
  std::copy_if(points.begin(), points.end(), std::back_inserter(known), [](const Evaluated& e) { return e.parts.size() > 0; });
  const Eigen::Index d = around.centre.size();
  if (nearest > static_cast<int>(known.size()) || nearest < d + 2) return {};
  const auto [which, z, radius] = nearest_points(known, around, nearest);
  if (!(radius > 0)) return {};

  Eigen::MatrixXd design(nearest, d + 1), parts(nearest, known.front().parts.size());
  for (int i = 0; i < nearest; ++i) {
    design.row(i) << 1, z[i].transpose();
    parts.row(i) = known[which[i]].parts.transpose();
  }
  Eigen::MatrixXd gram = design.transpose() * design;
  gram.diagonal() *= 1 + 1e-9;
  const Eigen::MatrixXd moment = design.transpose() * parts, linear = solve_semidefinite(gram, moment);
  if (!linear.allFinite()) return {};
  const Eigen::MatrixXd slopes = linear.bottomRows(d);
  const Point inside = minimum_in_ball(slopes * linear.row(0).transpose(), slopes * slopes.transpose());
  const Point minimum = around.centre + around.axes * (radius * inside);
  return Point(minimum.cwiseMax(0.0).cwiseMin(1.0));
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
