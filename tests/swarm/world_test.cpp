// SPDX-License-Identifier: MIT
#include "libswarm/world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libswarm/stimuli.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;
using testing::ElementsAre;

State one(const Array3d& pos, const Array3d& vel) {
  State state;
  state.spawn(0, pos, vel);
  return state;
}

Bounds unit_box(Bounds::Kind kind, Bounds::Wall wall = Bounds::Wall::reflect) {
  Bounds b;
  b.kind = kind;
  b.wall = wall;
  b.upper.setOnes();
  b.radius = 1;
  return b;
}

#define EXPECT_ROW(block, x, y, z) EXPECT_LT((block.row(0).transpose() - Array3d(x, y, z)).abs().maxCoeff(), 1e-12) << block.row(0)

TEST(State, IdsStayWithTheirAgents) {
  State s;
  s.own.resize(0, 1);
  for (int k = 0; k < 4; ++k) s.own(s.spawn(0, Array3d::Constant(k), -Array3d::Constant(k)), 0) = 10 * k;
  s.entered = 3;
  s.remove(1);
  EXPECT_EQ(s.entered, 2);
  EXPECT_EQ(s.spawn(7, {9, 9, 9}, {0, 0, 0}), 3);
  EXPECT_THAT(s.id, ElementsAre(0, 2, 3, 4));
  EXPECT_THAT(s.kind, ElementsAre(0, 0, 0, 7));
  EXPECT_EQ(s.own(1, 0), 20);
  EXPECT_EQ(s.own(3, 0), 0);
  EXPECT_EQ(s.pos(2, 1), 3);
  EXPECT_EQ(s.vel(2, 1), -3);
  s.spawn(0, {0, 0, 0}, {0, 0, 0}, 20);
  EXPECT_EQ(s.next_id, 21u);
}

TEST(Bounds, BoxReflects) {
  State s = one({1.2, -0.3, 0.5}, {1, -2, 3});
  unit_box(Bounds::Kind::box).confine(s, 3);
  EXPECT_ROW(s.pos, 0.8, 0.3, 0.5);
  EXPECT_ROW(s.vel, -1, 2, 3);
  s = one({2.3, 0, 1}, {1, 1, 1});  // there and back again: two reflections
  unit_box(Bounds::Kind::box).confine(s, 3);
  EXPECT_ROW(s.pos, 0.3, 0, 1);
  EXPECT_ROW(s.vel, 1, 1, 1);
}

TEST(Bounds, BoxSlips) {
  State s = one({1.2, -0.3, 0.5}, {1, -2, 3});
  unit_box(Bounds::Kind::box, Bounds::Wall::slip).confine(s, 3);
  EXPECT_ROW(s.pos, 1, 0, 0.5);
  EXPECT_ROW(s.vel, 0, 0, 3);
}

TEST(Bounds, SphereReflectsAndSlips) {
  State s = one({1.5, 0, 0}, {2, 1, 0});
  unit_box(Bounds::Kind::sphere).confine(s, 3);
  EXPECT_ROW(s.pos, 0.5, 0, 0);
  EXPECT_ROW(s.vel, -2, 1, 0);
  s = one({1.5, 0, 0}, {2, 1, 0});
  unit_box(Bounds::Kind::sphere, Bounds::Wall::slip).confine(s, 3);
  EXPECT_ROW(s.pos, 1, 0, 0);
  EXPECT_ROW(s.vel, 0, 1, 0);
  s = one({1.5, 0, 0}, {-2, 1, 0});  // already on its way back
  unit_box(Bounds::Kind::sphere).confine(s, 3);
  EXPECT_ROW(s.vel, -2, 1, 0);
}

TEST(Bounds, PeriodicWrapsAndMeasuresTheShortWay) {
  const Bounds b = unit_box(Bounds::Kind::periodic);
  State s = one({1.2, -0.3, 3}, {1, -2, 3});
  b.confine(s, 3);
  EXPECT_ROW(s.pos, 0.2, 0.7, 0);
  EXPECT_ROW(s.vel, 1, -2, 3);
  s = one({-1e-18, 0, 0}, {0, 0, 0});
  b.confine(s, 3);
  EXPECT_LT(s.pos(0, 0), 1);
  EXPECT_LT((b.separation({0.9, 0.1, 0.5}, {0.1, 0.9, 0.6}) - Array3d(0.2, -0.2, 0.1)).abs().maxCoeff(), 1e-15);
  EXPECT_LT((unit_box(Bounds::Kind::box).separation({0.9, 0, 0}, {0.1, 0, 0}) - Array3d(-0.8, 0, 0)).abs().maxCoeff(), 1e-15);
}

