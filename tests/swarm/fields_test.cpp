// SPDX-License-Identifier: MIT
// Distance and cost fields against closed forms and brute force; walls of every shape.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "libswarm/cost_field.h"
#include "libswarm/distance_field.h"
#include "libswarm/paths.h"
#include "libtrack/rng.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

double length(const Array3d& a) { return std::sqrt(a.square().sum()); }

Array3d random_place(std::uint32_t k, double reach) {
  const Rng rng{7};
  const auto xy = rng.uniform2(Stream::start, 0, k, 0);
  return reach * (2 * Array3d(xy[0], xy[1], rng.uniform(Stream::start, 0, k, 1)) - 1);
}

Obstacle sphere() { return {.centre = {0.5, 0, -0.25}, .radius = 1}; }
Obstacle box() { return {.shape = Obstacle::Shape::box, .lower = {-1, -0.5, 0}, .upper = {1, 0.5, 0.75}}; }
Obstacle cylinder() { return {.shape = Obstacle::Shape::cylinder, .lower = {-0.6, -0.8, 0}, .upper = {0.6, 0.8, 0}, .radius = 0.5}; }
Obstacle plane() { return {.shape = Obstacle::Shape::plane, .centre = {0.1, 0, 0}, .normal = {0.6, 0, 0.8}}; }

// Is the place within the body? Written out anew.
bool solid(const Obstacle& o, const Array3d& p) {
  switch (o.shape) {
    case Obstacle::Shape::sphere:
      return length(p - o.centre) < o.radius;
    case Obstacle::Shape::box:
      return (p > o.lower).all() && (p < o.upper).all();
    case Obstacle::Shape::cylinder: {
      const double along = ((p - o.lower) * (o.upper - o.lower)).sum() / (o.upper - o.lower).square().sum();
      return along > 0 && along < 1 && length(p - o.lower - along * (o.upper - o.lower)) < o.radius;
    }
    case Obstacle::Shape::plane:
    case Obstacle::Shape::mesh:
      break;
  }
  return ((p - o.centre) * o.normal).sum() < 0;
}

TEST(DistanceField, ClosedForms) {
  EXPECT_DOUBLE_EQ(surface_of(sphere(), {0.5, 3, -0.25}, 3).distance, 2);
  EXPECT_DOUBLE_EQ(surface_of(sphere(), {0.5, 0, -0.25}, 3).distance, -1);
  EXPECT_DOUBLE_EQ(surface_of(box(), {4, 4.5, 0.5}, 3).distance, 5) << "an edge, 3 and 4 away";
  EXPECT_DOUBLE_EQ(surface_of(box(), {0, 0, 0.5}, 3).distance, -0.25) << "the top";
  EXPECT_DOUBLE_EQ(surface_of(box(), {4, 4.5, 99}, 2).distance, 5) << "z does not count in two dimensions";
  EXPECT_DOUBLE_EQ(surface_of(cylinder(), {0, 0, 2}, 3).distance, 1.5) << "its side";
  EXPECT_NEAR(surface_of(cylinder(), {1.2, 1.6, 0}, 3).distance, 1, 1e-12) << "its end";
  EXPECT_NEAR(surface_of(cylinder(), {0.6 + 1.8, 0.8 + 2.4, 0.5 + 4}, 3).distance, 5, 1e-12) << "the rim, 3 along and 4 across";
  EXPECT_NEAR(surface_of(plane(), {0.1 + 0.6, 5, 0.8}, 3).distance, 1, 1e-12);
}

// The step `distance` against `outward` ends at the surface; no place nearer than the distance is on the other side.
TEST(DistanceField, AgreesWithBruteForce) {
  for (const Obstacle& o : {sphere(), box(), cylinder(), plane()})
    for (std::uint32_t k = 0; k < 300; ++k) {
      const Array3d p = random_place(k, 2);
      const Surface s = surface_of(o, p, 3);
      EXPECT_EQ(s.distance < 0, solid(o, p)) << p.transpose();
      EXPECT_NEAR(length(s.outward), 1, 1e-12);
      EXPECT_NE(solid(o, p - (s.distance + 1e-6) * s.outward), solid(o, p - (s.distance - 1e-6) * s.outward)) << p.transpose();
      for (std::uint32_t n = 0; n < 40; ++n) {
        const Array3d way = random_place(1000 + n, 1);
        EXPECT_EQ(solid(o, p + 0.999 * std::abs(s.distance) * way / length(way)), s.distance < 0) << p.transpose();
      }
    }
}

