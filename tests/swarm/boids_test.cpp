// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "libswarm/paths.h"
#include "tests/swarm/lane.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

constexpr double kSpeed = 7.5, kTau = 0.2;

Lane pair(const Made& made, const Array3d& second, const Array3d& v1, const Array3d& v2, double radius) {
  Lane lane = crowd(made, 0, 1, 1);
  lane.state.spawn(0, {0, 0, 0}, v1);
  lane.state.spawn(0, second, v2);
  set(made, lane, "radius", radius);
  return lane;
}

TEST(Boids, AloneFliesStraightOnAtConstantSpeed) {
  const Made made = make("boids");
  Lane lane = pair(made, {5, 0, 0}, {0, 3, 4}, {1, 0, 0}, 1);
  run(made, {.frame_dt = 0.1, .frames = 11}, lane);
  EXPECT_LT((lane.state.pos.row(0).transpose() - Array3d(0, 0.6, 0.8) * kSpeed).abs().maxCoeff(), 1e-12);
  EXPECT_LT((lane.state.pos.row(1).transpose() - Array3d(5 + kSpeed, 0, 0)).abs().maxCoeff(), 1e-12);
}

TEST(Boids, SpeedIsConstantInACrowd) {
  const Made made = make("boids");
  Lane lane = crowd(made, 50, 3, 1);
  set(made, lane, "radius", 1.5);
  run(made, {.frame_dt = 0.01, .frames = 51}, lane);
  EXPECT_LT((lane.state.vel.square().rowwise().sum().sqrt() - kSpeed).abs().maxCoeff(), 1e-12);
}

// One step against the equations: both fly along y, the second beside the first.
TEST(Boids, OneStep) {
  const Made made = make("boids");
  const double dt = 0.01, k = kSpeed / kTau;
  const auto turned = [&](double x, double y) {
    Lane lane = pair(made, {x, 0, 0}, {0, kSpeed, 0}, {0, kSpeed, y}, 2);
    run(made, {.frame_dt = dt, .frames = 2}, lane);
    return Array3d(lane.state.vel.row(0).transpose());
  };
  const auto expected = [&](const Array3d& steering) {
    const Array3d v = Array3d(0, kSpeed, 0) + k * dt * steering;
    return Array3d(kSpeed * v / std::sqrt(v.square().sum()));
  };
  const auto near = [](const Array3d& a, const Array3d& b) { return (a - b).abs().maxCoeff() < 1e-12; };
  EXPECT_TRUE(near(turned(1.5, 0), expected({1, 0, 0})));        // cohesion alone
  EXPECT_TRUE(near(turned(0.5, 0), expected({1 - 1.5, 0, 0})));  // and separation, within half the radius
  EXPECT_TRUE(near(turned(1.5, 2), expected({1, 0, 1})));        // and alignment
  EXPECT_TRUE(near(turned(2.5, 2), expected({0, 0, 0})));        // out of range
}

// The turn of a pair in one time constant does not depend on the step: Richardson's ratio of a first-order scheme.
TEST(Boids, PathConvergesWithTheStep) {
  const Made made = make("boids");
  const auto end = [&](std::int64_t steps) {
    Lane lane = pair(made, {3, 0, 0}, {0, kSpeed, 0}, {0, 0, kSpeed}, 10);
    run(made, {.frame_dt = kTau / static_cast<double>(steps), .frames = steps + 1}, lane);
    return Array3d(lane.state.vel.row(0).transpose());
  };
  const double coarse = (end(20) - end(640)).matrix().norm(), fine = (end(40) - end(640)).matrix().norm();
  EXPECT_LT(coarse, 0.1 * kSpeed);
  EXPECT_NEAR(coarse / fine, 2, 0.3);
}

