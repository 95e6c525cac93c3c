// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "libswarm/paths.h"
#include "tests/swarm/lane.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

constexpr double kSpeed = 1.3, kCell = 0.5;

// A hall of 20 by 10 without anybody in it.
struct Hall {
  Made made;
  Lane lane;

  explicit Hall(std::vector<Goal> goals, std::vector<Obstacle> obstacles = {}, const std::string& options = "", int kinds = 1)
      : made(make("continuum_crowds" + options)) {
    made.model = make_model(made.choice, {.dims = 2, .kinds = kinds});
    lane = crowd(made, 0, 1, 0);
    lane.world.bounds = {.kind = Bounds::Kind::box, .wall = Bounds::Wall::slip, .lower = {0, 0, 0}, .upper = {20, 10, 0}};
    PathOptions options_of_ways;
    options_of_ways.grid = {.cell = kCell, .count = {40, 20, 1}};
    if (!goals.empty()) lane.world.add(std::make_unique<Paths>(options_of_ways, std::move(goals), obstacles));
    if (!obstacles.empty()) lane.world.add(std::make_unique<Walls>(std::move(obstacles)));
    set(made, lane, "speed", kSpeed);
  }
  void add(const Array3d& pos, const Array3d& vel = {0, 0, 0}, std::uint8_t kind = 0) { lane.state.spawn(kind, pos, vel); }
  void walk(std::int64_t frames, double dt = 0.05) { run(made, {.frame_dt = dt, .frames = frames + 1}, lane); }
  Array3d pos(Index row) const { return lane.state.pos.row(row).transpose(); }
  Array3d vel(Index row) const { return lane.state.vel.row(row).transpose(); }
};

const std::vector<Goal> kEast{{.centre = {18, 5.25, 0}, .radius = 1}};

TEST(ContinuumCrowds, WhoIsAloneWalksStraightToTheGoalAndStaysThere) {
  Hall hall(kEast);
  hall.add({3, 5.25, 0}, {kSpeed, 0, 0});
  for (int k = 0; k < 100; ++k) {
    hall.walk(1);
    EXPECT_NEAR(hall.vel(0)[0], kSpeed, 1e-3 * kSpeed);
    EXPECT_NEAR(hall.pos(0)[1], 5.25, 0.01 * kCell) << "but for its own density";
  }
  hall.walk(400);
  EXPECT_LE(std::sqrt((hall.pos(0) - kEast[0].centre).square().sum()), 1 + kCell);
  const Array3d there = hall.pos(0);
  hall.walk(20);
  EXPECT_TRUE((hall.pos(0) == there).all());
}

TEST(ContinuumCrowds, WithoutGoalsEverybodyWalksOn) {
  Hall hall({});
  hall.add({3, 5, 0}, {0.6, 0.8, 0});
  hall.walk(5, 0.2);
  EXPECT_LT((hall.pos(0) - Array3d(3 + 0.6 * kSpeed, 5 + 0.8 * kSpeed, 0)).abs().maxCoeff(), 1e-9);
}

TEST(ContinuumCrowds, WhoCannotReachAGoalStands) {
  Hall hall(kEast, {{.shape = Obstacle::Shape::box, .lower = {9, -1, 0}, .upper = {10, 11, 0}}});
  hall.add({3, 5, 0}, {1, 0, 0});
  hall.walk(5);
  EXPECT_TRUE((hall.pos(0) == Array3d(3, 5, 0)).all());
}

// Three people stand at the centre of the cell ahead: its density is 3, so who comes walks with their flow, which is none.
TEST(ContinuumCrowds, ADenseCrowdSetsThePace) {
  for (const double pace : {0.0, 0.4}) {
    Hall hall(kEast);
    set(hall.made, hall.lane, "d_min", 0);
    set(hall.made, hall.lane, "beta", 0);  // nobody looks for a faster way round
    set(hall.made, hall.lane, "gamma", 0);
    hall.add({5.25, 5.25, 0}, {kSpeed, 0, 0});
    for (int k = 0; k < 3; ++k)
      for (const double y : {4.75, 5.25, 5.75}) hall.add({5.75, y, 0}, {pace, 0, 0});
    hall.walk(1, 1e-6);
    EXPECT_NEAR(hall.vel(0)[0], std::max(pace, 0.01 * kSpeed), 1e-6) << pace;
  }
}

