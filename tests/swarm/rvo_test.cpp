// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/swarm/lane.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

double length(const Array3d& a) { return std::sqrt(a.square().sum()); }

Array3d position(const Lane& lane, Index i) { return lane.state.pos.row(i).transpose(); }
Array3d velocity(const Lane& lane, Index i) { return lane.state.vel.row(i).transpose(); }

#define EXPECT_NEAR3(a, b, tolerance) EXPECT_LT(((a) - (b)).abs().maxCoeff(), tolerance) << (a).transpose() << " not " << (b).transpose()

// Speed 2, radius 0.5, no jitter.
Lane quiet(const Made& made) {
  Lane lane = crowd(made, 0, 1, 1);
  set(made, lane, "max_speed", 2);
  set(made, lane, "radius", 0.5);
  set(made, lane, "time_horizon", 2);
  set(made, lane, "neighbour_distance", 20);
  set(made, lane, "jitter", 0);
  return lane;
}

// ---- alone --------------------------------------------------------------------------------------------------------------------

TEST(RvoAlone, FliesToTheCentreAtFullSpeed) {
  const Made made = make("rvo[goal=center]");
  Lane lane = quiet(made);
  set(made, lane, "goal_radius", 0.01);
  lane.world.bounds = {.kind = Bounds::Kind::box, .lower = {0, 0, 0}, .upper = {20, 20, 20}};
  lane.state.spawn(0, {10, 13, 6}, {0, 0, 0});  // 5 from the middle
  run(made, {.frame_dt = 0.1, .frames = 2}, lane);
  EXPECT_NEAR3(velocity(lane, 0), Array3d(0, -1.2, 1.6), 1e-12);
  EXPECT_NEAR3(position(lane, 0), Array3d(10, 12.88, 6.16), 1e-12);
  run(made, {.frame_dt = 0.1, .first_frame = 1, .frames = 25}, lane);
  EXPECT_NEAR3(position(lane, 0), Array3d(10, 10, 10), 1e-9);
}

TEST(RvoAlone, CentreIsTheMeanOfTheRecording) {
  State seen;
  seen.spawn(0, {1, 2, 3}, {0, 0, 0});
  seen.spawn(0, {3, 6, -1}, {0, 0, 0});
  const Tracks reference = recording_of(seen);
  const Made made = make("rvo[goal=center]", 3, &reference);
  Lane lane = quiet(made);
  set(made, lane, "goal_radius", 0.01);
  lane.state.spawn(0, {2, 4, 11}, {0, 0, 0});  // straight above (2, 4, 1)
  run(made, {.frame_dt = 0.1, .frames = 2}, lane);
  EXPECT_NEAR3(velocity(lane, 0), Array3d(0, 0, -2), 1e-12);
}

TEST(RvoAlone, InertialKeepsItsDirection) {
  const Made made = make("rvo[goal=inertial]");
  Lane lane = quiet(made);
  lane.state.spawn(0, {1, 1, 1}, {0.3, 0, -0.4});
  run(made, {.frame_dt = 0.1, .frames = 11}, lane);
  EXPECT_NEAR3(velocity(lane, 0), Array3d(1.2, 0, -1.6), 1e-12);
  EXPECT_NEAR3(position(lane, 0), Array3d(2.2, 1, -0.6), 1e-12);
}

TEST(RvoAlone, JitterNeverExceedsTheSpeedLimit) {
  const Made made = make("rvo[goal=inertial]");
  Lane lane = quiet(made);
  set(made, lane, "jitter", 0.1);
  for (int k = 0; k < 50; ++k) lane.state.spawn(0, {1000.0 * k, 0, 0}, {1, 0, 0});
  run(made, {.frame_dt = 0.1, .frames = 2}, lane);
  const Eigen::ArrayXd speed = lane.state.vel.square().rowwise().sum().sqrt();
  EXPECT_LE(speed.maxCoeff(), 2 * (1 + 1e-9));
  EXPECT_LT(speed.minCoeff(), 2 * 0.97);  // backward jitter shows, forward jitter is clipped
}

// ---- goals --------------------------------------------------------------------------------------------------------------------

// Radii to the power of the dimension are uniform on [0, 1]: Kolmogorov's distance of 1900 at level 1e-3.
TEST(RvoGoals, RandomOnesFillTheBallUniformly) {
  for (const int dims : {2, 3}) {
    const Made made = make("rvo", dims);
    Lane lane = crowd(made, 1900, 50, 0.1, 3, dims);
    set(made, lane, "goal_radius", 7);
    lane.world.bounds = {.kind = Bounds::Kind::sphere, .centre = {25, 25, dims == 2 ? 0.0 : 25}, .radius = 100};
    run(made, {.frames = 1}, lane);
    std::vector<double> u;
    Array3d mean = Array3d::Zero();
    for (Index i = 0; i < lane.state.size(); ++i) {
      const Array3d from = (lane.state.own.row(i).head<3>().transpose() - lane.world.bounds.centre) / 7;
      mean += from / 1900;
      u.push_back(std::pow(length(from), dims));
      if (dims == 2) {
        EXPECT_EQ(from[2], 0);
      }
    }
    std::sort(u.begin(), u.end());
    double distance = 0;
    for (std::size_t k = 0; k < u.size(); ++k) distance = std::max(distance, std::abs(u[k] - (static_cast<double>(k) + 0.5) / 1900));
    EXPECT_LT(distance, 1.95 / std::sqrt(1900.0));
    EXPECT_LT(length(mean), 0.06);  // 4 standard errors of each component, about 0.0135
  }
}

