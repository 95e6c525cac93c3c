// SPDX-License-Identifier: MIT
#include "fit/experiment/conditions.h"

#include <gmock/gmock.h>

#include <cmath>

#include "fit/experiment/observe.h"
#include "fit/study/recovery.h"
#include "libswarm/world.h"
#include "libtrack/error.h"
#include "libtrack/kinematics.h"
#include "tests/fit/planted.h"

namespace swarmfit {
namespace {

using ::testing::HasSubstr;

// Two animals 2 apart that walk along x at speed 3, filmed at 10 Hz for six frames; the second is missed in frame 3.
TrackColumns pair_columns() {
  TrackColumns c;
  c.names = {"a", "b"};
  for (std::int64_t f = 0; f < 6; ++f)
    for (std::uint32_t t = 0; t < 2; ++t) {
      if (t == 1 && f == 3) continue;
      c.track.push_back(t);
      c.frame.push_back(f);
    }
  c.pos = Rows::Zero(static_cast<Index>(c.track.size()), 3);
  for (std::size_t i = 0; i < c.track.size(); ++i) {
    c.pos(static_cast<Index>(i), 0) = 0.3 * static_cast<double>(c.frame[i]);
    c.pos(static_cast<Index>(i), 1) = c.track[i] ? 2 : 0;
  }
  return c;
}

TrackMeta ten_hertz() {
  TrackMeta meta;
  meta.dt = 0.1;
  meta.from.path = "pair";
  return meta;
}

Tracks pair() { return Tracks(pair_columns(), ten_hertz()); }

TEST(NaturalScales, OfAWalkingPair) {
  const Scales s = natural_scales(pair());
  EXPECT_NEAR(s.speed, 3, 1e-12);
  EXPECT_NEAR(s.spacing, 2, 1e-12);
  EXPECT_NEAR(s.extent, 1, 1e-12);
  EXPECT_NEAR(s.time(), 1.0 / 3, 1e-12);
}

TEST(Conditions, AgentsEnterAndLeaveWithTheirTracksGapsIncluded) {
  const Conditions c = make_conditions(pair(), {});
  World world = c.world;
  State state;
  for (std::int64_t f = 0; f <= 6; ++f) {
    world.advance({f, 0, 0.1 * static_cast<double>(f), 0.1}, state);
    EXPECT_EQ(state.size(), f < 6 ? 2 : 0) << f;
    if (f == 0) {
      EXPECT_NEAR(state.vel(1, 0), 3, 1e-12);
      EXPECT_EQ(state.pos(1, 1), 2);
    }
  }
}

TEST(Conditions, EntryVelocityIsTheSlopeOverTheFirstFramesButNotAcrossAGap) {
  auto columns = pair_columns();
  for (Index i = 0; i < columns.pos.rows(); ++i)  // after its gap the second animal stands still
    if (columns.track[static_cast<std::size_t>(i)] == 1 && columns.frame[static_cast<std::size_t>(i)] > 3) columns.pos(i, 0) = 50;
  const Conditions c = make_conditions(Tracks(columns, ten_hertz()), {});
  World world = c.world;
  State state;
  world.advance({0, 0, 0, 0.1}, state);
  EXPECT_NEAR(state.vel(1, 0), 3, 1e-12);
}

TEST(Conditions, ConstantPresenceKeepsTheFirstFrame) {
  ConditionOptions options;
  options.presence = ConditionOptions::Presence::constant;
  auto columns = pair_columns();
  const Conditions c = make_conditions(Tracks(columns, ten_hertz()), options);
  World world = c.world;
  State state;
  for (std::int64_t f = 0; f < 6; ++f) world.advance({f, 0, 0.1 * static_cast<double>(f), 0.1}, state);
  EXPECT_EQ(state.size(), 2);
}

TEST(Conditions, PopulationAddsIndividualsThatAreNeverSeen) {
  ConditionOptions options;
  options.population = 16;
  const Conditions c = make_conditions(pair(), options);
  EXPECT_EQ(c.unseen, 14);  // 11 observations in 6 frames: 1.8 seen
  EXPECT_NEAR(c.scales.spacing, 2 * std::cbrt(11.0 / 6 / 16), 1e-12);
  World world = c.world;
  State state;
  world.advance({0, 0, 0, 0.1}, state);
  EXPECT_EQ(state.size(), 16);
  TrackCollector collector;
  Observer camera(&c.recording, Eigen::Array3d::Zero(), {1}, collector, 2);
  camera.frame({0, state.id, state.kind, state.pos, state.vel});
  EXPECT_EQ(collector.take(ten_hertz()).rows(), 2);
  options.population = 1;
  EXPECT_THROW(make_conditions(pair(), options), InputError);
}

TEST(Conditions, NoMotionAndNoGroupAreRefused) {
  auto still = pair_columns();
  still.pos.col(0).setZero();
  EXPECT_THROW(make_conditions(Tracks(still, ten_hertz()), {}), InputError);
  auto alone = pair_columns();
  for (auto& t : alone.track) t = 0;
  TrackColumns one;
  one.names = {"a"};
  for (std::int64_t f = 0; f < 6; ++f) one.track.push_back(0), one.frame.push_back(f);
  one.pos = Rows::Zero(6, 3);
  for (Index f = 0; f < 6; ++f) one.pos(f, 0) = static_cast<double>(f);
  EXPECT_THROW(make_conditions(Tracks(one, ten_hertz()), {}), InputError);
}

std::string arena_error(const char* text) {
  try {
    parse_arena(text, pair());
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(Arena, ParsesAndRefuses) {
  EXPECT_EQ(parse_arena("open", pair()).kind, Bounds::Kind::open);
  EXPECT_NEAR(parse_arena("box", pair()).upper[0], 1.5, 1e-12);
  const auto given = parse_arena("-1:2,-1:3,-4:4", pair());
  EXPECT_EQ(given.kind, Bounds::Kind::box);
  EXPECT_EQ(given.lower[2], -4);
  EXPECT_THAT(arena_error("ball"), HasSubstr("`arena` ball"));
  EXPECT_THAT(arena_error("-1:2,-1:3"), HasSubstr("x0:x1,y0:y1,z0:z1"));
  EXPECT_THAT(arena_error("-1:2,-1:3,4:-4"), HasSubstr("empty"));
  EXPECT_THAT(arena_error("-1:2,-1:x,-4:4"), HasSubstr("'x' is not a number"));
  EXPECT_THAT(arena_error("-1:1,-1:3,-4:4"), HasSubstr("contains them"));
}

TEST(Plant, IsDeterministicAndGapsAreGaps) {
  const Tracks a = test::planted_swarm(5, 0.5, 0.02), b = test::planted_swarm(5, 0.5, 0.02), c = test::planted_swarm(6, 0.5, 0.02);
  ASSERT_EQ(a.rows(), b.rows());
  EXPECT_TRUE((a.pos() == b.pos()).all());
  EXPECT_NE(a.rows(), c.rows());
  EXPECT_LT(a.rows(), 1200);
  EXPECT_EQ(test::planted_swarm(5).rows(), 1200);
}

TEST(Demo, IsDeterministicAndLabelled) {
  const Tracks a = demo_recording();
  EXPECT_TRUE(a.meta().from.synthetic);
  EXPECT_EQ(a.meta().from.path, "demo");
  EXPECT_TRUE((a.pos() == demo_recording().pos()).all());
}

TEST(Conditions, AnEstimateThatIsNotWhiteIsNotSimulated) {
  const Tracks raw = test::planted_swarm(1, 0.5);
  EXPECT_NEAR(make_conditions(raw, {}).sigma[0], 0.5, 0.1);
  const Tracks smoothed = smooth(raw, 1.5);
  EXPECT_FALSE(make_conditions(smoothed, {}).localisation.white);
  EXPECT_EQ(make_conditions(smoothed, {}).sigma.maxCoeff(), 0);
}

// Straight flight with rare turns, filmed without error: of solvers and rounding half a micrometre is estimated, which no metric resolves.
// A camera's error shows.
TEST(Conditions, AnErrorThatShowsInNoMetricIsNotSimulated) {
  const ModelChoice model = parse_model("rvo");
  constexpr Scales scales{100, 70, 225};
  PlantOptions film;
  film.agents = 20;
  film.frames = 300;
  film.unit = "mm";
  const auto seen = [&](double sigma) {
    film.sigma = sigma;
    return make_conditions(planted_recording(model, planted_parameters(model, scales), film, scales, 1), {});
  };
  const Conditions exact = seen(0), fine = seen(1e-4), noisy = seen(0.3);
  EXPECT_FALSE(exact.localisation.white) << "speeds do not show it";
  EXPECT_TRUE(exact.sigma.isZero());
  EXPECT_TRUE(fine.localisation.white);
  EXPECT_GT(fine.localisation.sigma.minCoeff(), 0.9e-4);
  EXPECT_LT(fine.localisation.sigma.maxCoeff(), 1e-3);
  EXPECT_TRUE(fine.sigma.isZero()) << "nor does any metric";
  EXPECT_NEAR(noisy.sigma.mean(), 0.3, 0.03);
}

}  // namespace
}  // namespace swarmfit
