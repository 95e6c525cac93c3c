// SPDX-License-Identifier: MIT
#include "fit/compare/sensitivity.h"

#include <gtest/gtest.h>

#include <cmath>

namespace swarmfit {
namespace {

const PerColumn<double> kWeights = {0.5, 0.3, 0.2, 0, 0, 0, 0};
const Energies kOne = {0, 1, 0.5, 0.1, 0.1, 0.1, 0.1}, kOther = {1, 0, 0.5, 0.2, 0.2, 0.2, 0.2};

TEST(Sensitivity, ByHand) {
  const auto s = sensitivities({kOne, kOther}, kWeights);
  const Sensitivity &a = s[0], &b = s[1];
  EXPECT_NEAR(a.without[kSpeed], 1 - (0.3 * 1 + 0.2 * 0.5) / 0.5, 1e-15);
  EXPECT_NEAR(b.without[kSpeed], 1 - 0.2 * 0.5 / 0.5, 1e-15);
  EXPECT_NEAR(a.doubled[kSpeed], 1 - (0.3 * 1 + 0.2 * 0.5) / 1.5, 1e-15);
  EXPECT_NEAR(b.doubled[kSpeed], 1 - (1.0 * 1 + 0.2 * 0.5) / 1.5, 1e-15);
  EXPECT_EQ(a.rank_without[kSpeed], 2);
  EXPECT_EQ(b.rank_without[kSpeed], 1);
  EXPECT_EQ(a.rank_without[kAcceleration], 1);
}

TEST(Sensitivity, UndefinedWhereAMetricHasNoWeight) {
  const auto s = sensitivities({kOne, kOther}, kWeights);
  EXPECT_TRUE(std::isnan(s[0].without[kJerk]));
  EXPECT_TRUE(std::isnan(s[0].doubled[kJerk]));
  EXPECT_EQ(s[0].rank_without[kJerk], 0);
}

TEST(Sensitivity, NothingIsLeftWithoutTheOnlyMetric) {
  const auto s = sensitivities({kOne, kOther}, {1, 0, 0, 0, 0, 0, 0});
  EXPECT_TRUE(std::isnan(s[0].without[kSpeed]));
  EXPECT_EQ(s[0].rank_without[kSpeed], 0);
  EXPECT_EQ(s[0].doubled[kSpeed], 1);
}

TEST(Sensitivity, EqualScoresShareARank) {
  const auto s = sensitivities({kOne, kOne}, kWeights);
  EXPECT_EQ(s[0].rank_without[kSpeed], 1);
  EXPECT_EQ(s[1].rank_without[kSpeed], 1);
}

}  // namespace
}  // namespace swarmfit
