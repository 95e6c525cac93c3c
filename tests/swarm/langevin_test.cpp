// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "tests/swarm/lane.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;
using Eigen::Matrix3d;

constexpr double kTauV = 0.7, kK = 4.9, kTauEta = 0.15, kSigma = 6;

Lane empty(const Made& made, double sigma = kSigma) {
  Lane lane = crowd(made, 0, 1, 1);
  set(made, lane, "tau_v", kTauV);
  set(made, lane, "k", kK);
  set(made, lane, "tau_eta", kTauEta);
  set(made, lane, "sigma_eta", sigma);
  return lane;
}

// d(x, v, eta) = A (x, v, eta) dt + noise in eta, per component.
Matrix3d drift() {
  Matrix3d a;
  a << 0, 1, 0, -kK, -1 / kTauV, 1, 0, 0, -1 / kTauEta;
  return a;
}

// exp(A t) by its series, on a short time and squared.
Matrix3d propagator(double t) {
  const Matrix3d small = drift() * (t / 1024);
  Matrix3d sum = Matrix3d::Identity(), term = sum;
  for (int k = 1; k < 8; ++k) sum += term = term * small / k;
  for (int k = 0; k < 10; ++k) sum = sum * sum;
  return sum;
}

// Stationary covariance S of (x, v, eta): A S + S A' + diag(0, 0, 2 sigma² / tau_eta) = 0.
Matrix3d stationary() {
  const double a = 1 / kTauEta, g = 1 / kTauV, s = kSigma * kSigma / (kK + a * g + a * a);
  Matrix3d c;
  c << s * (a / g + 1) / kK, 0, s, 0, s * a / g, s * a, s, s * a, kSigma * kSigma;
  return c;
}

TEST(Langevin, ClosedFormsSolveLyapunovsEquation) {
  Matrix3d rest = drift() * stationary() + stationary() * drift().transpose();
  rest(2, 2) += 2 * kSigma * kSigma / kTauEta;
  EXPECT_LT(rest.norm(), 1e-12 * kSigma * kSigma);
}

// Without noise (x, v, eta)(t) = exp(A t) (x, v, eta)(0); the error falls with the square of the step.
TEST(Langevin, NoiselessMotionFollowsThePropagator) {
  const Made made = make("langevin");
  const auto error = [&](std::int64_t steps) {
    Lane lane = empty(made, 0);
    lane.world.bounds = {.kind = Bounds::Kind::box, .lower = {-99, -99, -99}, .upper = {101, 103, 105}};  // middle (1, 2, 3)
    lane.state.spawn(0, {2, 1, 3.5}, {0.5, -1, 2});
    run(made, {.frames = 1}, lane);
    EXPECT_EQ(lane.state.own.cols(), 3);
    const Array3d centre(1, 2, 3);
    Matrix3d start;
    start << (lane.state.pos.row(0) - centre.transpose()).matrix(), lane.state.vel.row(0).matrix(), lane.state.own.row(0).matrix();
    run(made, {.frame_dt = 0.8 / static_cast<double>(steps), .frames = steps + 1}, lane);
    const Matrix3d end = propagator(0.8) * start;
    EXPECT_LT((end.row(2) - lane.state.own.matrix()).norm(), 1e-12);
    return (end.row(0).array() + centre.transpose() - lane.state.pos).matrix().norm() + (end.row(1) - lane.state.vel.matrix()).norm();
  };
  for (const std::int64_t steps : {1, 7, 40}) EXPECT_LT(error(steps), 1e-11) << steps;  // exact for any step
}

// Agents that enter with stationary places and velocities stay stationary from the first moment on, for any step, and remember as the
// propagator says. 5700 components: the band of 5 standard errors is ±9.4 % for variances and ±0.066 for correlations (level 6e-7 each).
TEST(Langevin, EntersAndStaysStationary) {
  const Made made = make("langevin");
  const Matrix3d s = stationary();
  for (const double dt : {0.005, 0.05}) {
    Lane lane = empty(made);
    for (std::uint32_t i = 0; i < 1900; ++i) {
      const auto normal = [&](std::uint32_t tick) { return gaussian_noise(Rng{99}, tick, i); };
      lane.state.spawn(0, std::sqrt(s(0, 0)) * normal(1), std::sqrt(s(1, 1)) * normal(2));
    }
    Recorded out;
    lane.out = &out;
    std::vector<Eigen::ArrayXXd> eta;
    const std::int64_t per_frame = std::lround(0.1 / dt);
    Plan plan{.frame_dt = 0.1, .substeps = static_cast<int>(per_frame), .frames = 1};
    for (std::int64_t k = 0; k <= 8; ++k) {
      run(made, plan, lane);
      eta.push_back(lane.state.own);
      plan.first_frame = k;
      plan.frames = 2;
    }
    const auto& start = out.moments.front();
    for (std::size_t k = 0; k < eta.size(); ++k) {
      const auto& m = k == 0 ? start : out.moments[2 * k];
      EXPECT_NEAR(m.pos.square().mean() / s(0, 0), 1, 0.094) << k;
      EXPECT_NEAR(m.vel.square().mean() / s(1, 1), 1, 0.094) << k;
      EXPECT_NEAR(eta[k].square().mean() / s(2, 2), 1, 0.094) << k;
      EXPECT_NEAR((m.vel * eta[k]).mean() / std::sqrt(s(1, 1) * s(2, 2)), s(1, 2) / std::sqrt(s(1, 1) * s(2, 2)), 0.066) << k;
      EXPECT_NEAR((m.pos * eta[k]).mean() / std::sqrt(s(0, 0) * s(2, 2)), s(0, 2) / std::sqrt(s(0, 0) * s(2, 2)), 0.066) << k;
      const double correlation = (propagator(0.1 * static_cast<double>(k)) * s)(1, 1) / s(1, 1);
      EXPECT_NEAR((start.vel * m.vel).mean() / s(1, 1), correlation, 0.066) << k;
    }
  }
}

TEST(Langevin, AgentsAreIndependent) {
  const Made made = make("langevin");
  Lane two = empty(made), one = empty(made);
  two.state.spawn(0, {1, 0, 0}, {0, 1, 0}, 7);
  two.state.spawn(0, {1, 0, 0}, {0, 1, 0}, 8);
  one.state.spawn(0, {1, 0, 0}, {0, 1, 0}, 8);
  for (Lane* lane : {&two, &one}) run(made, {.frame_dt = 0.01, .frames = 50}, *lane);
  EXPECT_TRUE((two.state.pos.row(1) == one.state.pos.row(0)).all());
  EXPECT_GT((two.state.pos.row(0) - two.state.pos.row(1)).abs().maxCoeff(), 0.01);
}

}  // namespace
}  // namespace swarmfit
