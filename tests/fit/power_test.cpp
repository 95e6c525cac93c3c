// SPDX-License-Identifier: MIT
#include "fit/study/power.h"

#include <gmock/gmock.h>

#include <cmath>

#include "libtrack/error.h"
#include "tests/fit/planted.h"

namespace swarmfit {
namespace {

using testing::ElementsAre;

RecoveryCase one(std::size_t planted, std::vector<std::string> order, std::vector<double> scores, std::vector<int> group) {
  return {planted, 1, {}, std::move(order), std::move(scores), {}, std::move(group), {}, 0};
}

// Leads 0.3, 0.1 and -0.1: mean 0.1, sd 0.2; ahead twice, apart once. (1.6449 * 0.2 / 0.1)² = 10.8.
TEST(PowerPairs, ByHand) {
  Recovery r;
  r.planted = r.compared = {"a", "b"};
  r.cases = {one(0, {"a", "b"}, {0.9, 0.6}, {1, 2}), one(0, {"a", "b"}, {0.9, 0.8}, {1, 1}), one(0, {"b", "a"}, {0.9, 0.8}, {1, 1}),
             one(1, {"a", "b"}, {0.9, 0.5}, {1, 2}), one(1, {"a", "b"}, {0.9, 0.6}, {1, 2})};
  const auto pairs = power_pairs(r);
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[0].planted, 0u);
  EXPECT_EQ(pairs[0].rival, 1u);
  EXPECT_EQ(pairs[0].recordings, 3);
  EXPECT_EQ(pairs[0].first, 2);
  EXPECT_EQ(pairs[0].told_apart, 1);
  EXPECT_NEAR(pairs[0].lead, 0.1, 1e-12);
  EXPECT_NEAR(pairs[0].lead_sd, 0.2, 1e-12);
  EXPECT_NEAR(pairs[0].factor, std::pow(1.6449 * 2, 2), 1e-9);
  EXPECT_EQ(pairs[1].first, 0);
  EXPECT_TRUE(std::isinf(pairs[1].factor));
}

TEST(PowerPairs, AClearLeadNeedsNoLongerRecordingAndOneRecordingTellsNothingOfLongerOnes) {
  Recovery r;
  r.planted = r.compared = {"a", "b"};
  r.cases = {one(0, {"a", "b"}, {0.9, 0.1}, {1, 2}), one(0, {"a", "b"}, {0.9, 0.2}, {1, 2}), one(1, {"b", "a"}, {0.9, 0.5}, {1, 2})};
  EXPECT_EQ(power_pairs(r)[0].factor, 1);
  EXPECT_TRUE(std::isnan(power_pairs(r)[1].factor));
  EXPECT_EQ(power_pairs(r)[1].told_apart, 1);
}

PowerOptions tiny() {
  PowerOptions o;
  o.compare.models = {parse_model("brownian"), parse_model("boids")};
  o.compare.budget = {"tiny", {8, 4, 1}, {4, 2, 2}, 2, 2, 2};
  o.compare.bootstrap_recordings = 9;
  o.seeds = 2;
  return o;
}

TEST(Power, PlantsWhatWasFitted) {
  const Tracks recording = test::planted_swarm(3, 0, 0.01);
  std::vector<std::size_t> told;
  const Power p = power(recording, tiny(), [&](std::size_t done, std::size_t all) {
    told.push_back(done);
    EXPECT_EQ(all, 5u);
  });
  EXPECT_THAT(told, ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(p.recovery.planted, ElementsAre("brownian", "boids"));
  ASSERT_EQ(p.recovery.cases.size(), 4u);
  for (const ModelFit& fit : p.fitted.models) {
    const std::size_t m = fit.model == "brownian" ? 0 : 1;
    EXPECT_EQ(p.recovery.parameters[m], parameter_values(parse_model(fit.model), fit));
  }
  // brownian and boids are as different as models are: even this search finds who made a recording
  EXPECT_EQ(p.recovery.confusion[0][0], 2);
  EXPECT_EQ(p.recovery.confusion[1][1], 2);
  ASSERT_EQ(p.pairs.size(), 2u);
  EXPECT_EQ(p.pairs[0].first, 2);
}

TEST(Power, CanBeInterrupted) {
  const swarmfit::Threads stopped([] { return true; });
  EXPECT_THROW(power(test::planted_swarm(3), tiny(), {}, {{}, {&stopped}}), Interrupted);
}

}  // namespace
}  // namespace swarmfit
