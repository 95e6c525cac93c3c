// SPDX-License-Identifier: MIT
#include "fit/compare/across.h"

#include <gtest/gtest.h>

#include <cmath>

namespace swarmfit {
namespace {

Comparison compared(const std::string& path, const std::vector<std::pair<std::string, double>>& scores, double first_weight) {
  Comparison c;
  c.recording.data.path = path;
  c.ranking.weights[0] = first_weight;
  c.ranking.weights[1] = 1 - first_weight;
  int rank = 0;
  for (const auto& [name, score] : scores) {
    ModelFit r;
    r.model = name;
    r.standing.score = score;
    r.standing.rank = std::isfinite(score) ? ++rank : 0;
    c.models.push_back(r);
  }
  c.run.named = {"a", "b", "c"};
  return c;
}

TEST(Across, RanksScoresAndWeightsByHand) {
  const Across s = across(std::vector{compared("one", {{"b", 0.9}, {"a", 0.5}, {"c", 0.1}}, 0.2),
                                      compared("two", {{"a", 0.8}, {"b", 0.7}, {"c", 0.3}}, 0.6),
                                      compared("three", {{"b", 0.6}, {"c", 0.5}, {"a", 0.4}}, 0.4)});
  EXPECT_EQ(s.recordings, (std::vector<std::string>{"one", "two", "three"}));
  ASSERT_EQ(s.models.size(), 3u);
  EXPECT_EQ(s.models[0].model, "b");
  EXPECT_EQ(s.models[0].rank, (std::vector<int>{1, 2, 1}));
  EXPECT_NEAR(s.models[0].mean_rank, 4 / 3.0, 1e-15);
  EXPECT_NEAR(s.models[0].mean_score, 2.2 / 3, 1e-15);
  EXPECT_EQ(s.models[0].wins, 2);
  EXPECT_EQ(s.models[1].model, "a") << "equal mean ranks never happen here: 2 against 8/3";
  EXPECT_EQ(s.models[1].score, (std::vector<double>{0.5, 0.8, 0.4}));
  EXPECT_NEAR(s.mean_weight[0], 0.4, 1e-15);
  EXPECT_EQ(s.smallest_weight[0], 0.2);
  EXPECT_EQ(s.largest_weight[0], 0.6);
}

TEST(Across, UndefinedScoresAreLeftOutOfMeansAndComeLast) {
  const Across s = across(
      std::vector{compared("one", {{"a", 0.5}, {"b", 0.4}, {"c", NAN}}, 0.5), compared("two", {{"b", 0.5}, {"a", 0.4}, {"c", NAN}}, 0.5)});
  EXPECT_EQ(s.models[2].model, "c");
  EXPECT_TRUE(std::isnan(s.models[2].mean_rank));
  EXPECT_TRUE(std::isnan(s.models[2].mean_score));
  EXPECT_EQ(s.models[0].model, "a") << "equal ranks and scores: the order given";
}

// Leads of a over b .1, .2, .6: mean .3, standard error .1528; t(2) at 97.5 % is 4.3027, at 98.75 % 6.2053 (scipy 1.11, stats.t.ppf).
TEST(Across, LeadsArePairedWithinRecordingsAndShareTheLevel) {
  const std::vector<double> leads{.1, .2, .6, NAN};
  const MeanOverRecordings alone = mean_over_recordings(leads, 0.05);
  EXPECT_NEAR(alone.mean, 0.3, 1e-15);
  EXPECT_NEAR(alone.lower, 0.3 - 4.302653 * 0.1527525, 1e-6);
  EXPECT_NEAR(alone.upper, 0.3 + 4.302653 * 0.1527525, 1e-6);
  EXPECT_TRUE(std::isnan(mean_over_recordings(std::vector{.5}, 0.05).lower));
  EXPECT_TRUE(std::isnan(mean_over_recordings({}, 0.05).mean));

  const Across s =
      across(std::vector{compared("one", {{"a", .5}, {"b", .4}, {"c", .1}}, 0.5), compared("two", {{"a", .5}, {"b", .3}, {"c", NAN}}, 0.5),
                         compared("three", {{"a", .8}, {"b", .2}, {"c", .1}}, 0.5)});
  EXPECT_TRUE(std::isnan(s.models[0].lead.mean)) << "the first has none over itself";
  ASSERT_EQ(s.models[1].model, "b");
  EXPECT_NEAR(s.models[1].lead.mean, 0.3, 1e-15);
  EXPECT_NEAR(s.models[1].lead.lower, 0.3 - 6.205347 * 0.1527525, 1e-6) << "two models share the level";
  EXPECT_NEAR(s.models[2].lead.mean, (.4 + .7) / 2, 1e-15) << "where both are defined";
}

TEST(Across, NothingGivesNothing) { EXPECT_TRUE(across({}).models.empty()); }

}  // namespace
}  // namespace swarmfit