TEST(RvoGoals, ChangeOnArrivalAndAfterAWhile) {
  const Made made = make("rvo");
  Lane lane = quiet(made);
  set(made, lane, "goal_radius", 2);
  set(made, lane, "goal_time", 5);
  lane.state.spawn(0, {0, 0, 0}, {0, 0, 0});    // everything is near
  lane.state.spawn(0, {500, 0, 0}, {0, 0, 0});  // nothing is, for 250 s
  std::vector<double> near{0}, far{0};
  for (int k = 0; k < 200; ++k) {
    const State before = lane.state;
    run(made, {.frame_dt = 0.1, .first_frame = k, .frames = 2}, lane);
    if (k == 0) continue;  // they have only just entered
    const auto changed = [&](Index i) { return (lane.state.own.row(i) != before.own.row(i)).any(); };
    if (changed(0)) {
      near.push_back(0.1 * k);
      EXPECT_LT(length((before.pos.row(0) - before.own.row(0).head<3>()).transpose()), 1);
    }
    if (changed(1)) far.push_back(0.1 * k);
  }
  EXPECT_GT(near.size(), 5u);
  ASSERT_EQ(far.size(), 4u);  // 0, 5, 10, 15 s
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(far[k], 5.0 * static_cast<double>(k), 0.11);
}

TEST(RvoGoals, AntipodesFlyThereAndBack) {
  const Made made = make("rvo[goal=antipodal]");
  Lane lane = quiet(made);
  lane.state.spawn(0, {3, -4, 0}, {0, 0, 0});
  run(made, {.frame_dt = 0.1, .frames = 2}, lane);
  EXPECT_NEAR3(velocity(lane, 0), Array3d(-1.2, 1.6, 0), 1e-12);
  run(made, {.frame_dt = 0.1, .first_frame = 1, .frames = 46}, lane);  // 9 after 4.5 s: within two radii of (-3, 4, 0), and turned
  run(made, {.frame_dt = 0.1, .first_frame = 46, .frames = 11}, lane);
  EXPECT_NEAR3(velocity(lane, 0), Array3d(1.2, -1.6, 0), 1e-12);
}

// ---- together -----------------------------------------------------------------------------------------------------------------

TEST(RvoTogether, TwoHeadOnPassWithoutTouching) {
  for (const int dims : {2, 3}) {
    const Made made = make("rvo[goal=antipodal]", dims);
    Lane lane = quiet(made);
    set(made, lane, "jitter", 1e-3);
    lane.world.dims = dims;
    lane.state.spawn(0, {-5, 0, 0}, {0, 0, 0});
    lane.state.spawn(0, {5, 0, 0}, {0, 0, 0});
    Recorded out;
    lane.out = &out;
    run(made, {.frame_dt = 0.05, .frames = 91}, lane);
    double closest = 1e9;
    for (const auto& m : out.moments) closest = std::min(closest, length((m.pos.row(0) - m.pos.row(1)).transpose()));
    EXPECT_GT(closest, 1 - 1e-6);
    EXPECT_LT(closest, 1.2);  // they met
    EXPECT_GT(lane.state.pos(0, 0), 3);
    EXPECT_LT(lane.state.pos(1, 0), -3);
    EXPECT_EQ(lane.count.infeasible_avoidance, 0u);
  }
}

// Everybody changes places with the agent opposite, at different distances so that they do not all meet at once. Where velocities exist
// that avoid everybody, nobody touches; with avoidance out of range they run into each other.
TEST(RvoTogether, AntipodalCrowdDoesNotOverlap) {
  const Made made = make("rvo[goal=antipodal]");
  const auto closest = [&](double range) {
    Lane lane = quiet(made);
    set(made, lane, "jitter", 1e-3);
    set(made, lane, "time_horizon", 5);
    set(made, lane, "neighbour_distance", range);
    const std::uint32_t n = 24;
    for (std::uint32_t i = 0; i < n; ++i) {
      const double distance = 10 + 60 * Rng{1}.uniform(Stream::probe, 0, i);
      lane.state.spawn(0, distance * random_direction(Rng{1}, Stream::probe, 1, i, 0, 3), {0, 0, 0});
    }
    Recorded out;
    lane.out = &out;
    run(made, {.frame_dt = 0.1, .frames = 401}, lane);
    double least = 1e9;
    for (const auto& m : out.moments)
      for (Index i = 0; i < m.pos.rows(); ++i)
        for (Index j = 0; j < i; ++j) least = std::min(least, length((m.pos.row(i) - m.pos.row(j)).transpose()));
    return least;
  };
  EXPECT_GT(closest(20), 1 - 1e-3);
  EXPECT_LT(closest(0.01), 0.5);
}

TEST(RvoTogether, TheInfeasibleAreCountedAndDoAsTold) {
  const auto packed = [](const std::string& infeasible) {
    const Made made = make("rvo[goal=center,infeasible=" + infeasible + "]");
    Lane lane = quiet(made);
    for (double x : {-0.2, 0.0, 0.2})
      for (double y : {-0.2, 0.0, 0.2})
        for (double z : {-0.2, 0.0, 0.2}) lane.state.spawn(0, {x, y, z}, {0, 0, 0});
    run(made, {.frame_dt = 0.01, .frames = 2}, lane);
    EXPECT_GT(lane.count.infeasible_avoidance, 0u) << infeasible;
    if (infeasible == "substep") {
      EXPECT_GT(lane.count.halved_steps, 0u);
    }
    return Array3d(velocity(lane, 0));
  };
  EXPECT_EQ(length(packed("zero")), 0);
  EXPECT_EQ(length(packed("substep")), 0);
  const Array3d v = packed("min_penetration");  // away from all others, as fast as it may
  EXPECT_NEAR(length(v), 2, 1e-6);
  EXPECT_LT(v.maxCoeff(), 0);
}

}  // namespace
}  // namespace swarmfit
