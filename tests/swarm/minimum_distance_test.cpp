// SPDX-License-Identifier: MIT
#include "libswarm/minimum_distance.h"

#include <gtest/gtest.h>

#include "libswarm/scenario/scenario.h"
#include "tests/swarm/lane.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

struct Pushed {
  State state;
  std::uint64_t moved;
};

Pushed pushed(const std::vector<Array3d>& places, const MinimumDistance& distance) {
  Pushed p;
  for (const auto& place : places) p.state.spawn(0, place, {0, 0, 0});
  World world;
  Neighbours near;
  Counters count;
  const std::vector<double> none;
  p.moved = enforce(distance, p.state, world,
                    {.t = 0, .dt = 1, .tick = 3, .can_halve = false, .p = none, .rng = {5}, .near = near, .work = nullptr, .count = count});
  return p;
}

double apart(const State& s, Index i, Index j) { return std::sqrt((s.pos.row(i) - s.pos.row(j)).square().sum()); }

TEST(MinimumDistance, APairEndsExactlyThatFarApart) {
  const Pushed p = pushed({{0.1, 0.1, 0.1}, {0.2, 0.1, 0.1}, {5, 5, 5}}, {0.3, 0});
  EXPECT_EQ(p.moved, 2u);
  EXPECT_NEAR(apart(p.state, 0, 1), 0.3, 1e-12);
  EXPECT_NEAR(p.state.pos(0, 0) + p.state.pos(1, 0), 0.3, 1e-12) << "both give way alike";
  EXPECT_EQ(p.state.pos(2, 0), 5);
}

TEST(MinimumDistance, WhoIsFarEnoughKeepsEveryBit) { EXPECT_EQ(pushed({{0, 0, 0}, {0.3, 0, 0}}, {0.3, 0}).moved, 0u); }

TEST(MinimumDistance, TwoAtOnePlacePart) {
  const Pushed p = pushed({{1, 2, 3}, {1, 2, 3}}, {0.5, 0});
  EXPECT_EQ(p.moved, 2u);
  EXPECT_NEAR(apart(p.state, 0, 1), 0.5, 1e-12);
}

// The paper looks at pairs of one cell only: here one on each side of the face at 1.
TEST(MinimumDistance, AcrossAFaceNobodyIsSeen) {
  EXPECT_EQ(pushed({{0.95, 0.5, 0.5}, {1.05, 0.5, 0.5}}, {0.3, 1}).moved, 0u);
  EXPECT_EQ(pushed({{0.85, 0.5, 0.5}, {0.95, 0.5, 0.5}}, {0.3, 1}).moved, 2u);
}

double least_distance(const std::string& model) {
  Scenario scene = plain_scenario(parse_model(model));
  scene.groups.front().agents = 60;
  scene.groups.front().start.radius = 1;
  scene.frames = 20;
  set_parameter(scene, "d_min", 0.2);
  TrackCollector out;
  const Counters count = play(scene, out);
  EXPECT_EQ(count.enforced > 0, model.find("none") == std::string::npos) << model;
  const Tracks tracks = out.take(meta_of(scene));
  const FrameRange last = tracks.frames().back();
  double least = HUGE_VAL;
  for (Index i = last.first; i < last.first + last.count; ++i)
    for (Index j = last.first; j < i; ++j) least = std::min(least, std::sqrt((tracks.pos().row(i) - tracks.pos().row(j)).square().sum()));
  return least;
}

// One sweep a step does not part everybody of a crowd, but nobody stays close.
TEST(MinimumDistance, KeepsInsectsApart) {
  EXPECT_GT(least_distance("noise_aware[mde=neighbours]"), 0.15);
  EXPECT_LT(least_distance("noise_aware[mde=none]"), 0.1);
}

}  // namespace
}  // namespace swarmfit
