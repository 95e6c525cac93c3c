// SPDX-License-Identifier: MIT
#include "libeval/following.h"

#include <gtest/gtest.h>

#include "libeval/behaviour.h"

namespace swarmfit {
namespace {

// Two agents at places 0, 1, .. 199 of a line and beside it, and a frame later both on it.
Tracks on_and_beside() {
  TrackColumns c;
  c.names = {"on", "beside"};
  c.track = {0, 1, 0, 1};
  c.frame = {0, 0, 1, 1};
  c.pos.resize(4, 3);
  c.pos << 10, 0, 0, 100, 4, 0, 10, 0, 0, 100, 0, 0;
  TrackMeta meta;
  meta.dt = 1;
  return {c, meta};
}

const Curve kLine{{{0, 0, 0}, {100, 0, 0}, {199, 0, 0}}, false};

TEST(Following, OfAgentsOnAndBesideTheCurve) {
  const Tracks tracks = on_and_beside();
  const Following first = following(tracks, std::span(tracks.frames()).first(1), kLine, 2.5);
  EXPECT_NEAR(first.distance, 2, 1e-12);
  EXPECT_NEAR(first.coverage, 5.0 / 200, 1e-12);  // 8 .. 12
  const Following both = following(tracks, tracks.frames(), kLine, 2.5);
  EXPECT_NEAR(both.distance, 1, 1e-12);
  EXPECT_NEAR(both.coverage, 7.5 / 200, 1e-12);
}

TEST(Following, IsWhatScenariosExpectOfACurve) {
  const Tracks tracks = on_and_beside();
  const Witness seen{.agents = tracks, .curve = &kLine, .reach = 2.5};
  EXPECT_NEAR(observed("off_curve", seen, {{"until", {0}}}), 2 / 99.5, 1e-12);
  EXPECT_NEAR(observed("curve_covered", seen, {}), 7.5 / 200, 1e-12);
  EXPECT_TRUE(std::isnan(observed("off_curve", {.agents = tracks}, {})));
  EXPECT_TRUE(std::isnan(observed("curve_covered", {.agents = tracks}, {})));
}

}  // namespace
}  // namespace swarmfit
