// SPDX-License-Identifier: MIT
#include "libeval/leave_one_out.h"

#include <gmock/gmock.h>

namespace swarmfit {
namespace {

using testing::ElementsAre;

// The table of the entropy test in score_test.cpp with a fourth row; every entry recomputed from a table typed without that row.
TEST(LeaveOneOut, EqualsTheComparisonOfTheOthers) {
  Eigen::MatrixXd x(4, 3);
  x << .2, .9, .5, .8, .1, .5, .5, .4, .5, .35, .2, .5;
  const auto all = leave_one_out(x);
  ASSERT_EQ(all.size(), 4u);
  Eigen::MatrixXd rest(3, 3);
  rest << .2, .9, .5, .5, .4, .5, .35, .2, .5;
  const Weighting w = entropy_weights(rest);
  EXPECT_EQ(all[1].dropped, 1);
  EXPECT_EQ(all[1].weighting.weights, w.weights);
  EXPECT_EQ(all[1].scores[0], score(rest.row(0).transpose(), w));
  EXPECT_EQ(all[1].scores[3], score(rest.row(2).transpose(), w));
  EXPECT_THAT(all[1].scores[1], testing::IsNan());
}

// By hand: two metrics, rows A (0, 4), B (1, 0), C (0.9, 10), D (10, 1). Without D the first metric ranges over [0, 1] and A is far
// better there; with D it ranges over [0, 10] and A and B are nearly equal.
TEST(LeaveOneOut, AModelCanDecideBetweenTwoOthers) {
  Eigen::MatrixXd x(4, 2);
  x << 0, 4, 1, 0, 0.9, 10, 10, 1;
  const Weighting full = entropy_weights(x);
  ASSERT_GT(score(x.row(1).transpose(), full), score(x.row(0).transpose(), full));
  const auto without = leave_one_out(x)[3];
  EXPECT_THAT(without.order, ElementsAre(0, 1, 2));
}

TEST(LeaveOneOut, NothingBelowThreeModelsAndUndefinedComesLast) {
  EXPECT_TRUE(leave_one_out(Eigen::MatrixXd::Ones(2, 3)).empty());
  Eigen::MatrixXd x(3, 1);
  x << 2, 1, 3;
  const auto none_used = leave_one_out(x, {false});
  EXPECT_THAT(none_used[0].order, ElementsAre(1, 2));
  EXPECT_THAT(none_used[0].scores, testing::Each(testing::IsNan()));
}

}  // namespace
}  // namespace swarmfit
