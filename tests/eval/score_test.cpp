// SPDX-License-Identifier: MIT
#include "libeval/score.h"

#include <gmock/gmock.h>

#include <cmath>

namespace swarmfit {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::Each;
using testing::ElementsAre;
const double kNaN = std::nan("");

testing::Matcher<double> rounds_to(double x) { return testing::DoubleNear(x, 5.1e-7); }
testing::Matcher<double> is(double x) { return testing::DoubleNear(x, 1e-14); }

MatrixXd example() {
  MatrixXd x(4, 3);
  x << .2, .9, .5, .8, .1, .5, .5, .4, .5, .35, .2, .5;
  return x;
}

// Numbers worked out by hand and checked by an independent program (tests/reference/evaluate.py weigh).
// Two columns of equal relative differences; of the second the recording can tell only four times what there is.
TEST(EntropyWeights, DifferencesBelowTheResolutionDoNotCountInFull) {
  MatrixXd x(3, 2);
  x << 1, 1, 2, 2, 3, 3;
  const Weighting plain = entropy_weights(x), floored = entropy_weights(x, {}, {0, 8});
  EXPECT_EQ(plain.p2, (std::vector<double>{2, 2}));
  EXPECT_EQ(floored.p2, (std::vector<double>{2, 8}));
  EXPECT_EQ(plain.weights[1], 0.5);
  const auto by_hand = [](const std::vector<double>& r) {
    double total = 0, sum = 0;
    for (const double v : r) total += v;
    for (const double v : r) sum += v > 0 ? v / total * std::log(v / total) : 0;
    return 1 + sum / std::log(3);
  };
  const double first = by_hand({1, 0.5, 0}), second = by_hand({1, 0.875, 0.75});
  EXPECT_NEAR(floored.weights[1], second / (first + second), 1e-14);
  EXPECT_LT(floored.weights[1], 0.02);
  EXPECT_EQ(entropy_weights(x, {}, {1, 1}).weights, plain.weights) << "a range beyond the resolution stays";
  EXPECT_EQ(entropy_weights(MatrixXd::Ones(3, 2), {}, {1, 1}).p2[0], 0) << "no range is no range";
  EXPECT_THROW(entropy_weights(x, {}, {1}), std::invalid_argument);
}

TEST(EntropyWeights, WorkedExample) {
  const Weighting w = entropy_weights(example());
  EXPECT_THAT(w.entropy, ElementsAre(rounds_to(.765247), rounds_to(.779436), is(1)));
  EXPECT_THAT(w.weights, ElementsAre(rounds_to(.515582), rounds_to(.484418), is(0)));
  EXPECT_THAT(w.p1, ElementsAre(is(.2), is(.1), is(.5)));
  EXPECT_THAT(w.p2, ElementsAre(is(.6), is(.8), is(0)));
  const std::array<double, 4> scores = {.515582, .484418, .560552, .810552};
  for (int i = 0; i < 4; ++i) EXPECT_THAT(score(example().row(i).transpose(), w), rounds_to(scores[static_cast<std::size_t>(i)]));
}

TEST(EntropyWeights, SumToOneAndDoNotDependOnUnitsOrOrder) {
  const MatrixXd x = example();
  MatrixXd y(4, 3);
  y.col(0) = x.col(1).reverse() * 1000;
  y.col(1) = x.col(0).reverse().array() + 7;
  y.col(2) = x.col(2);
  const Weighting a = entropy_weights(x), b = entropy_weights(y);
  EXPECT_NEAR(a.weights[0] + a.weights[1] + a.weights[2], 1, 1e-15);
  EXPECT_NEAR(a.weights[0], b.weights[1], 1e-14);
  EXPECT_NEAR(a.weights[1], b.weights[0], 1e-14);
}

TEST(EntropyWeights, OneModelLeavesWeightsEqual) {
  const Weighting w = entropy_weights(example().topRows(1));
  EXPECT_THAT(w.weights, Each(is(1.0 / 3)));
  EXPECT_THAT(w.entropy, Each(testing::IsNan()));
  EXPECT_EQ(score(example().row(0).transpose(), w), 1);  // all p2 = 0
}

TEST(EntropyWeights, TwoModelsWeighColumnsWithRangeEqually) {
  const Weighting w = entropy_weights(example().topRows(2));
  EXPECT_THAT(w.entropy, ElementsAre(is(0), is(0), is(1)));
  EXPECT_THAT(w.weights, ElementsAre(is(.5), is(.5), is(0)));
}

TEST(EntropyWeights, NoColumnHasRange) {
  const Weighting w = entropy_weights(MatrixXd::Constant(3, 7, 0.3));
  EXPECT_THAT(w.weights, Each(is(1.0 / 7)));
  EXPECT_THAT(w.entropy, Each(is(1)));
  EXPECT_EQ(score(VectorXd::Constant(7, 0.3), w), 1);
}

// One model stands out: r = (0, 1, ..., 1), the least a column with range can weigh.
TEST(EntropyWeights, FloorOfAColumnWithRange) {
  for (const int m : {3, 4, 5}) {
    MatrixXd x = MatrixXd::Zero(m, 1);
    x(0, 0) = 1;
    EXPECT_NEAR(1 - entropy_weights(x).entropy[0], 1 - std::log(m - 1) / std::log(m), 1e-14);
  }
}

TEST(EntropyWeights, ColumnsWithNaNAndMaskedColumnsGetNothing) {
  MatrixXd x = example();
  x(2, 1) = kNaN;
  const Weighting w = entropy_weights(x);
  EXPECT_THAT(w.weights, ElementsAre(is(1), is(0), is(0)));
  EXPECT_TRUE(std::isnan(w.entropy[1]));
  EXPECT_NEAR(score(x.row(2).transpose(), w), 0.5, 1e-15);  // the NaN carries no weight

  const Weighting masked = entropy_weights(example(), {false, true, true});
  EXPECT_THAT(masked.weights, ElementsAre(is(0), is(1), is(0)));
  EXPECT_THAT(masked.entropy[0], rounds_to(.765247));  // shown, not hidden

  const Weighting flat = entropy_weights(MatrixXd::Ones(3, 3), {true, false, true});
  EXPECT_THAT(flat.weights, ElementsAre(is(.5), is(0), is(.5)));
}

TEST(EntropyWeights, NothingUsable) {
  const Weighting w = entropy_weights(MatrixXd::Constant(2, 2, kNaN));
  EXPECT_THAT(w.weights, Each(0));
  EXPECT_TRUE(std::isnan(score(VectorXd::Zero(2), w)));
  EXPECT_THROW(entropy_weights(MatrixXd(0, 7)), std::invalid_argument);
  EXPECT_THROW(entropy_weights(MatrixXd(3, 0)), std::invalid_argument);
  EXPECT_THROW(entropy_weights(example(), {true}), std::invalid_argument);
}

TEST(Score, InitialWeighting) {
  const Weighting w = initial_weighting({true, false, true, true, true}, 20);
  EXPECT_THAT(w.weights, ElementsAre(is(.25), 0, is(.25), is(.25), is(.25)));
  EXPECT_EQ(score(VectorXd::Zero(5), w), 1);
  VectorXd x(5);
  x << 20, kNaN, 20, 20, 20;
  EXPECT_NEAR(score(x, w), 0, 1e-15);
  x << 10, kNaN, 0, 0, 0;
  EXPECT_NEAR(score(x, w), 0.875, 1e-15);
}

TEST(Score, MayLeaveTheUnitIntervalForOtherModelsAndIsNaNWithoutAWeighedEnergy) {
  const Weighting w = entropy_weights(example());
  EXPECT_LT(score(VectorXd::Constant(3, 5.0), w), 0);
  EXPECT_GT(score(VectorXd::Zero(3), w), 1);
  VectorXd x = VectorXd::Zero(3);
  x[0] = kNaN;
  EXPECT_TRUE(std::isnan(score(x, w)));
  EXPECT_THROW(score(VectorXd::Zero(2), w), std::invalid_argument);
}

// Ren et al. 2016, supplement: weights of v, a, omega, alpha, mu, d, eta by number of models compared. With m models a column that is not
// degenerate has 1 - e of at least 1 - ln(m - 1) / ln m and at most 1, which bounds every weight.
struct Published {
  const char* table;
  int models;
  std::array<double, 7> weights;
};
const std::array<Published, 12> kPublished{{{"S1", 4, {.1219, .1397, .1649, .1527, .1269, .1739, .1200}},
                                            {"S2", 4, {.1270, .1381, .1541, .1739, .1405, .1396, .1268}},
                                            {"S3", 4, {.1467, .1562, .1256, .1433, .1799, .1260, .1223}},
                                            {"S4", 4, {.1288, .1499, .1544, .1503, .1561, .1293, .1312}},
                                            {"S11", 3, {.1328, .1345, .1346, .1327, .1543, .1346, .1765}},
                                            {"S12", 3, {.1285, .1640, .1330, .1404, .1432, .1527, .1382}},
                                            {"S13", 3, {.1305, .1939, .1313, .1339, .1401, .1307, .1396}},
                                            {"S14", 3, {.1328, .1341, .1327, .1669, .1400, .1447, .1487}},
                                            {"S17", 5, {.1184, .1219, .1700, .1524, .1348, .1670, .1354}},
                                            {"S18", 5, {.1345, .1669, .1319, .1261, .1405, .1547, .1454}},
                                            {"S19", 5, {.1278, .1649, .1222, .1207, .1741, .1444, .1459}},
                                            {"S20", 5, {.1257, .1461, .1246, .1311, .1577, .1565, .1583}}}};

TEST(EntropyWeights, PublishedTablesAreWhatTheFormulaCanGive) {
  for (const auto& [table, models, weights] : kPublished) {
    SCOPED_TRACE(table);
    const double least = 1 - std::log(models - 1.0) / std::log(models);
    double sum = 0;
    for (const double w : weights) {
      sum += w;
      EXPECT_GE(w, least / (least + 6));
      EXPECT_LE(w, 1 / (1 + 6 * least));
    }
    EXPECT_NEAR(sum, 1, 3e-4) << "seven numbers rounded to four decimals";
  }
}

}  // namespace
}  // namespace swarmfit
