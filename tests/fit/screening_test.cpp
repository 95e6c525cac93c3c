// SPDX-License-Identifier: MIT
#include "fit/optimise/screening.h"

#include <gtest/gtest.h>

#include <limits>

namespace swarmfit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Screening, AQuarterOfTheReplicatesComesFirst) {
  EXPECT_EQ(screening_replicates(1), 1u);
  EXPECT_EQ(screening_replicates(2), 1u);
  EXPECT_EQ(screening_replicates(4), 1u);
  EXPECT_EQ(screening_replicates(5), 2u);
  EXPECT_EQ(screening_replicates(12), 3u);
}

TEST(Screening, NothingIsGivenUpBeforeEnoughIsKnown) {
  Screening screening;
  for (int pair = 0; pair < 9; ++pair) screening.learn(1, 2);
  EXPECT_TRUE(screening.worth(kInfinity));
  screening.learn(1, 2);
  EXPECT_FALSE(screening.worth(kInfinity));
}

TEST(Screening, TheMarginIsAShareOfWhatTheRestChanged) {
  Screening screening;
  for (int pair = 0; pair < 10; ++pair) screening.learn(3, pair % 2 ? 5 : 1);  // root mean square 2
  EXPECT_TRUE(screening.worth(0.499));
  EXPECT_FALSE(screening.worth(0.501));
  EXPECT_TRUE(screening.worth(-kInfinity));
}

TEST(Screening, OldPairsAreForgottenAndFailuresTeachNothing) {
  Screening screening;
  for (int pair = 0; pair < 50; ++pair) screening.learn(0, 100);
  for (int pair = 0; pair < 100; ++pair) screening.learn(0, 1);
  screening.learn(kInfinity, kInfinity);
  screening.learn(0, kInfinity);
  EXPECT_TRUE(screening.worth(0.249));
  EXPECT_FALSE(screening.worth(0.251));
}

TEST(Screening, WithoutNoiseOnlyTheCheaperGoOn) {
  Screening screening;
  for (int pair = 0; pair < 10; ++pair) screening.learn(1, 1);
  EXPECT_TRUE(screening.worth(0));
  EXPECT_FALSE(screening.worth(1e-9));
}

}  // namespace
}  // namespace swarmfit
