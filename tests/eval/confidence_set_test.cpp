// SPDX-License-Identifier: MIT
#include "libeval/confidence_set.h"

#include <gmock/gmock.h>

#include <cmath>

#include "libtrack/rng.h"

namespace swarmfit {
namespace {

using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::Ge;
using testing::IsNan;
using testing::Le;

// Standard normal draws with these standard deviations, after what all models share.
ScoreDraws normal_draws(std::uint64_t seed, const std::vector<double>& scores, const std::vector<double>& sd, double shared = 0,
                        int rows = 200) {
  const Rng rng{seed};
  const auto models = static_cast<Eigen::Index>(scores.size());
  ScoreDraws out{Eigen::Map<const Eigen::VectorXd>(scores.data(), models), Eigen::MatrixXd(rows, models)};
  for (Eigen::Index b = 0; b < rows; ++b)
    for (Eigen::Index m = 0; m < models; ++m)
      out.draws(b, m) =
          7 +
          sd[static_cast<std::size_t>(m)] * rng.normal2(Stream::probe, static_cast<std::uint64_t>(b), static_cast<std::uint32_t>(m))[0] +
          shared * rng.normal2(Stream::probe, static_cast<std::uint64_t>(b), 99)[0];
  return out;
}

TEST(ConfidenceSet, TwoModelsByHand) {
  ScoreDraws all{Eigen::Vector2d(1, 0.2), Eigen::MatrixXd(9, 2)};
  // differences about their mean 0: -0.9, -0.7, -0.4, -0.1, 0, 0.1, 0.4, 0.7, 0.9; four are as far out as 0.8 or, of either sign, not
  const double differences[] = {-0.9, -0.7, -0.4, -0.1, 0, 0.1, 0.4, 0.7, 0.9};
  for (int b = 0; b < 9; ++b) all.draws.row(b) << 5 + differences[b], 5;
  EXPECT_THAT(confidence_set_p(all), ElementsAre(1, (1 + 2) / 10.0));  // -0.9 and 0.9
  EXPECT_THAT(confidence_groups(all, 0.2), ElementsAre(1, 1));
  EXPECT_THAT(confidence_groups(all, 0.3), ElementsAre(1, 2));
}

// The same by the definition: of all pairs, by recursion on the models that are left.
void by_definition(const ScoreDraws& all, std::vector<int> left, double before, std::vector<double>& p) {
  if (left.size() == 1) {
    p[static_cast<std::size_t>(left[0])] = 1;
    return;
  }
  const auto sd = [&](int i, int j) {
    const Eigen::ArrayXd d = all.draws.col(i) - all.draws.col(j);
    return std::sqrt((d - d.mean()).square().sum() / static_cast<double>(d.size() - 1));
  };
  double statistic = 0;
  int worst = -1;
  for (const int i : left)
    for (const int j : left)
      if (i != j && (all.scores(i) - all.scores(j)) / sd(i, j) > statistic)
        statistic = (all.scores(i) - all.scores(j)) / sd(i, j), worst = j;
  int beyond = 0;
  for (Eigen::Index b = 0; b < all.draws.rows(); ++b) {
    bool any = false;
    for (const int i : left)
      for (const int j : left) {
        if (i == j) continue;
        const double mean = (all.draws.col(i) - all.draws.col(j)).mean();
        any = any || std::abs(all.draws(b, i) - all.draws(b, j) - mean) / sd(i, j) >= statistic;
      }
    beyond += any;
  }
  const double own = std::max(before, (1.0 + beyond) / (1.0 + static_cast<double>(all.draws.rows())));
  p[static_cast<std::size_t>(worst)] = own;
  std::erase(left, worst);
  by_definition(all, left, own, p);
}

TEST(ConfidenceSet, AgreesWithTheDefinition) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const ScoreDraws all = normal_draws(seed, {0.5, 0.41, 0.44, -0.2, 0.1}, {0.1, 0.05, 0.2, 0.3, 0.01}, 0.5, 60);
    std::vector<double> expected(5);
    by_definition(all, {0, 1, 2, 3, 4}, 0, expected);
    EXPECT_THAT(confidence_set_p(all), testing::Pointwise(testing::DoubleNear(1e-12), expected)) << seed;
  }
}

