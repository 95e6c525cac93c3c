// SPDX-License-Identifier: MIT
#include "libeval/summary.h"

#include <gmock/gmock.h>

#include <cmath>

#include "libeval/robust.h"
#include "libeval/suspicions.h"
#include "tests/eval/build.h"

namespace swarmfit {
namespace {

using test::Row;
using test::Settings;
using test::tracks_of;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
constexpr double kDt = 0.01;

// 20 individuals on smooth orbits with a little camera error: nothing to complain about.
std::vector<Row> good(std::int64_t frames = 300) {
  auto rows = test::rows_of(20, frames, kDt, [](std::uint32_t i, double t) { return test::orbit(1, 80, 3, i, t); });
  for (Row& row : rows)
    for (std::uint32_t axis = 0; axis < 3; ++axis)
      row.p[axis] += 0.02 * test::normal(2, static_cast<std::uint64_t>(row.frame), row.track, axis);
  return rows;
}

Row& at(std::vector<Row>& rows, std::uint32_t track, std::int64_t frame) {
  return *std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.track == track && r.frame == frame; });
}

std::vector<std::string> suspected(const Tracks& tracks) {
  std::vector<std::string> what;
  for (const Suspicion& s : summarise(tracks).suspicions) what.push_back(s.what);
  return what;
}

Suspicion the(const std::string& what, const Tracks& tracks) {
  for (const Suspicion& s : summarise(tracks).suspicions)
    if (s.what == what) return s;
  return {};
}

TEST(Robust, MedianAndMad) {
  const Robust r = robust({1, 2, 3, 4, 100});
  EXPECT_EQ(r.median, 3);
  EXPECT_DOUBLE_EQ(r.sd, kMadToSd);
  EXPECT_EQ(count_outliers({1, 2, 3, 4, 100, -100}, 10), 2u);
  EXPECT_TRUE(std::isnan(robust({}).median));
  EXPECT_EQ(count_outliers({}, 10), 0u);
}

TEST(Quantiles, OfKnownNumbers) {
  std::vector<double> x = {std::nan("")};
  for (int i = 100; i >= 0; --i) x.push_back(i);
  const Quantiles q = quantiles(x);
  EXPECT_EQ(q.count, 101u);
  EXPECT_DOUBLE_EQ(q.mean, 50);
  EXPECT_DOUBLE_EQ(q.sd, std::sqrt(850.0));
  EXPECT_EQ(q.min, 0);
  EXPECT_EQ(q.q05, 5);
  EXPECT_EQ(q.median, 50);
  EXPECT_EQ(q.q95, 95);
  EXPECT_EQ(q.max, 100);
  EXPECT_TRUE(std::isnan(quantiles({}).median));
  // 5 to 95 in twelve bins of 7.5: the upper end belongs to the last.
  EXPECT_EQ(q.shape, (std::vector<std::uint64_t>{8, 7, 8, 7, 8, 7, 8, 7, 8, 7, 8, 8}));
  EXPECT_TRUE(quantiles({2, 2, 2}).shape.empty());
  EXPECT_TRUE(quantiles({}).shape.empty());
}

TEST(Summary, CountsTracksSegmentsAndGaps) {
  std::vector<Row> rows;
  for (const int k : {10, 11, 14, 15, 16, 18}) rows.push_back({0, k, {1.0 * k, 0, 0}});
  for (const int k : {10, 11, 12}) rows.push_back({1, k, {-1.0 * k, 5, 2}});
  const Summary s = summarise(tracks_of(rows, {.dt = 0.5}));
  EXPECT_EQ(s.tracks, 2u);
  EXPECT_EQ(s.rows, 9);
  EXPECT_EQ(s.frames, 7u);
  EXPECT_EQ(s.segments, 4u);
  EXPECT_EQ(s.gaps, 2u);
  EXPECT_EQ(s.missing_frames, 3u);
  EXPECT_EQ(s.first_frame, 10);
  EXPECT_EQ(s.last_frame, 18);
  EXPECT_DOUBLE_EQ(s.duration, 4);
  EXPECT_EQ(s.track_length.max, 6);
  EXPECT_EQ(s.segment_length.min, 1);
  EXPECT_EQ(s.individuals.max, 2);
  EXPECT_DOUBLE_EQ(s.speed.mean, 2);
  EXPECT_THAT(s.lower, ElementsAre(-12, 0, 0));
  EXPECT_THAT(s.upper, ElementsAre(18, 5, 2));
}