TEST(DistanceField, TheNearestOfSeveralCounts) {
  EXPECT_DOUBLE_EQ(nearest_surface({sphere(), {.centre = {9, 0, 0}, .radius = 1}}, {7, 0, 0}, 3).distance, 1);
  EXPECT_EQ(nearest_surface({}, {0, 0, 0}, 3).distance, kInfinite);
}

TEST(DistanceField, RepulsionIsWyvills) {
  EXPECT_EQ(repulsion(-3, 2), 1);
  EXPECT_EQ(repulsion(0, 2), 1);
  EXPECT_NEAR(repulsion(1, 2), 0.5, 1e-15);
  EXPECT_NEAR(repulsion(2, 2), 0, 1e-15);
  EXPECT_EQ(repulsion(5, 2), 0);
  const double r = 0.3;
  EXPECT_NEAR(repulsion(r, 1), 1 - 4.0 / 9 * std::pow(r, 6) + 17.0 / 9 * std::pow(r, 4) - 22.0 / 9 * r * r, 1e-15);
  EXPECT_NEAR((repulsion(2, 2) - repulsion(2 - 1e-6, 2)) / 1e-6, 0, 1e-5) << "smooth at its end";
}

// Nobody passes a wall of any shape, however fast: agents are thrown at it with steps longer than it is thick.
TEST(Walls, EveryShapeHolds) {
  for (const Bounds::Wall kind : {Bounds::Wall::reflect, Bounds::Wall::slip})
    for (Obstacle o : {sphere(), box(), cylinder(), plane()}) {
      o.wall = kind;
      const Walls walls({o});
      World world;
      State before, after;
      before.append(100);
      for (Index i = 0; i < before.size(); ++i) {
        Array3d p = random_place(static_cast<std::uint32_t>(i), 2);
        if (const Surface s = surface_of(o, p, 3); s.distance < 0) p -= 2 * s.distance * s.outward;
        before.pos.row(i) = p.transpose();
      }
      after = before;
      for (Index i = 0; i < after.size(); ++i) {
        after.vel.row(i) = -2 * before.pos.row(i) + random_place(static_cast<std::uint32_t>(500 + i), 1).transpose();
        after.pos.row(i) += after.vel.row(i);
      }
      const State aim = after;
      walls.constrain(world, before, after);
      int met = 0;
      for (Index i = 0; i < after.size(); ++i) {
        const Array3d a = before.pos.row(i).transpose(), b = aim.pos.row(i).transpose(), end = after.pos.row(i).transpose();
        EXPECT_FALSE(walls.hold(end, 3)) << i;
        bool crossed = false;
        double closest = kInfinite;
        for (int n = 0; n <= 200; ++n) {
          const Array3d on_way = a + (n / 200.0) * (b - a);
          crossed = crossed || solid(o, on_way);
          closest = std::min(closest, surface_of(o, on_way, 3).distance);
        }
        const bool turned = length(end - b) > 1e-12;
        met += crossed;
        if (crossed) {
          EXPECT_TRUE(turned) << i << ": went through";
        }
        if (closest > 0.03) {
          EXPECT_FALSE(turned) << i << ": turned in free space";
        }
        if (kind == Bounds::Wall::reflect) {
          EXPECT_NEAR(length(after.vel.row(i).transpose()), length(aim.vel.row(i).transpose()), 1e-9) << "a bounce keeps the speed";
        }
      }
      EXPECT_GT(met, 20);
    }
}

// ---- fast marching -----------------------------------------------------------------------------------------------------------------

FieldGrid cube(Index n) { return {.lower = {0, 0, 0}, .cell = 1.0 / static_cast<double>(n), .count = {n, n, n}}; }

CostField from_balls(const FieldGrid& grid, const std::vector<Array3d>& centres, double radius) {
  std::vector<double> slowness(static_cast<std::size_t>(grid.cells()), 1);
  std::vector<bool> goal(slowness.size(), false);
  for (Index c = 0; c < grid.cells(); ++c)
    for (const Array3d& centre : centres)
      if (length(grid.centre(c) - centre) <= radius) goal[static_cast<std::size_t>(c)] = true;
  return {grid, slowness, goal};
}

// Mean error against the distance to the nearest goal cell's centre, found by looking at them all.
double mean_error(Index n, const std::vector<Array3d>& centres) {
  const FieldGrid grid = cube(n);
  const CostField field = from_balls(grid, centres, 0.2);
  double sum = 0;
  for (Index c = 0; c < grid.cells(); ++c) {
    double exact = kInfinite;
    for (const Array3d& centre : centres) exact = std::min(exact, std::max(0.0, length(grid.centre(c) - centre) - 0.2));
    sum += std::abs(field.cost(c) - exact);
  }
  return sum / static_cast<double>(grid.cells());
}

