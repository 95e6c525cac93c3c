// SPDX-License-Identifier: MIT
#include "libswarm/walls.h"

#include <gtest/gtest.h>

#include "tests/swarm/blind.h"
#include "tests/swarm/lane.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;
using Shape = Obstacle::Shape;

Obstacle ball(double radius, Bounds::Wall wall = Bounds::Wall::reflect, const Array3d& centre = {0, 0, 0}) {
  return {.shape = Shape::sphere, .centre = centre, .radius = radius, .wall = wall};
}

Obstacle block(const Array3d& lower, const Array3d& upper, Bounds::Wall wall = Bounds::Wall::reflect) {
  return {.shape = Shape::box, .lower = lower, .upper = upper, .wall = wall};
}

World world_of(std::vector<Obstacle> obstacles, int dims = 3) {
  World world;
  world.dims = dims;
  world.add(std::make_unique<Walls>(std::move(obstacles)));
  return world;
}

struct After {
  Array3d pos, vel;
};

After moved(const World& world, const Array3d& from, const Array3d& to, const Array3d& vel) {
  State before, after;
  before.spawn(0, from, vel);
  after.spawn(0, to, vel);
  world.constrain(before, after);
  return {after.pos.row(0).transpose(), after.vel.row(0).transpose()};
}

#define EXPECT_AT(a, x, y, z) EXPECT_LT(((a)-Array3d(x, y, z)).abs().maxCoeff(), 1e-12) << (a).transpose()

TEST(Walls, ReflectAtABlock) {
  const auto a = moved(world_of({block({1, -5, -5}, {2, 5, 5})}), {0, 0, 0}, {1.4, 0.7, 0}, {2, 1, 0});
  EXPECT_AT(a.pos, 0.6, 0.7, 0);
  EXPECT_AT(a.vel, -2, 1, 0);
}

TEST(Walls, SlideAlongABlock) {
  const auto a = moved(world_of({block({1, -5, -5}, {2, 5, 5}, Bounds::Wall::slip)}), {0, 0, 0}, {1.4, 0.7, 0}, {2, 1, 0});
  EXPECT_AT(a.pos, 1, 0.7, 0);
  EXPECT_AT(a.vel, 0, 1, 0);
}

TEST(Walls, NobodyPassesThroughAThinOne) {
  const auto a = moved(world_of({block({1, -5, -5}, {1 + 1e-6, 5, 5})}), {0, 0, 0}, {3, 0, 0}, {2, 0, 0});
  EXPECT_AT(a.pos, -1, 0, 0);
  EXPECT_AT(a.vel, -2, 0, 0);
}

TEST(Walls, ReflectAtABall) {
  const auto head_on = moved(world_of({ball(1)}), {-2, 0, 0}, {0.5, 0, 0}, {2, 0, 0});
  EXPECT_AT(head_on.pos, -2.5, 0, 0);
  EXPECT_AT(head_on.vel, -2, 0, 0);
  // At 45 degrees of the surface the way turns by a right angle.
  const double y = std::sqrt(0.5);
  const auto aside = moved(world_of({ball(1)}), {-2, y, 0}, {0, y, 0}, {3, 0, 0});
  EXPECT_AT(aside.pos, -y, 2 * y, 0);
  EXPECT_AT(aside.vel, 0, 3, 0);
  EXPECT_AT(moved(world_of({ball(1)}), {-2, 1.001, 0}, {2, 1.001, 0}, {1, 0, 0}).pos, 2, 1.001, 0);  // past it
}

TEST(Walls, SlideRoundABall) {
  const double y = std::sqrt(0.5);
  const auto a = moved(world_of({ball(1, Bounds::Wall::slip)}), {-2, y, 0}, {0, y, 0}, {2, 0, 0});
  EXPECT_AT(a.pos, -y + y / 2, y + y / 2, 0);  // the rest of the way, y, loses half along each axis
  EXPECT_AT(a.vel, 1, 1, 0);
}

