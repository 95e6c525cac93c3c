// SPDX-License-Identifier: MIT
#include "fit/compare/force_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/eval/build.h"

namespace swarmfit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Stiffness 6 and drag 0.5, integrated by the test's own steps.
Tracks trapped(std::uint64_t seed) {
  const test::Settings settings{.dt = 0.02};
  return tracks_of(test::trapped(seed, 12, 1000, settings, 400), settings);
}

TEST(ForceView, RecordingAndSimulationAreMeasuredAlike) {
  const Tracks recording = trapped(1);
  const ForceView view(recording);
  const ForceFacts& f = view.facts();
  EXPECT_THAT(f.needed, IsEmpty());
  EXPECT_GT(f.attraction_p, 0.01);
  EXPECT_NEAR(f.recording.confinement[5], 6, 4 * f.se.confinement[5]);
  EXPECT_NEAR(f.recording.drag[5], 0.5, 4 * f.se.drag[5]);
  EXPECT_NEAR(f.recording.noise[0], 400, 25) << "white";
  EXPECT_EQ(f.recording.noise[2], 0) << "no memory";
  EXPECT_EQ(view.of(recording).drag, f.recording.drag);

  const std::vector<ForceCurves> runs{view.of(trapped(2)), view.of(trapped(3)), {}};
  const ForceSpread spread = force_spread(runs);
  ASSERT_EQ(spread.median.attraction.size(), f.grid.pairs.size());
  EXPECT_DOUBLE_EQ(spread.median.confinement[3], (runs[0].confinement[3] + runs[1].confinement[3]) / 2) << "what blew up does not count";
}

TEST(ForceView, CurvesOfWhatThereIs) {
  std::vector<std::string> keys;
  for (const GroupCurve& c : force_curves(trapped(1))) {
    keys.push_back(c.key);
    EXPECT_EQ(c.x.size(), c.y.size());
    EXPECT_EQ(c.x.size(), c.se.size());
  }
  EXPECT_THAT(keys, ElementsAre("drag", "stiffness", "attraction", "alignment"));
  EXPECT_THAT(force_curves(tracks_of(test::trapped(1, 3, 8, {}))), IsEmpty());
}

}  // namespace
}  // namespace swarmfit
