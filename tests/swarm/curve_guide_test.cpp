// SPDX-License-Identifier: MIT
#include "libswarm/curve_guide.h"

#include <gtest/gtest.h>

namespace swarmfit {
namespace {

using Eigen::Array3d;

const Curve kSquare{{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, true};

// Takes an agent to wherever it is led; the key points it was led to.
std::vector<Array3d> errands(CurveGuide guide, const Array3d& start, std::uint64_t seed, int count) {
  State state;
  state.spawn(0, start, Array3d::Zero());
  const World world;
  std::vector<Array3d> goals;
  for (int k = 0; k < count; ++k) {
    guide.advance({k, 0, 0, 0.1, {seed}}, world, state);
    goals.push_back(*guide.goal(0));
    state.pos.row(0) = goals.back().transpose();
  }
  return goals;
}

TEST(CurveGuide, LeadsRoundAClosedCurveEitherWay) {
  bool forwards = false, backwards = false;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto goals = errands(CurveGuide({kSquare, 0.1}), {1.8, 0.1, 0}, seed, 9);  // nearest to key point 1
    const bool on = (goals[0] == kSquare.points[2]).all();
    (on ? forwards : backwards) = true;
    for (std::size_t k = 0; k < 9; ++k) EXPECT_TRUE((goals[k] == kSquare.points[(on ? 2 + k : 8 - k) % 4]).all());
  }
  EXPECT_TRUE(forwards && backwards);
}

TEST(CurveGuide, TurnsRoundAtTheEndsOfAnOpenCurve) {
  const Curve line{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, false};
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const auto goals = errands(CurveGuide({line, 0.1}), {1, 0, 0}, seed, 7);
    for (std::size_t k = 0; k < 7; ++k) EXPECT_EQ(goals[k][0] == 1, k % 2 == 1) << k;
  }
}

TEST(CurveGuide, WaitsUntilTheKeyPointIsReached) {
  CurveGuide guide({kSquare, 0.5});
  State state;
  state.spawn(0, {0, 0, 0}, Array3d::Zero());
  const World world;
  guide.advance({0, 0, 0, 0.1, {3}}, world, state);
  const Array3d goal = *guide.goal(0);
  state.pos.row(0) = (goal + Array3d(0, 0, 0.6)).transpose();
  guide.advance({1, 0, 0, 0.1, {3}}, world, state);
  EXPECT_TRUE((*guide.goal(0) == goal).all());
  state.pos.row(0) = (goal + Array3d(0, 0, 0.4)).transpose();
  guide.advance({2, 0, 0, 0.1, {3}}, world, state);
  EXPECT_FALSE((*guide.goal(0) == goal).all());
  EXPECT_FALSE(guide.goal(17));
}

}  // namespace
}  // namespace swarmfit
