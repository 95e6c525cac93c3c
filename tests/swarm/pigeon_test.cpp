// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "libswarm/headings.h"
#include "tests/swarm/lane.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

// Two birds side by side at this separation, both flying along x at this speed, after one decision without noise.
struct Pair {
  Made made = make("pigeon", 2);
  Lane lane = crowd(made, 0, 1, 1);
  Pair(double separation, double speed) {
    set(made, lane, "noise", 0);
    lane.state.spawn(0, {0, 0, 0}, {speed, 0, 0});
    lane.state.spawn(0, {0, separation, 0}, {speed, 0, 0});
  }
  void fly(std::int64_t decisions = 1) { run(made, {.frame_dt = 1, .frames = decisions + 1}, lane); }
  double gap() const { return lane.state.pos(1, 1) - lane.state.pos(0, 1); }
};

void flat_speed(Pair& pair) {
  for (int k = 0; k < 7; ++k) set(pair.made, pair.lane, "v" + std::to_string(k), 1);
}

// Both birds take half of the change: the gap changes by the whole of A. Values of the natural spline by an independent implementation.
TEST(Pigeon, TheAttractionCurveIsTheChangeOfSeparation) {
  const auto change = [](double s) {
    Pair pair(s, 18);
    flat_speed(pair);
    pair.fly();
    return pair.gap() - s;
  };
  EXPECT_NEAR(change(10), 2.2, 1e-9);
  EXPECT_NEAR(change(20), 0, 1e-9);
  EXPECT_NEAR(change(40), -2.4787, 5e-5);
  EXPECT_NEAR(change(120), -5, 1e-9);
  EXPECT_NEAR(change(250), -1.7399, 5e-5);
  EXPECT_NEAR(change(500), 0, 1e-9);
  EXPECT_NEAR(change(900), 0, 1e-9);
}

TEST(Pigeon, TheSpeedCurve) {
  Pair near(40, 18.0619);  // as fast as it will be: nothing but A is left to correct
  near.fly();
  EXPECT_NEAR(near.lane.state.pos(0, 0), 18.0619, 5e-5);
  Pair far(900, 6);
  far.fly();
  EXPECT_NEAR(far.lane.state.pos(0, 0), 6, 1e-9);
}

// A bird does not close in on others by more than they are away.
TEST(Pigeon, SeparationsDoNotBecomeNegative) {
  Pair pair(30, 18);
  flat_speed(pair);
  set(pair.made, pair.lane, "attraction", 1000);
  pair.fly();
  EXPECT_NEAR(pair.gap(), 0, 1e-9);
}

// Only the nearest count: a third bird, farther away, is not one of them.
TEST(Pigeon, FollowsItsNearestNeighbours) {
  Pair pair(40, 18.0619);
  set(pair.made, pair.lane, "neighbours", 1);
  pair.lane.state.spawn(0, {0, -300, 0}, {0, 20, 0});
  Pair alone(40, 18.0619);
  pair.fly(), alone.fly();
  EXPECT_EQ(pair.lane.state.pos(0, 1), alone.lane.state.pos(0, 1));
}

TEST(Pigeon, AloneItFliesStraightOn) {
  const Made made = make("pigeon", 3);
  Lane lane = crowd(made, 0, 1, 1);
  set(made, lane, "noise", 0);
  lane.state.spawn(0, {0, 0, 0}, {3, 0, 4});
  run(made, {.frame_dt = 1, .frames = 11}, lane);
  EXPECT_LT((lane.state.pos.row(0).transpose() - Array3d(36, 0, 48)).abs().maxCoeff(), 1e-9);  // 6 m/s
}

TEST(Pigeon, FinerStepsChangeNothing) {
  const Made made = make("pigeon", 2);
  const auto end = [&](int substeps) {
    Lane lane = crowd(made, 60, 100, 18);
    run(made, {.frame_dt = 1, .substeps = substeps, .frames = 6}, lane);
    return lane.state;
  };
  EXPECT_LT((end(1).pos - end(8).pos).abs().maxCoeff(), 1e-7);
}

// ---- collective states ----------------------------------------------------------------------------------------------------------

struct Order {
  double speed = 0, turning = 0, extent = 0;  // |mean velocity| [m/s], mean |angular velocity| about the centre [rad/s], rms [m]
};

// Averages over 1000 decisions of 100 birds that start in a disc of this radius.
Order flock(double radius, bool aligned, std::uint64_t seed) {
  const Made made = make("pigeon", 2);
  Lane lane = crowd(made, 0, 1, 1);
  lane.rng = {seed};
  for (std::uint32_t i = 0; i < 100; ++i) {
    const double r = radius * std::sqrt(lane.rng.uniform(Stream::start, 0, i, 0));
    const Array3d u = aligned ? Array3d(1, 0, 0) : random_direction(lane.rng, Stream::start, 1, i, 0, 2);
    lane.state.spawn(0, r * random_direction(lane.rng, Stream::start, 2, i, 0, 2), 18 * u);
  }
  Recorded out;
  lane.out = &out;
  const std::int64_t steps = 1000;
  run(made, {.frame_dt = 1, .frames = steps + 1}, lane);
  Order order;
  std::vector<double> before;
  for (const auto& m : out.moments) {
    const Array3d mid = m.pos.colwise().mean().transpose();
    std::vector<double> angle;
    double turning = 0, square = 0;
    for (Index i = 0; i < 100; ++i) {
      angle.push_back(std::atan2(m.pos(i, 1) - mid[1], m.pos(i, 0) - mid[0]));
      square += (m.pos.row(i).transpose() - mid).square().sum() / 100;
      if (!before.empty())
        turning += std::abs(std::remainder(angle.back() - before[static_cast<std::size_t>(i)], 2 * std::numbers::pi)) / 100;
    }
    before = angle;
    order.turning += turning / steps;
    order.extent += std::sqrt(square) / (steps + 1);
    order.speed += std::sqrt(m.vel.colwise().mean().square().sum()) / (steps + 1);
  }
  return order;
}

// An independent implementation gave, as means of 8 seeds: from random headings, radius 200: 17.4 m/s, 0.021 rad/s, 81 m (cohesive); radius
// 700: 1.06 m/s (standard deviation over seeds 0.2), 0.146 rad/s, 389 m (a vortex). From aligned headings, radius 350: 16.6 m/s, 0.005
// rad/s, 1223 m (a comet).
TEST(Pigeon, ACohesiveFlock) {
  const Order order = flock(200, false, 1);
  EXPECT_NEAR(order.speed, 17.4, 0.5);
  EXPECT_NEAR(order.turning, 0.021, 0.01);
  EXPECT_NEAR(order.extent, 81, 40);
}

TEST(Pigeon, AVortex) {
  const Order order = flock(700, false, 1);
  EXPECT_NEAR(order.speed, 1.06, 0.6);
  EXPECT_NEAR(order.turning, 0.146, 0.03);
  EXPECT_NEAR(order.extent, 389, 80);
}

TEST(Pigeon, AComet) {
  const Order order = flock(350, true, 1);
  EXPECT_NEAR(order.speed, 16.6, 1);
  EXPECT_LT(order.turning, 0.012);
  EXPECT_GT(order.extent, 600);
}

}  // namespace
}  // namespace swarmfit