TEST(Bounds, LeaveFurtherAxesAlone) {
  for (const auto kind : {Bounds::Kind::box, Bounds::Kind::periodic, Bounds::Kind::sphere}) {
    State s = one({3, 3, 0}, {1, 1, 0});
    Bounds b = unit_box(kind);
    b.lower[2] = b.upper[2] = 5;
    b.centre[2] = 5;
    b.confine(s, 2);
    EXPECT_EQ(s.pos(0, 2), 0);
    EXPECT_EQ(s.vel(0, 2), 0);
  }
}

TEST(World, CopiesTheirParts) {
  World world;
  world.add(std::make_unique<Stimuli>(std::vector<Stimulus>{{.velocity = {1, 0, 0}}}));
  World copy = world;
  State nobody;
  copy.advance({0, 0, 5, 0.1}, nobody);
  const auto x = [](const World& w) { return w.part<Stimuli>()->nearest({7, 0, 0}, {}, 3).index; };
  EXPECT_EQ(x(copy), 0);  // has moved to 5
  EXPECT_EQ(x(world), -1);
  EXPECT_EQ(copy.part<Presence>(), nullptr);
}

TEST(Presence, EntersAndLeavesAsRecorded) {
  Presence presence({{.id = 5, .kind = 1, .enter = 2, .leave = 3, .pos = {1, 2, 3}, .vel = {4, 5, 6}},
                     {.id = 1, .kind = 0, .enter = 0, .leave = 9, .pos = {0, 0, 0}, .vel = {0, 0, 0}},
                     {.id = 5, .kind = 1, .enter = 4, .leave = 4, .pos = {7, 7, 7}, .vel = {0, 0, 0}},
                     {.id = 4, .kind = 0, .enter = 2, .leave = 9, .pos = {0, 0, 0}, .vel = {0, 0, 0}}});
  State s;
  const auto ids_at = [&](std::int64_t frame) {
    presence.advance({frame, 0, 0, 0}, World{}, s);
    presence.advance({frame, 1, 0, 0}, World{}, s);
    return s.id;
  };
  EXPECT_THAT(ids_at(0), ElementsAre(1));
  EXPECT_THAT(ids_at(1), ElementsAre(1));
  EXPECT_THAT(ids_at(2), ElementsAre(1, 4, 5));
  EXPECT_EQ(s.vel(2, 2), 6);
  EXPECT_EQ(s.kind[2], 1);
  EXPECT_THAT(ids_at(3), ElementsAre(1, 4, 5));
  EXPECT_THAT(ids_at(4), ElementsAre(1, 4, 5));  // left and came back
  EXPECT_EQ(s.pos(2, 0), 7);
  EXPECT_THAT(ids_at(5), ElementsAre(1, 4));
  EXPECT_THAT(ids_at(10), ElementsAre());
}

TEST(Stimuli, NearestInRangeAndTheRepellingOneWinsTies) {
  using enum Stimulus::Kind;
  Stimuli s({{attract, {1, 0, 0}, {0, 0, 0}}, {repel, {-1, 0, 0}, {0, 0, 0}}, {attract, {0, 3, 0}, {0, 0, 0}}});
  EXPECT_EQ(s.nearest({0, 0, 0}, {}, 5).index, 1);
  EXPECT_EQ(s.nearest({0.1, 0, 0}, {}, 5).index, 0);
  EXPECT_EQ(s.nearest({0, 2, 0}, {}, 5).index, 2);
  EXPECT_EQ(s.nearest({0, 2, 0}, {}, 0.5).index, -1);
  EXPECT_EQ(s.nearest({0, 2, 0}, {}, 1).index, 2);  // H(0) = 1
  EXPECT_LT((s.nearest({0, 2, 0}, {}, 5).from - Array3d(0, -1, 0)).abs().maxCoeff(), 1e-15);
}

// 400 agents enter at speed 2 +- 0.5 along x alone: the draws have that mean and scatter (99 %: 0.5 * 2.58/sqrt(400), and /sqrt(800)),
// every run its own, and a run the same again.
TEST(Presence, EveryRunDrawsTheErrorOfEntryVelocities) {
  std::vector<Presence::Visit> visits;
  for (std::uint32_t k = 0; k < 400; ++k) visits.push_back({k, 0, -3, 9, Array3d::Zero(), {2, 1, 0}, {0.5, 0, 0}});
  const auto entered = [&](std::uint64_t seed) {
    Presence presence(visits);
    State state;
    presence.advance({-3, 0, 0, 0.1, {seed}}, {}, state);
    return state;
  };
  const State a = entered(1), again = entered(1), b = entered(2);
  EXPECT_TRUE((a.vel == again.vel).all());
  EXPECT_FALSE((a.vel == b.vel).all());
  EXPECT_TRUE((a.vel.col(1) == 1).all() && (a.vel.col(2) == 0).all());
  const double mean = a.vel.col(0).mean(), sd = std::sqrt((a.vel.col(0) - mean).square().mean());
  EXPECT_NEAR(mean, 2, 0.065);
  EXPECT_NEAR(sd, 0.5, 0.046);
}

}  // namespace
}  // namespace swarmfit