TEST(Boids, FlocksAlign) {
  const Made made = make("boids");
  Lane lane = crowd(made, 100, 10, 1);
  lane.world.bounds.kind = Bounds::Kind::periodic;
  lane.world.bounds.upper.setConstant(10);
  set(made, lane, "radius", 4);
  const auto polarisation = [&] { return std::sqrt((lane.state.vel.colwise().mean() / kSpeed).square().sum()); };
  run(made, {.frame_dt = 0.01, .frames = 2}, lane);
  EXPECT_LT(polarisation(), 0.3);
  run(made, {.frame_dt = 0.01, .frames = 501}, lane);
  EXPECT_GT(polarisation(), 0.9);
}

// Rows of large groups move; ids do not.
Rows by_id(const State& state, const Rows& values) {
  Rows out(values.rows(), 3);
  for (Index i = 0; i < values.rows(); ++i) out.row(state.id[static_cast<std::size_t>(i)]) = values.row(i);
  return out;
}

// Nobody sees anybody: positions are those without wind, plus what the wind did.
TEST(Boids, WindsAreAsStrongAsTheySay) {
  const auto end = [](const std::string& options, double hold) {
    const Made made = make("boids" + options);
    Lane lane = crowd(made, 4000, 40, 1);
    set(made, lane, "radius", 1e-3);
    set(made, lane, "agitation", 0.7);
    set(made, lane, "hold", hold);
    run(made, {.frame_dt = 0.01, .frames = 101}, lane);
    return lane.state;
  };
  const State still = end("", 1);
  const auto blown = [&](const std::string& options, double hold) {  // root-mean-square way in a second
    const State state = end(options, hold);
    EXPECT_EQ((by_id(state, state.vel) - by_id(still, still.vel)).abs().maxCoeff(), 0) << "the wind does not turn anybody";
    return std::sqrt((by_id(state, state.pos) - by_id(still, still.pos)).square().rowwise().sum().mean());
  };
  EXPECT_NEAR(blown("[noise=white]", 1), 0.7, 0.02);
  EXPECT_NEAR(blown("[noise=white]", 0.1), 0.7 / std::sqrt(10.0), 0.01);  // ten independent pieces of a tenth of a second
  EXPECT_GT(blown("[noise=perlin]", 1), 0.05);
}

TEST(Boids, PerlinWindIsAsStrongAsItSays) {
  for (const int dims : {2, 3}) {
    const Made made = make("boids[noise=perlin]", dims);
    Lane lane = crowd(made, 4000, 40, 1);
    set(made, lane, "radius", 1e-3);
    set(made, lane, "agitation", 0.7);
    const Rows from = by_id(lane.state, lane.state.pos);
    run(made, {.frame_dt = 1e-6, .frames = 2}, lane);
    const Rows wind = (by_id(lane.state, lane.state.pos) - from) / 1e-6 - by_id(lane.state, lane.state.vel);
    EXPECT_NEAR(std::sqrt(wind.square().rowwise().sum().mean()), 0.7, 0.07) << dims;
    EXPECT_EQ(wind.col(2).abs().maxCoeff() > 0, dims == 3);
  }
}

TEST(Boids, FlyToTheirGoal) {
  const Made made = make("boids", 2);
  Lane lane = crowd(made, 0, 1, 1);
  lane.world.bounds = {.kind = Bounds::Kind::box, .lower = {0, 0, 0}, .upper = {40, 20, 0}};
  PathOptions ways;
  ways.grid = {.cell = 0.5, .count = {80, 40, 1}};
  lane.world.add(std::make_unique<Paths>(ways, std::vector<Goal>{{.centre = {38, 10, 0}, .radius = 1}}, std::vector<Obstacle>{}));
  lane.state.spawn(0, {10, 10, 0}, {-kSpeed, 0.1, 0});
  run(made, {.frame_dt = 0.01, .frames = 301}, lane);
  EXPECT_GT(lane.state.vel(0, 0), 0.97 * kSpeed) << "it has turned round";
  EXPECT_GT(lane.state.pos(0, 0), 10 + kSpeed);
}

}  // namespace
}  // namespace swarmfit
