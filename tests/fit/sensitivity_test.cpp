// SPDX-License-Identifier: MIT
#include "fit/compare/sensitivity.h"

#include <gtest/gtest.h>

#include <cmath>

namespace swarmfit {
namespace {

Comparison two_models() {
  Comparison c;
  c.weights = {0.5, 0.3, 0.2, 0, 0, 0, 0};
  c.models.resize(2);
  c.models[0].energies = {0, 1, 0.5, 0.1, 0.1, 0.1, 0.1};
  c.models[1].energies = {1, 0, 0.5, 0.2, 0.2, 0.2, 0.2};
  return c;
}

TEST(Sensitivity, ByHand) {
  Comparison c = two_models();
  fill_sensitivity(c);
  const Sensitivity &a = c.models[0].sensitivity, &b = c.models[1].sensitivity;
  EXPECT_NEAR(a.without[kSpeed], 1 - (0.3 * 1 + 0.2 * 0.5) / 0.5, 1e-15);
  EXPECT_NEAR(b.without[kSpeed], 1 - 0.2 * 0.5 / 0.5, 1e-15);
  EXPECT_NEAR(a.doubled[kSpeed], 1 - (0.3 * 1 + 0.2 * 0.5) / 1.5, 1e-15);
  EXPECT_NEAR(b.doubled[kSpeed], 1 - (1.0 * 1 + 0.2 * 0.5) / 1.5, 1e-15);
  EXPECT_EQ(a.rank_without[kSpeed], 2);
  EXPECT_EQ(b.rank_without[kSpeed], 1);
  EXPECT_EQ(a.rank_without[kAcceleration], 1);
}

TEST(Sensitivity, UndefinedWhereAMetricHasNoWeight) {
  Comparison c = two_models();
  fill_sensitivity(c);
  EXPECT_TRUE(std::isnan(c.models[0].sensitivity.without[kJerk]));
  EXPECT_TRUE(std::isnan(c.models[0].sensitivity.doubled[kJerk]));
  EXPECT_EQ(c.models[0].sensitivity.rank_without[kJerk], 0);
}

TEST(Sensitivity, NothingIsLeftWithoutTheOnlyMetric) {
  Comparison c = two_models();
  c.weights = {1, 0, 0, 0, 0, 0, 0};
  fill_sensitivity(c);
  EXPECT_TRUE(std::isnan(c.models[0].sensitivity.without[kSpeed]));
  EXPECT_EQ(c.models[0].sensitivity.rank_without[kSpeed], 0);
  EXPECT_EQ(c.models[0].sensitivity.doubled[kSpeed], 1);
}

TEST(Sensitivity, EqualScoresShareARank) {
  Comparison c = two_models();
  c.models[1].energies = c.models[0].energies;
  fill_sensitivity(c);
  EXPECT_EQ(c.models[0].sensitivity.rank_without[kSpeed], 1);
  EXPECT_EQ(c.models[1].sensitivity.rank_without[kSpeed], 1);
}

}  // namespace
}  // namespace swarmfit