TEST(CostField, ConvergesToTheDistanceInFreeSpaceWithFirstOrder) {
  for (const auto& centres : {std::vector<Array3d>{{0.5, 0.5, 0.5}}, std::vector<Array3d>{{0.2, 0.3, 0.5}, {0.8, 0.8, 0.4}}}) {
    const double coarse = mean_error(12, centres), middle = mean_error(24, centres), fine = mean_error(48, centres);
    EXPECT_LT(fine, 0.02);
    for (const double order : {std::log2(coarse / middle), std::log2(middle / fine)}) {
      EXPECT_GT(order, 0.7);
      EXPECT_LT(order, 1.5);
    }
  }
}

TEST(CostField, IsExactForAPlaneFront) {
  const FieldGrid grid = cube(10);
  std::vector<double> slowness(1000);
  std::vector<bool> goal(1000, false);
  for (Index c = 0; c < 1000; ++c) {
    slowness[static_cast<std::size_t>(c)] = 2;
    goal[static_cast<std::size_t>(c)] = grid.at(c)[0] == 0;
  }
  const CostField field(grid, slowness, goal);
  for (Index c = 0; c < 1000; ++c) EXPECT_NEAR(field.cost(c), 0.2 * static_cast<double>(grid.at(c)[0]), 1e-12);
  EXPECT_LT(length(field.direction({0.51, 0.33, 0.77}) - Array3d(-1, 0, 0)), 1e-12);
  EXPECT_EQ(length(field.direction({0.05, 0.5, 0.5})), 0) << "in the goal";
}

// Every cell has a cheaper neighbour, unless it is a goal; down the cost everybody gets there, through the only gap of a wall.
TEST(CostField, LeadsThroughTheGapOfAWall) {
  const FieldGrid grid = cube(20);
  std::vector<double> slowness(8000, 1);
  std::vector<bool> goal(8000, false);
  for (Index c = 0; c < 8000; ++c) {
    const auto i = grid.at(c);
    const bool gap = i[1] >= 9 && i[1] <= 11 && i[2] >= 9 && i[2] <= 11;
    if (i[0] == 10 && !gap) slowness[static_cast<std::size_t>(c)] = kInfinite;
    goal[static_cast<std::size_t>(c)] = i[0] == 19;
  }
  const CostField field(grid, slowness, goal);
  EXPECT_EQ(field.unreachable(), 0);
  EXPECT_GT(field.cost(grid.index(9, 0, 0)), field.cost(grid.index(9, 10, 10)) + 0.5) << "a wall of one cell is no way through";
  for (std::uint32_t k = 0; k < 50; ++k) {
    Array3d p = Array3d(0.25, 0.5, 0.5) + 0.24 * random_place(k, 1);
    for (int step = 0; step < 400 && p[0] < 0.95; ++step) p += 0.01 * field.direction(p);
    EXPECT_GE(p[0], 0.949) << k;
  }
  for (Index c = 0; c < 8000; ++c) {
    if (goal[static_cast<std::size_t>(c)] || field.cost(c) == kInfinite) continue;
    EXPECT_GT(length(field.direction(grid.centre(c))), 0.999);
  }
}

TEST(CostField, WhatIsWalledOffIsUnreachable) {
  const FieldGrid grid = cube(5);
  std::vector<double> slowness(125, 1);
  std::vector<bool> goal(125, false);
  goal[0] = true;
  for (Index c = 0; c < 125; ++c)
    if (grid.at(c)[0] == 3) slowness[static_cast<std::size_t>(c)] = kInfinite;
  const CostField field(grid, slowness, goal);
  EXPECT_EQ(field.unreachable(), 25);
  EXPECT_EQ(length(field.direction({0.9, 0.5, 0.5})), 0);
}

TEST(Paths, AreFoundAgainWhenTheGoalMoves) {
  PathOptions options;
  options.grid = cube(20);
  Paths paths(options, {{.radius = 0.1, .path = {{0, {0.1, 0.5, 0.5}}, {1, {0.9, 0.5, 0.5}}}}}, {});
  World world;
  State nobody;
  EXPECT_LT(paths.direction({0.5, 0.5, 0.5})[0], -0.99);
  paths.advance({.frame = 1, .sub = 0, .t = 1, .dt = 0.1}, world, nobody);
  EXPECT_GT(paths.direction({0.5, 0.5, 0.5})[0], 0.99);
  EXPECT_NEAR(paths.place(0)[0], 0.9, 1e-12);
}

}  // namespace
}  // namespace swarmfit
