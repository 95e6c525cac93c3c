// SPDX-License-Identifier: MIT
// Against closed forms, against the field of undirected costs, and against sweeps over the whole grid until nothing changes.
#include "libswarm/directed_cost.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "libtrack/rng.h"

namespace swarmfit {
namespace {

using Faces = DirectedCostField::Faces;

constexpr double kNever = std::numeric_limits<double>::infinity();

FieldGrid plane(Index columns, Index rows, double cell) { return {.cell = cell, .count = {columns, rows, 1}}; }

std::vector<bool> goal_at(const FieldGrid& grid, Index i, Index j) {
  std::vector<bool> goal(static_cast<std::size_t>(grid.cells()), false);
  goal[static_cast<std::size_t>(grid.index(i, j, 0))] = true;
  return goal;
}

std::vector<Faces> drawn(const FieldGrid& grid, double least, double most) {
  std::vector<Faces> out(static_cast<std::size_t>(grid.cells()));
  for (std::uint32_t c = 0; c < out.size(); ++c)
    for (std::uint32_t face = 0; face < 4; ++face) out[c][face] = least + (most - least) * Rng{3}.uniform(Stream::start, 0, c, face);
  return out;
}

TEST(DirectedCost, WaysOfOneCellHaveACostOfTheirOwn) {
  const FieldGrid grid = plane(5, 1, 0.5);
  const DirectedCostField field(grid, {5, Faces{3, 1, 1, 1}}, goal_at(grid, 2, 0));
  EXPECT_DOUBLE_EQ(field.cost(0), 2 * 0.5 * 1) << "two cells to the east";
  EXPECT_DOUBLE_EQ(field.cost(4), 2 * 0.5 * 3) << "two cells to the west";
  EXPECT_EQ(field.downhill(0), (Faces{0, 1, 0, 0}));
  EXPECT_EQ(field.downhill(4), (Faces{1, 0, 0, 0}));
  EXPECT_EQ(field.downhill(2), Faces{}) << "the goal";
}

TEST(DirectedCost, NobodyPassesWhatIsInfinite) {
  const FieldGrid grid = plane(3, 1, 1);
  const DirectedCostField field(grid, {Faces{1, kNever, 1, 1}, Faces{1, 1, 1, 1}, Faces{1, 1, 1, 1}}, goal_at(grid, 2, 0));
  EXPECT_EQ(field.cost(0), kNever);
  EXPECT_EQ(field.downhill(0), Faces{});
  EXPECT_EQ(field.cost(1), 1);
}

TEST(DirectedCost, IsTheUndirectedFieldWhereAllFacesCostTheSame) {
  const FieldGrid grid = plane(23, 17, 0.3);
  std::vector<double> slowness;
  std::vector<Faces> faces;
  for (std::uint32_t c = 0; c < grid.cells(); ++c) {
    slowness.push_back(c % 31 == 7 ? kNever : 0.5 + Rng{8}.uniform(Stream::start, 0, c, 0));
    faces.push_back({slowness.back(), slowness.back(), slowness.back(), slowness.back()});
  }
  const auto goal = goal_at(grid, 4, 11);
  const CostField undirected(grid, slowness, goal);
  const DirectedCostField directed(grid, faces, goal);
  for (Index c = 0; c < grid.cells(); ++c) {
    if (slowness[static_cast<std::size_t>(c)] == kNever) continue;
    EXPECT_NEAR(directed.cost(c), undirected.cost(c), 1e-9 * (1 + undirected.cost(c))) << c;
  }
}

// Every cell takes the least that its neighbours offer, again and again, by bisection of the equation instead of its formula.
std::vector<double> swept(const FieldGrid& grid, const std::vector<Faces>& slowness, const std::vector<bool>& goal) {
  std::vector<double> cost(slowness.size(), kNever);
  for (std::size_t c = 0; c < cost.size(); ++c)
    if (goal[c]) cost[c] = 0;
  const auto at = [&](Index i, Index j) {
    return i < 0 || j < 0 || i >= grid.count[0] || j >= grid.count[1] ? kNever : cost[static_cast<std::size_t>(grid.index(i, j, 0))];
  };
  for (int sweep = 0; sweep < 400; ++sweep)
    for (Index j = 0; j < grid.count[1]; ++j)
      for (Index i = 0; i < grid.count[0]; ++i) {
        const auto c = static_cast<std::size_t>(grid.index(i, j, 0));
        if (goal[c]) continue;
        const Faces& s = slowness[c];
        const double h = grid.cell;
        const double west = at(i - 1, j) + s[0] * h, east = at(i + 1, j) + s[1] * h, south = at(i, j - 1) + s[2] * h,
                     north = at(i, j + 1) + s[3] * h;
        const double a = west < east ? at(i - 1, j) : at(i + 1, j), p = (west < east ? s[0] : s[1]) * h;
        const double b = south < north ? at(i, j - 1) : at(i, j + 1), q = (south < north ? s[2] : s[3]) * h;
        double lower = std::min(a, b), upper = std::min(a + p, b + q);
        if (upper == kNever) continue;
        const auto left = [&](double x) { return std::pow(std::max(0.0, x - a) / p, 2) + std::pow(std::max(0.0, x - b) / q, 2) - 1; };
        for (int k = 0; k < 60; ++k) (left((lower + upper) / 2) < 0 ? lower : upper) = (lower + upper) / 2;
        cost[c] = std::min(cost[c], upper);
      }
  return cost;
}

// Marching settles a cell once, from those already settled: the more directions differ in cost, the more that may miss.
TEST(DirectedCost, IsNearWhatSweepsEndAt) {
  const FieldGrid grid = plane(20, 15, 1);
  const auto goal = goal_at(grid, 13, 4);
  for (const double most : {1.2, 2.0, 4.0}) {
    const auto slowness = drawn(grid, 1, most);
    const DirectedCostField field(grid, slowness, goal);
    const auto brute = swept(grid, slowness, goal);
    for (std::size_t c = 0; c < brute.size(); ++c)
      EXPECT_NEAR(field.cost(static_cast<Index>(c)), brute[c], 0.008 * (most - 1) * brute[c]) << c << ", " << most;
  }
}

}  // namespace
}  // namespace swarmfit