TEST(Summary, ABreakBetweenTakesIsNoGap) {
  std::vector<Row> rows;
  for (const int k : {0, 1, 2, 7, 8, 10}) rows.push_back({0, k, {1.0 * k, 0, 0}});
  const Summary s = summarise(tracks_of(rows, {.episodes = {5}}));
  EXPECT_EQ(s.segments, 3u);
  EXPECT_EQ(s.gaps, 1u);  // only frame 9
  EXPECT_EQ(s.missing_frames, 1u);
}

TEST(Summary, EmptyRecording) {
  for (const Tracks& tracks : {Tracks(), tracks_of({})}) {
    const Summary s = summarise(tracks);
    EXPECT_EQ(s.rows, 0);
    EXPECT_TRUE(std::isnan(s.speed.mean));
    EXPECT_TRUE(std::isnan(s.lower[0]));
    EXPECT_THAT(s.suspicions, IsEmpty());
  }
}

TEST(Summary, CountsOutliers) {
  auto rows = good();
  at(rows, 3, 100).p[0] += 300;  // out and back
  const Summary s = summarise(tracks_of(rows, {.dt = kDt}));
  EXPECT_EQ(s.speed_outliers, 2u);
  EXPECT_EQ(s.acceleration_outliers, 3u);
}

TEST(Suspicions, NoneWithoutReason) { EXPECT_THAT(suspected(tracks_of(good(), {.dt = kDt})), IsEmpty()); }

TEST(Suspicions, IdentitySwap) {
  auto rows = good();
  for (Row& row : rows)
    if (row.track < 2 && row.frame >= 100) row.track = 1 - row.track;
  const Tracks tracks = tracks_of(rows, {.dt = kDt});
  const auto events = identity_events(tracks);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(tracks.frame()[static_cast<std::size_t>(events[0].row)], 99);
  EXPECT_EQ(tracks.track()[static_cast<std::size_t>(events[0].row)], 0u);
  EXPECT_EQ(tracks.track()[static_cast<std::size_t>(events[0].other)], 1u);
  EXPECT_THAT(suspected(tracks), ElementsAre("identity swap"));
  EXPECT_EQ(the("identity swap", tracks).examples, "track 0, frame 99");
}

TEST(Suspicions, SwapThatNoStepLengthShows) {
  // two straight, parallel paths 40 mm apart at 1 mm per frame among 18 others; exchanged from frame 50 on
  auto rows = good(100);
  for (Row& row : rows)
    if (row.track < 2) {
      const bool upper = (row.track == 1) != (row.frame >= 50);
      row.p = {200 + 1.0 * static_cast<double>(row.frame), upper ? 40.0 : 0.0, 0};
    }
  const auto events = identity_events(tracks_of(rows, {.dt = kDt}));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_GE(events[0].other, 0);
}

TEST(Suspicions, IdentityJump) {
  auto rows = good();
  for (Row& row : rows)
    if (row.track == 4 && row.frame >= 150) row.p[1] += 400;
  const Tracks tracks = tracks_of(rows, {.dt = kDt});
  EXPECT_THAT(suspected(tracks), ElementsAre("identity jump"));
  EXPECT_EQ(the("identity jump", tracks).examples, "track 4, frame 149");
  EXPECT_THAT(the("identity jump", tracks).message, HasSubstr("1 step "));
}

