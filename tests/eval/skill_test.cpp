// SPDX-License-Identifier: MIT
#include "libeval/skill.h"

#include <gmock/gmock.h>

#include <bit>

#include "libeval/distance.h"
#include "libeval/surrogate.h"
#include "tests/eval/build.h"

namespace swarmfit {
namespace {

using test::tracks_of;
using testing::Each;
using testing::IsNan;

Tracks trapped(std::uint64_t seed, double noise = 400) { return tracks_of(test::trapped(seed, 8, 160, {}, noise), {}); }

TEST(HalfDistance, BlocksAreTheRecordingInPieces) {
  const Tracks tracks = trapped(1);
  const HalfDistance half(tracks);
  const auto pooled = HalfDistance::pooled(half.recording());
  EXPECT_EQ(pooled[kDistance].samples, 8u * 160);     // needs one frame
  EXPECT_EQ(pooled[kSpeed].samples, 8u * (160 - 8));  // two: one lost per block
  EXPECT_EQ(pooled[kJerk].samples, 8u * (160 - 24));  // four
  for (const auto& block : half.recording()) EXPECT_EQ(block[kDistance].samples, 8u * 20);
}

// The same by adding up raw samples of cut recordings.
TEST(HalfDistance, AgreesWithBruteForce) {
  const auto real_rows = test::trapped(1, 8, 160, {}), other_rows = test::trapped(2, 8, 160, {}, 600);
  const HalfDistance half(tracks_of(real_rows));
  const auto distance = half.to(half.blocks(tracks_of(other_rows)));
  const Target target(metric_samples(tracks_of(real_rows)), Binning::standard(Normalisation::reference));
  const auto half_of = [&](const std::vector<test::Row>& rows, unsigned mask, std::size_t metric) {
    Histogram sum;
    for (std::int64_t b = 0; b < 8; ++b) {
      if (!(mask >> b & 1U)) continue;
      std::vector<test::Row> part;
      for (const auto& row : rows)
        if (row.frame / 20 == b) part.push_back(row);
      sum.add(target.distributions(metric_samples(tracks_of(part)))[metric].histogram);
    }
    return sum;
  };
  double sum = 0;
  for (unsigned mask = 0; mask < 256; ++mask)
    if (std::popcount(mask) == 4) sum += total_variation(half_of(real_rows, mask, kSpeed), half_of(other_rows, 255 & ~mask, kSpeed));
  EXPECT_NEAR(distance[kSpeed], sum / 70, 1e-12);
}

// Another run of the same process is as far from the recording as the recording from itself: eight such runs scatter about the floor.
TEST(HalfDistance, SameProcessIsAtTheFloorAnotherIsNot) {
  const HalfDistance half(trapped(1));
  PerColumn<Moments> same;
  for (std::uint64_t seed = 2; seed < 10; ++seed) {
    const auto d = half.to(half.blocks(trapped(seed)));
    for (std::size_t m = 0; m < kMetrics; ++m) same[m].add(d[m]);
  }
  const auto other = half.to(half.blocks(trapped(20, 900)));
  for (const auto m : {kSpeed, kAcceleration, kJerk}) {
    EXPECT_NEAR(same[m].mean, half.floor()[m], 0.25 * half.floor()[m]) << m;
    EXPECT_GT(other[m], 2 * half.floor()[m]) << m;
    EXPECT_GT(half.floor_sd()[m], 0);
  }
}

TEST(HalfDistance, ItselfIsAtTheFloorExactly) {
  const HalfDistance half(trapped(1));
  EXPECT_EQ(half.to(half.recording()), half.floor());
}

TEST(HalfDistance, OnlyWantedMetricsAndNothingOnShortRecordings) {
  const Tracks tracks = trapped(1);
  const HalfDistance half(tracks);
  PerColumn<bool> wanted{};
  wanted[kDistance] = true;
  const auto d = half.to(half.recording(), wanted);
  EXPECT_EQ(d[kDistance], half.floor()[kDistance]);
  EXPECT_THAT(d[kSpeed], IsNan());
  const HalfDistance brief(tracks_of(test::trapped(1, 4, 31, {})));
  EXPECT_THAT(brief.floor(), Each(IsNan()));
  EXPECT_THAT(brief.to(brief.blocks(tracks)), Each(IsNan()));
}

// The mean over columns has the mean of their floors, and scatters less than they do one by one but not as if they were independent.
TEST(HalfDistance, FloorOverSeveralColumns) {
  const HalfDistance half(trapped(1));
  PerColumn<bool> one{}, some{};
  one[kSpeed] = true;
  some[kSpeed] = some[kAcceleration] = some[kDistance] = true;
  EXPECT_NEAR(half.floor_over(one).mean, half.floor()[kSpeed], 1e-12);
  EXPECT_NEAR(half.floor_over(one).sd(), half.floor_sd()[kSpeed], 1e-12);
  const Moments all = half.floor_over(some);
  EXPECT_EQ(all.count, 70u);
  EXPECT_NEAR(all.mean, mean_used(half.floor(), some), 1e-12);
  EXPECT_LE(all.sd(), mean_used(half.floor_sd(), some));
  EXPECT_GT(all.sd(), 0);
  EXPECT_EQ(half.floor_over(PerColumn<bool>(kMetrics)).count, 0u);
  EXPECT_EQ(HalfDistance(tracks_of(test::trapped(1, 4, 31, {}))).floor_over(one).count, 0u);
}

TEST(Skill, OneAtTheFloorZeroAtTheNullAndLinearBetween) {
  const PerColumn<double> floor{.1, .2, .3, 9, 9, 9, 9}, null{.5, .2, .8, 9, 9, 9, 9};
  const PerColumn<bool> used{true, true, true};
  const SkillScale scale = skill_scale(floor, null, used);
  EXPECT_DOUBLE_EQ(scale.floor, 0.2);
  EXPECT_DOUBLE_EQ(scale.null, 0.5);
  EXPECT_DOUBLE_EQ(scale.skill(0.2), 1);
  EXPECT_DOUBLE_EQ(scale.skill(0.5), 0);
  EXPECT_NEAR(scale.skill(0.35), 0.5, 1e-12);
  EXPECT_LT(scale.skill(0.6), 0);
  EXPECT_NEAR(scale.slope(), 1 / 0.3, 1e-12);
}

TEST(Skill, UndefinedWithoutScale) {
  EXPECT_THAT(skill_scale({.1}, {.1}, {true}).skill(0.1), IsNan());
  EXPECT_THAT(skill_scale({.2}, {.1}, {true}).slope(), IsNan());
  EXPECT_THAT(skill_scale({.1}, {.3}, {}).skill(0.1), IsNan());
  EXPECT_THAT(mean_used({1, NAN}, {true, true}), IsNan());
}

// On smooth orbits the walker is recognised at once, by everything but its speeds, which are the recording's.
TEST(Skill, ShuffledWalkerIsFarInTurningAndNearInSpeed) {
  const Tracks tracks =
      tracks_of(test::rows_of(10, 160, 0.05, [](std::uint32_t i, double t) { return test::orbit(3, 50, 0.5, i, t); }), {.dt = 0.05});
  const HalfDistance half(tracks);
  const auto d = half.to(half.blocks(shuffled_walker(tracks, {1})));
  for (const auto m : {kAcceleration, kAngularVelocity, kAngularAcceleration, kJerk}) EXPECT_GT(d[m], half.floor()[m] + 0.3) << m;
  EXPECT_NEAR(d[kSpeed], half.floor()[kSpeed], 0.02);
}

}  // namespace
}  // namespace swarmfit