TEST(ConfidenceSet, WhatAllModelsShareDoesNotHideADifference) {
  EXPECT_THAT(confidence_groups(normal_draws(1, {0, -1}, {0.1, 0.1}, 0), 0.05), ElementsAre(1, 2));
  EXPECT_THAT(confidence_groups(normal_draws(1, {0, -1}, {0.1, 0.1}, 20), 0.05), ElementsAre(1, 2));
}

TEST(ConfidenceSet, GroupsAreSetsOfWhatIsLeft) {
  EXPECT_THAT(confidence_groups(normal_draws(1, {3, 1, 2.9, 0.95, 0}, std::vector<double>(5, 0.1)), 0.05), ElementsAre(1, 2, 1, 2, 3));
}

TEST(ConfidenceSet, OrderShiftAndScaleDoNotMatter) {
  const ScoreDraws all = normal_draws(3, {0.5, 0.41, 0.44, 0.2}, {0.1, 0.1, 0.2, 0.2});
  const auto p = confidence_set_p(all);
  Eigen::PermutationMatrix<4> reverse(Eigen::Vector4i(3, 2, 1, 0));
  EXPECT_THAT(confidence_set_p({reverse * all.scores, all.draws * reverse}), ElementsAre(p[3], p[2], p[1], p[0]));
  EXPECT_THAT(confidence_set_p({8 * all.scores, ((8 * all.draws).array() + 256).matrix()}),
              testing::Pointwise(testing::DoubleNear(1e-12), p));
}

TEST(ConfidenceSet, WithoutNumbersThereIsNoAnswer) {
  ScoreDraws all = normal_draws(1, {1, NAN, 0.9}, {0.1, 0.1, 0.1});
  auto p = confidence_set_p(all);
  EXPECT_THAT(p[1], IsNan());
  EXPECT_THAT(p[0], 1);
  EXPECT_THAT(confidence_groups(all, 0.05), ElementsAre(1, 0, 1));
  all.draws.col(0).tail(199).setConstant(NAN);  // one draw is left
  EXPECT_THAT(confidence_set_p(all), Each(IsNan()));
  EXPECT_THAT(confidence_groups(all, 0.05), Each(0));
  EXPECT_THAT(confidence_groups({Eigen::VectorXd(0), Eigen::MatrixXd(5, 0)}, 0.05), testing::IsEmpty());
  all.draws(5, 0) = INFINITY;
  EXPECT_THAT(confidence_set_p(all), Each(IsNan()));
}

TEST(ConfidenceSet, ModelsThatNeverDifferAreEqualUnlessTheirScoresDo) {
  ScoreDraws all = normal_draws(1, {1, 1}, {0.1, 0.1});
  all.draws.col(1) = all.draws.col(0);
  EXPECT_THAT(confidence_set_p(all), ElementsAre(1, 1));
  all.scores(1) = 0.999;
  EXPECT_THAT(confidence_groups(all, 0.05), ElementsAre(1, 2));
}

// Of equal models, all are in the set in 95 % of 400 comparisons; the 99 % band of the binomial is 368 to 391.
TEST(ConfidenceSet, KeepsItsLevelOverAllModels) {
  int all_in = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    ScoreDraws all = normal_draws(seed, {0, 0, 0, 0, 0}, {0.1, 0.2, 0.1, 0.3, 0.1}, 1, 199);
    all.scores = all.draws.row(0).transpose();  // one more draw of the same law
    all.draws = all.draws.bottomRows(198).eval();
    const auto groups = confidence_groups(all, 0.05);
    all_in += std::count(groups.begin(), groups.end(), 1) == 5;
  }
  EXPECT_THAT(all_in, AllOf(Ge(368), Le(391)));
}

}  // namespace
}  // namespace swarmfit