TEST(Suspicions, FastAnimalsAreNoJumps) {
  auto rows = good();
  for (Row& row : rows)
    if (row.track == 4) row.p = {300.0 * static_cast<double>(row.frame), 0, 0};  // one that passes by at 300 mm per frame
  EXPECT_THAT(suspected(tracks_of(rows, {.dt = kDt})), Not(testing::Contains("identity jump")));
}

TEST(Suspicions, FrozenTrack) {
  auto rows = good();
  for (Row& row : rows)
    if (row.track == 7 && row.frame > 200) row.p = at(rows, 7, 200).p;
  const Tracks tracks = tracks_of(rows, {.dt = kDt});
  EXPECT_THAT(suspected(tracks), testing::Contains("frozen track"));
  EXPECT_EQ(the("frozen track", tracks).examples, "track 7, frame 200");
  EXPECT_THAT(the("frozen track", tracks).message, HasSubstr("1 of 20 tracks"));
}

TEST(Suspicions, DoubleDetection) {
  auto rows = good();
  at(rows, 3, 40).p = at(rows, 9, 40).p;
  const Tracks tracks = tracks_of(rows, {.dt = kDt});
  EXPECT_EQ(the("double detection", tracks).examples, "track 3, frame 40");
}

TEST(Suspicions, UnitsOfRecordedVelocities) {
  const auto message = [](double factor) {
    auto rows = good();
    for (std::size_t i = 0; i + 20 < rows.size(); ++i)
      for (std::size_t axis = 0; axis < 3; ++axis) rows[i].v[axis] = factor * (rows[i + 20].p[axis] - rows[i].p[axis]) / kDt;
    return the("unit", tracks_of(rows, {.dt = kDt, .velocity = true})).message;
  };
  EXPECT_EQ(message(1), "");
  EXPECT_EQ(message(1.1), "");
  EXPECT_THAT(message(0.001), HasSubstr("0.001"));
  EXPECT_THAT(message(10), HasSubstr("two different length units"));
  EXPECT_THAT(message(0.01), HasSubstr("per frame"));
  EXPECT_THAT(message(2), HasSubstr("--fps"));
}

TEST(Suspicions, ConstantColumns) {
  auto rows = good();
  for (Row& row : rows) row.p[2] = 5;
  EXPECT_THAT(the("constant column", tracks_of(rows, {.dt = kDt, .velocity = true})).message, HasSubstr("z, vx, vy, vz;"));
}

TEST(Suspicions, MeasurementError) {
  auto rows = good();
  for (Row& row : rows)
    for (std::uint32_t axis = 0; axis < 3; ++axis) row.p[axis] += test::normal(3, static_cast<std::uint64_t>(row.frame), row.track, axis);
  const Tracks tracks = tracks_of(rows, {.dt = kDt});
  EXPECT_THAT(suspected(tracks), ElementsAre("measurement error"));
  EXPECT_THAT(the("measurement error", tracks).message, HasSubstr("mm (x, y, z) explains"));
}

TEST(Suspicions, SmoothedPositions) {
  const Tracks tracks = tracks_of(test::trapped(1, 20, 200, {.dt = kDt}), {.dt = kDt});
  EXPECT_THAT(suspected(tracks), ElementsAre("smoothed positions"));
}

TEST(Suspicions, ShortSegmentsAndFewIndividuals) {
  auto rows = good();
  std::erase_if(rows, [](const Row& r) { return r.frame % 6 == 5 || r.track >= 4; });
  EXPECT_THAT(suspected(tracks_of(rows, {.dt = kDt})), testing::IsSupersetOf({"short segments", "few individuals"}));
}

TEST(Suspicions, NamesAtMostThreePlaces) {
  auto rows = good();
  for (const std::int64_t k : {10, 20, 30, 40, 50}) at(rows, 3, k).p = at(rows, 9, k).p;
  const Suspicion s = the("double detection", tracks_of(rows, {.dt = kDt}));
  EXPECT_THAT(s.message, HasSubstr("5 pairs"));
  EXPECT_EQ(s.examples, "track 3, frame 10; track 3, frame 20; track 3, frame 30");
}

}  // namespace
}  // namespace swarmfit
