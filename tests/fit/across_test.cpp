// SPDX-License-Identifier: MIT
#include "fit/across.h"

#include <gtest/gtest.h>

#include <cmath>

namespace swarmfit {
namespace {

Comparison compared(const std::string& path, const std::vector<std::pair<std::string, double>>& scores, double first_weight) {
  Comparison c;
  c.data.path = path;
  c.weights[0] = first_weight;
  c.weights[1] = 1 - first_weight;
  int rank = 0;
  for (const auto& [name, score] : scores) {
    FitResult r;
    r.model = name;
    r.score = score;
    r.rank = std::isfinite(score) ? ++rank : 0;
    c.models.push_back(r);
  }
  c.named = {"a", "b", "c"};
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

TEST(Across, NothingGivesNothing) { EXPECT_TRUE(across({}).models.empty()); }

}  // namespace
}  // namespace swarmfit
