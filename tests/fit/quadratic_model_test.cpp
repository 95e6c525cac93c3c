// SPDX-License-Identifier: MIT
#include "fit/optimise/quadratic_model.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>

#include "tests/fit/test_functions.h"

namespace swarmfit {
namespace {

using namespace swarmfit::testing;

std::vector<Evaluated> sampled(const TestFunction& f, int n, const Point& centre, double half_width) {
  std::vector<Evaluated> points;
  for (int i = 0; i < n; ++i) {
    Point x(centre.size());
    for (int k = 0; k < x.size(); ++k) {
      x[k] = centre[k] + half_width * (2 * Rng{1}.uniform(Stream::probe, i, static_cast<std::uint32_t>(k)) - 1);
    }
    points.push_back({x, f.cost(x)});
  }
  return points;
}

Neighbourhood ball(const Point& centre) { return {centre, Eigen::MatrixXd::Identity(centre.size(), centre.size())}; }

TEST(QuadraticModel, HasOneCoefficientPerMonomial) {
  EXPECT_EQ(quadratic_coefficients(1), 3);
  EXPECT_EQ(quadratic_coefficients(2), 6);
  EXPECT_EQ(quadratic_coefficients(7), 36);
}

TEST(QuadraticModel, IsExactForAQuadratic) {
  Eigen::Matrix3d hessian;
  hessian << 4, 1, 0.5, 1, 3, -0.2, 0.5, -0.2, 2;
  const Point optimum = Eigen::Vector3d(0.3, 0.6, 0.55);
  const auto f = noiseless("quadratic", optimum, [=](const Point& x) { return 7 + 0.5 * (x - optimum).dot(hessian * (x - optimum)); });
  const auto model = fit_quadratic(sampled(f, 40, Point::Constant(3, 0.5), 0.4), ball(Point::Constant(3, 0.5)), 30);
  ASSERT_TRUE(model);
  EXPECT_LT((model->minimum - optimum).norm(), 1e-12);
  EXPECT_LT(model->residual_sd, 1e-12);
  EXPECT_NEAR(model->explained, 1, 1e-12);
  EXPECT_EQ(model->points, 30);
}

// The oracle of the constrained minimum: the smallest value on a fine grid of the disc.
TEST(QuadraticModel, MinimumStaysWhereItWasFittedAndIsTheLeastThere) {
  Eigen::Matrix2d saddle;
  saddle << 1, 2, 2, -1.5;
  const Eigen::Vector2d slope(0.3, -0.1);
  const Point centre = Point::Constant(2, 0.5);
  const auto f = [&](const Point& x) { return slope.dot(x - centre) + 0.5 * (x - centre).dot(saddle * (x - centre)); };
  const auto points = sampled(noiseless("saddle", centre, f), 20, centre, 0.2);
  double radius = 0, least = 1e9;
  for (const auto& e : points) radius = std::max(radius, (e.x - centre).norm());
  for (int i = 0; i <= 400; ++i) {
    for (int j = 0; j <= 400; ++j) {
      const Point x = centre + radius * Eigen::Vector2d(i / 200.0 - 1, j / 200.0 - 1);
      if ((x - centre).norm() <= radius) least = std::min(least, f(x));
    }
  }
  const auto model = fit_quadratic(points, ball(centre), 20);
  ASSERT_TRUE(model);
  EXPECT_LE((model->minimum - centre).norm(), radius * (1 + 1e-9));
  EXPECT_LE(f(model->minimum), least + 1e-12);
  EXPECT_GT(f(model->minimum), least - 1e-3) << "the grid is that fine";
}

TEST(QuadraticModel, StaysInTheCube) {
  const auto f = noiseless("slope", Point::Zero(2), [](const Point& x) { return x.sum() + 0.1 * x.squaredNorm(); });
  const auto model = fit_quadratic(sampled(f, 30, Point::Constant(2, 0.1), 0.1), ball(Point::Constant(2, 0.1)), 30);
  ASSERT_TRUE(model);
  EXPECT_GE(model->minimum.minCoeff(), 0.0);
}

TEST(QuadraticModel, ResidualsAreTheNoise) {
  const auto f = noisy(sphere(3, 1), 0.5, 4);
  const auto model = fit_quadratic(sampled(f, 1000, f.optimum, 0.2), ball(f.optimum), 1000);
  ASSERT_TRUE(model);
  EXPECT_NEAR(model->residual_sd, 0.5, 4 * 0.5 / std::sqrt(2.0 * 990));  // four standard errors
}

TEST(QuadraticModel, NeedsEnoughPointsAndSomeVariance) {
  const auto f = sphere(2, 1);
  const auto points = sampled(f, 20, f.optimum, 0.1);
  EXPECT_FALSE(fit_quadratic(points, ball(f.optimum), 21));
  EXPECT_FALSE(fit_quadratic(points, ball(f.optimum), 7));
  EXPECT_TRUE(fit_quadratic(points, ball(f.optimum), 8));
  const auto flat = noiseless("flat", f.optimum, [](const Point&) { return 3.0; });
  EXPECT_FALSE(fit_quadratic(sampled(flat, 20, f.optimum, 0.1), ball(f.optimum), 20));
  const std::vector<Evaluated> one_place(20, {f.optimum, 1});
  EXPECT_FALSE(fit_quadratic(one_place, around_leaders(one_place, 10), 20));
  EXPECT_FALSE(response_surface({}));
}

TEST(QuadraticModel, PointsInAPlaneAreNoTrouble) {
  std::vector<Evaluated> points = sampled(sphere(3, 1), 60, Point::Constant(3, 0.5), 0.3);
  for (auto& e : points) e.x[2] = 0.5;
  const auto model = response_surface(points);
  ASSERT_TRUE(model);
  EXPECT_TRUE(model->minimum.allFinite());
}

// Parts that are linear in the parameters, so that one step is exact; and more of them than parameters.
TEST(LeastSquares, OneStepSolvesLinearParts) {
  const Point optimum = Eigen::Vector4d(0.45, 0.6, 0.5, 0.4);
  const Eigen::MatrixXd slopes = normal_matrix(9, 4, 3);
  auto points = sampled(sphere(4, 1), 10, Point::Constant(4, 0.5), 0.3);
  for (auto& e : points) e.parts = slopes * (e.x - optimum);
  const auto minimum = least_squares_minimum(points, ball(Point::Constant(4, 0.5)), 10);
  ASSERT_TRUE(minimum);
  EXPECT_LT((*minimum - optimum).norm(), 1e-8);
}

TEST(LeastSquares, TheStepStaysWhereItWasFitted) {
  const Point centre = Point::Constant(2, 0.5), optimum = Eigen::Vector2d(0.9, 0.5);
  auto points = sampled(sphere(2, 1), 12, centre, 0.1);
  double radius = 0;
  for (auto& e : points) e.parts = e.x - optimum, radius = std::max(radius, (e.x - centre).norm());
  const auto minimum = least_squares_minimum(points, ball(centre), 12);
  ASSERT_TRUE(minimum);
  EXPECT_LT((*minimum - Eigen::Vector2d(0.5 + radius, 0.5)).norm(), 1e-6);
}

TEST(LeastSquares, NeedsPointsWithParts) {
  auto points = sampled(sphere(2, 1), 8, Point::Constant(2, 0.5), 0.1);
  EXPECT_FALSE(least_squares_minimum(points, ball(Point::Constant(2, 0.5)), 4));
  for (std::size_t k = 0; k < 4; ++k) points[k].parts = points[k].x;
  EXPECT_FALSE(least_squares_minimum(points, ball(Point::Constant(2, 0.5)), 5));
  EXPECT_FALSE(least_squares_minimum(points, ball(Point::Constant(2, 0.5)), 3));
  EXPECT_TRUE(least_squares_minimum(points, ball(Point::Constant(2, 0.5)), 4));
}

TEST(AroundLeaders, HasTheMeanAndCovarianceOfTheCheapest) {
  const auto f = sphere(2, 1);
  auto points = sampled(f, 200, f.optimum, 0.2);
  const auto around = around_leaders(points, 50);
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.cost < b.cost; });
  Eigen::MatrixXd leaders(50, 2);
  for (int i = 0; i < 50; ++i) leaders.row(i) = points[i].x;
  const Eigen::RowVector2d mean = leaders.colwise().mean();
  const Eigen::MatrixXd centred = leaders.rowwise() - mean;
  EXPECT_LT((around.centre - mean.transpose()).norm(), 1e-12);
  const Eigen::MatrixXd covariance = centred.transpose() * centred / 50.0;
  EXPECT_LT((around.axes * around.axes.transpose() - covariance).norm(), 1e-5 * covariance.norm());
}

TEST(WidestQuadratic, TakesEverythingWhenEverythingIsQuadraticAndLittleWhenItIsNot) {
  const auto f = sphere(3, 1);
  const auto rough = sampled(noisy(f, 0.5, 1), 1000, f.optimum, 0.2);
  EXPECT_EQ(fit_widest_quadratic(rough, ball(f.optimum))->points, 1000);
  const auto wavy = rastrigin(3, 1);
  auto points = sampled(wavy, 500, wavy.optimum, 0.03);
  const auto far = sampled(wavy, 500, wavy.optimum, 0.3);
  points.insert(points.end(), far.begin(), far.end());
  EXPECT_LT(fit_widest_quadratic(points, ball(wavy.optimum))->points, 600);
}

}  // namespace
}  // namespace swarmfit
