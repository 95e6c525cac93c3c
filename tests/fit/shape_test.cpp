// SPDX-License-Identifier: MIT
#include "fit/synthesis/shape.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fit/experiment/conditions.h"
#include "fit/experiment/plant.h"
#include "libtrack/error.h"

namespace swarmfit {
namespace {

ShapeOptions options(const Curve& curve, double w_user) {
  ShapeOptions o;
  o.pilot = {parse_model("fastswarm"), {{"w_user", w_user}}, "open", 2};
  o.drawn = {curve, false};
  o.agents = 60;
  o.frames = 60;
  o.warm_up = 60;
  return o;
}

TEST(Following, OfAgentsOnAndBesideTheCurve) {
  const Curve line{{{0, 0, 0}, {199, 0, 0}}, false};  // places at 0, 1, .. 199
  TrackColumns c;
  c.names = {"on", "beside"};
  c.track = {0, 1};
  c.frame = {0, 0};
  c.pos.resize(2, 3);
  c.pos << 10, 0, 0, 100, 4, 0;
  TrackMeta meta;
  meta.dt = 1;
  const Following f = following(Tracks(c, meta), line, 2.5);
  EXPECT_NEAR(f.distance, 2, 1e-12);
  EXPECT_NEAR(f.coverage, 5.0 / 200, 1e-12);  // 8 .. 12
}

TEST(Shape, StaysNearTheCurveIfLed) {
  const Tracks reference = demo_recording();
  for (const Curve& curve : {heart(), star()}) {
    const Shape led = fly_along(reference, options(curve, 1)), loose = fly_along(reference, options(curve, 0));
    EXPECT_LT(led.following.distance, 0.5 * loose.following.distance);
    EXPECT_GT(led.following.coverage, loose.following.coverage);
    EXPECT_LT(led.following.distance, led.curve.spacing());
    EXPECT_NEAR(led.curve.spacing(), 20 * natural_scales(reference).speed * reference.dt(), 1e-9);
    EXPECT_EQ(led.tracks.rows(), 60 * 60);
    EXPECT_EQ(led.tracks.frames().front().number, 0);
  }
}

TEST(Shape, NeedsAModelThatCanBeLed) {
  ShapeOptions o = options(star(), 1);
  o.pilot = {parse_model("boids"), {}, "open", 1};
  try {
    fly_along(demo_recording(), o);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "`curve`: boids cannot be led along a curve; expected a model that can: fastswarm");
  }
}

}  // namespace
}  // namespace swarmfit