// Half-way between rho_min and rho_max the speed is half-way between one's own and that of the crowd.
TEST(ContinuumCrowds, InBetweenTheSpeedIsLinearInTheDensity) {
  Hall hall(kEast);
  set(hall.made, hall.lane, "d_min", 0);
  set(hall.made, hall.lane, "beta", 0);
  set(hall.made, hall.lane, "gamma", 0);
  set(hall.made, hall.lane, "rho_min", 0.5);
  set(hall.made, hall.lane, "rho_max", 1.5);
  hall.add({5.25, 5.25, 0}, {kSpeed, 0, 0});
  for (const double y : {4.75, 5.25, 5.75}) hall.add({5.75, y, 0}, {0.1, 0, 0});
  hall.walk(1, 1e-6);
  EXPECT_NEAR(hall.vel(0)[0], (kSpeed + 0.1) / 2, 1e-6);
}

TEST(ContinuumCrowds, NobodyWalksThroughAWall) {
  const std::vector<Obstacle> wall{{.shape = Obstacle::Shape::box, .lower = {9, -1, 0}, .upper = {10, 7, 0}, .wall = Bounds::Wall::slip}};
  Hall hall(kEast, wall);
  for (std::uint32_t k = 0; k < 40; ++k) {
    const auto u = Rng{4}.uniform2(Stream::start, 0, k, 0);
    hall.add({1 + 6 * u[0], 1 + 8 * u[1], 0});
  }
  const Walls walls(wall);
  int there = 0;
  for (int k = 0; k < 60; ++k) {
    hall.walk(10);
    for (Index i = 0; i < hall.lane.state.size(); ++i) EXPECT_FALSE(walls.hold(hall.pos(i), 2));
  }
  for (Index i = 0; i < hall.lane.state.size(); ++i) there += hall.pos(i)[0] > 15 ? 1 : 0;
  EXPECT_GE(there, 36) << "round the wall, past y = 7";
}

// Of those within half a unit aside and three along, how many walk the same way? One half where the two streams are mixed at random.
double same_way(const State& state) {
  double same = 0, all = 0;
  for (Index i = 0; i < state.size(); ++i)
    for (Index j = 0; j < state.size(); ++j) {
      const auto apart = (state.pos.row(i) - state.pos.row(j)).abs();
      if (i == j || apart[0] > 3 || apart[1] > 0.5) continue;
      all += 1;
      same += state.kind[static_cast<std::size_t>(i)] == state.kind[static_cast<std::size_t>(j)] ? 1 : 0;
    }
  return same / all;
}

TEST(ContinuumCrowds, TwoStreamsPartIntoLanes) {
  Hall hall({{.centre = {19, 5, 0}, .radius = 0.7}, {.centre = {1, 5, 0}, .radius = 0.7}}, {}, "", 2);
  for (std::uint32_t k = 0; k < 80; ++k) {
    const auto u = Rng{6}.uniform2(Stream::start, 0, k, 0);
    hall.add({6 + 8 * u[0], 1 + 8 * u[1], 0}, {0, 0, 0}, k % 2);
  }
  EXPECT_NEAR(same_way(hall.lane.state), 0.5, 0.07);
  hall.walk(60);
  EXPECT_GT(same_way(hall.lane.state), 0.7);
  hall.walk(240);
  for (Index i = 0; i < hall.lane.state.size(); ++i)
    EXPECT_EQ(hall.pos(i)[0] > 10, hall.lane.state.kind[static_cast<std::size_t>(i)] == 0) << "everybody has passed " << i;
}

// Root mean square over agents that stand, behind a wall. A plane through Perlin noise may be a tenth stronger or weaker than all of it.
TEST(ContinuumCrowds, NoisesAreAsStrongAsTheySay) {
  for (const char* options : {"[noise=perlin]", "[noise=white]"}) {
    Hall hall(kEast, {{.shape = Obstacle::Shape::box, .lower = {16, -1, 0}, .upper = {16.6, 11, 0}}}, options);
    set(hall.made, hall.lane, "agitation", 0.7);
    for (std::uint32_t k = 0; k < 4000; ++k) {
      const auto u = Rng{9}.uniform2(Stream::start, 0, k, 0);
      hall.add({15 * u[0], 10 * u[1], 0});
    }
    set(hall.made, hall.lane, "d_min", 0);
    hall.walk(1, 1e-9);
    EXPECT_NEAR(std::sqrt(hall.lane.state.vel.square().rowwise().sum().mean()), 0.7, 0.07) << options;
  }
}

}  // namespace
}  // namespace swarmfit
