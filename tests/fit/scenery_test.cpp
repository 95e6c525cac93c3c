// SPDX-License-Identifier: MIT
#include "fit/experiment/scenery.h"

#include <gtest/gtest.h>

#include <cmath>

#include "libswarm/scenario/read.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

const char* const kScene = R"(
title = "all there is"
model = "bswarm"
agents = 5
frames = 3
[bounds]
shape = "box"
lower = [-5, -5, -5]
upper = [5, 5, 5]
[[obstacle]]
shape = "box"
lower = [-9, 4, -9]
upper = [9, 9, 9]
[[obstacle]]
shape = "cylinder"
lower = [0, 0, -2]
upper = [0, 0, 2]
radius = 0.5
[[obstacle]]
shape = "sphere"
centre = [3, 0, 0]
radius = 1
[[obstacle]]
shape = "plane"
centre = [0, -4, 0]
normal = [0, 1, 0]
[[stimulus]]
kind = "repel"
at = [0, 0, 4]
velocity = [100, 0, 0]
from = 0.01
[[stimulus]]
kind = "attract"
ring = {radius = 2, ahead = 30}
[[goal]]
at = [-2, -2, -2]
radius = 0.7
)";

double volume(const Scenery::Solid& solid) {
  double sum = 0;
  for (const auto& face : solid.faces)
    for (std::size_t k = 1; k + 1 < face.size(); ++k) {
      const Array3d a = solid.corners[static_cast<std::size_t>(face[0])], b = solid.corners[static_cast<std::size_t>(face[k])],
                    c = solid.corners[static_cast<std::size_t>(face[k + 1])];
      sum += a.matrix().dot(Eigen::Vector3d(b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0])) / 6;
    }
  return sum;
}

// Faces that all turn outwards enclose the body's volume; one that is turned or missing would not.
TEST(Scenery, HoldsBodiesArenaAndMarks) {
  const Scenario scene = read_scenario("all.toml", kScene);
  const Scenery s = scenery_of(scene, film(scene, {}));
  ASSERT_EQ(s.solids.size(), 3u);
  EXPECT_NEAR(volume(s.solids[0]), 10 * 1 * 10, 1e-9);  // what of it lies in the arena
  EXPECT_NEAR(volume(s.solids[1]), 24 * 0.5 * 0.25 * std::sin(2 * M_PI / 24) * 4, 1e-9);
  for (const Array3d& corner : s.solids[2].corners) EXPECT_NEAR(corner[1], -4, 1e-12);
  ASSERT_EQ(s.balls.size(), 1u);
  EXPECT_EQ(s.balls[0].radius, 1);
  ASSERT_EQ(s.marks.size(), 3u);
  EXPECT_EQ(s.marks[0].kind, Scenery::Mark::Kind::repel);
  EXPECT_EQ(s.marks[1].radius, 2);
  EXPECT_EQ(s.marks[2].kind, Scenery::Mark::Kind::goal);
  ASSERT_TRUE(s.box);
  EXPECT_EQ(s.box->lower[2], -5);
  ASSERT_TRUE(s.seen);
  EXPECT_EQ(s.seen->rows(), 2 + 3 + 3);  // the predator comes later
}

// Around a group that fills a hundredth of it, it would be all there is to see.
TEST(Scenery, AWideArenaIsLeftOut) {
  const Scenario scene = read_scenario(
      "wide.toml", "title = \"w\"\nmodel = \"brownian\"\nframes = 2\n[bounds]\nshape = \"sphere\"\nradius = 100\n[start]\nradius = 1\n");
  const Scenery s = scenery_of(scene, film(scene, {}));
  EXPECT_FALSE(s.round_arena);
  EXPECT_LT(s.box->upper[0], 5);
}

}  // namespace
}  // namespace swarmfit