TEST(Walls, InThePlaneABallIsADisc) {
  const auto a = moved(world_of({ball(1, Bounds::Wall::reflect, {0, 0, 7})}, 2), {-2, 0, 0}, {0, 0, 0}, {1, 0, 0});
  EXPECT_AT(a.pos, -2, 0, 0);
  EXPECT_AT(a.vel, -1, 0, 0);
}

TEST(Walls, WhoStartsInsideIsPutOut) {
  EXPECT_AT(moved(world_of({ball(2)}), {0, 0.5, 0}, {0, 0.5, 0}, {0, 0, 0}).pos, 0, 2, 0);
  EXPECT_AT(moved(world_of({ball(2)}), {0, 0, 0}, {0, 0, 0}, {0, 0, 0}).pos, 2, 0, 0);
  EXPECT_AT(moved(world_of({block({-1, -1, -1}, {1, 1, 3})}), {0.2, 0.9, 0}, {0.2, 0.9, 0}, {0, 0, 0}).pos, 0.2, 1, 0);
}

TEST(Walls, WhoMeetsNoneKeepsEveryBit) {
  const Array3d to(0.1 + 0.2, -0.7, 1. / 3);
  const auto a = moved(world_of({ball(1, Bounds::Wall::reflect, {5, 5, 5})}), {0, 0, 0}, to, {0.1, 0.2, 0.3});
  EXPECT_TRUE((a.pos == to).all());
}

TEST(Walls, ACornerBetweenTwoBlocksTurnsBack) {
  const auto a = moved(world_of({block({1, -9, -9}, {2, 9, 9}), block({-9, 1, -9}, {9, 2, 9})}), {0, 0, 0}, {1.5, 1.25, 0}, {6, 5, 0});
  EXPECT_AT(a.pos, 0.5, 0.75, 0);
  EXPECT_AT(a.vel, -6, -5, 0);
}

TEST(Walls, HoldWhateverTheModelKnows) {
  for (const auto kind : {Bounds::Kind::open, Bounds::Kind::box, Bounds::Kind::sphere, Bounds::Kind::periodic})
    for (const auto wall : {Bounds::Wall::reflect, Bounds::Wall::slip})
      for (const int dims : {2, 3}) {
        const Walls walls({ball(0.8, wall), ball(0.6, wall, {1.1, 0, 0}), block({-2, 0.2, -2}, {0.5, 0.21, 2}, wall),
                           block({-2.5, -2.5, -1}, {-1.8, 2, 1}, wall)});
        Lane lane;
        lane.world.dims = dims;
        lane.world.bounds.kind = kind;
        lane.world.bounds.lower.setConstant(-2);
        lane.world.bounds.upper.setConstant(2);
        lane.world.bounds.radius = 2;
        lane.world.add(walls.clone());
        for (std::uint32_t k = 0; k < 50; ++k) lane.state.spawn(0, {1.5 - 0.01 * k, -1, 0}, {0, 0, 0});
        Recorded out;
        lane.out = &out;
        cpu_backend().run(test::Blind{}, {.frame_dt = 0.5, .frames = 200}, {&lane, 1});
        EXPECT_FALSE(lane.blew_up);
        for (std::size_t m = 1; m < out.moments.size(); ++m)
          for (Index i = 0; i < 50; ++i) {
            const Array3d p = out.moments[m].pos.row(i).transpose();
            EXPECT_FALSE(walls.hold(p, dims)) << p.transpose();
            if (kind == Bounds::Kind::box || kind == Bounds::Kind::periodic) {
              EXPECT_LE(p.abs().maxCoeff(), 2);
            }
            if (kind == Bounds::Kind::sphere) {
              EXPECT_LE(std::sqrt(p.square().sum()), 2 + 1e-12);
            }
          }
      }
}

}  // namespace
}  // namespace swarmfit
