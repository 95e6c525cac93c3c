// SPDX-License-Identifier: MIT
#include "libtrack/read/frame_clock.h"

#include <gmock/gmock.h>

#include <cmath>

#include "libtrack/rng.h"

namespace swarmfit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

FrameClock fit(const std::vector<double>& time) { return fit_frame_clock(time, std::vector<std::size_t>{0, time.size()}); }

double uniform(std::uint64_t i) { return Rng{7}.uniform(Stream::probe, i, 0); }

TEST(FrameClock, ExactTimes) {
  const auto clock = fit({0.06, 0.07, 0.08, 0.09, 0.1});
  EXPECT_EQ(clock.problem, "");
  EXPECT_EQ(clock.dt, 0.01);
  EXPECT_EQ(clock.t0, 0);
  EXPECT_THAT(clock.frame, ElementsAre(6, 7, 8, 9, 10));
}

TEST(FrameClock, ThePhaseIsKept) {
  const auto clock = fit({5.25, 6.25, 7.25});
  EXPECT_EQ(clock.dt, 1);
  EXPECT_NEAR(clock.t0, 0.25, 1e-12);
  EXPECT_THAT(clock.frame, ElementsAre(5, 6, 7));
}

TEST(FrameClock, MissingFrames) {
  EXPECT_THAT(fit({0, 1, 3}).frame, ElementsAre(0, 1, 3));
  EXPECT_THAT(fit({0, 2, 4, 5, 7, 9}).frame, ElementsAre(0, 2, 4, 5, 7, 9)) << "the median step is two frames";
  EXPECT_THAT(fit({0, 0.5, 1000}).frame, ElementsAre(0, 1, 2000));
}

TEST(FrameClock, TimesRoundedToTwoDecimals) {
  std::vector<double> time;
  for (int k = 0; k < 5000; ++k) time.push_back(std::round(k / 30.0 * 100) / 100);
  const auto clock = fit(time);
  EXPECT_EQ(clock.dt, 1.0 / 30);
  EXPECT_EQ(clock.t0, 0);
  EXPECT_NEAR(clock.deviation, 1.0 / 300, 1e-6);
  for (int k = 0; k < 5000; ++k) ASSERT_EQ(clock.frame[static_cast<std::size_t>(k)], k);
}

// Ten hours at an odd rate, three quarters of the frames missed, times with jitter: no rounding may slip by a frame.
TEST(FrameClock, ALongSparseJitteredRecording) {
  constexpr double dt = 0.0337;
  std::vector<double> time;
  std::vector<std::int64_t> frame;
  for (int k = 0; k < 1'000'000; ++k) {
    if (uniform(static_cast<std::uint64_t>(k)) > 0.25) continue;
    frame.push_back(k);
    time.push_back(dt * (k + 0.2 * (uniform(static_cast<std::uint64_t>(k) + (1u << 30)) - 0.5)));
  }
  const auto clock = fit(time);
  ASSERT_EQ(clock.problem, "");
  EXPECT_NEAR(clock.dt, dt, 1e-9);
  EXPECT_EQ(clock.frame, frame);
}

// Every individual has its own clock. Each is numbered without a slip although some lie on the edge between two frames.
TEST(FrameClock, SeveralClockPhases) {
  std::vector<double> time;
  std::vector<std::size_t> first = {0};
  for (int track = 0; track < 20; ++track) {
    for (int k = 0; k < 100; ++k) time.push_back(0.1 * (k + track / 20.0 + 0.1 * uniform(time.size())));
    first.push_back(time.size());
  }
  const auto clock = fit_frame_clock(time, first);
  ASSERT_EQ(clock.problem, "");
  EXPECT_NEAR(clock.dt, 0.1, 1e-9);
  EXPECT_LE(clock.deviation, 0.06);
  EXPECT_GE(clock.deviation, 0.04);
  for (std::size_t track = 0; track < 20; ++track)
    for (std::size_t i = first[track] + 1; i < first[track + 1]; ++i)
      ASSERT_EQ(clock.frame[i], clock.frame[i - 1] + 1) << "track " << track;
}

TEST(FrameClock, EpochTimes) {
  const auto clock = fit({1441868400.0, 1441868401.0, 1441868402.0, 1441868404.0});
  EXPECT_EQ(clock.dt, 1);
  EXPECT_THAT(clock.frame, ElementsAre(1441868400, 1441868401, 1441868402, 1441868404));
}

TEST(FrameClock, NegativeTimes) { EXPECT_THAT(fit({-0.02, -0.01, 0, 0.01}).frame, ElementsAre(-2, -1, 0, 1)); }

// Nobody is seen twice, so that only the recording as a whole tells its rate.
TEST(FrameClock, IndividualsSeenOnce) {
  const auto clock = fit_frame_clock(std::vector<double>{0, 0.5, 1.5}, std::vector<std::size_t>{0, 1, 2, 3});
  EXPECT_EQ(clock.dt, 0.5);
  EXPECT_THAT(clock.frame, ElementsAre(0, 1, 3));
}

TEST(FrameClock, OneMoment) { EXPECT_EQ(fit({3, 3}).problem, "all rows have the same time"); }

TEST(FrameClock, RandomTimesHaveNoInterval) {
  std::vector<double> time = {0};
  for (std::uint64_t k = 1; k < 1000; ++k) time.push_back(time.back() - std::log(1 - uniform(k)));
  EXPECT_THAT(fit(time).problem, HasSubstr("the times have no constant interval"));
}

TEST(KnownFrames, LeastSquares) {
  const auto clock = fit_known_frames(std::vector<double>{10.0, 10.04, 10.08, 10.16}, std::vector<double>{100, 101, 102, 104});
  EXPECT_EQ(clock.problem, "");
  EXPECT_EQ(clock.dt, 0.04);
  EXPECT_NEAR(clock.t0, 6, 1e-9);
}

TEST(KnownFrames, Disagreement) {
  EXPECT_THAT(fit_known_frames(std::vector<double>{0, 5, 1, 9}, std::vector<double>{0, 1, 2, 3}).problem,
              HasSubstr("time and frame number disagree"));
  EXPECT_EQ(fit_known_frames(std::vector<double>{3, 2, 1}, std::vector<double>{0, 1, 2}).problem,
            "the time does not grow with the frame number");
}

}  // namespace
}  // namespace swarmfit
