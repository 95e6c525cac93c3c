// SPDX-License-Identifier: MIT
#include "fit/infer/ridge.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "libtrack/rng.h"

namespace swarmfit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd normals(Index rows, Index columns, std::uint64_t seed) {
  MatrixXd m(rows, columns);
  for (Index i = 0; i < rows; ++i)
    for (Index j = 0; j < columns; ++j)
      m(i, j) = Rng{seed}.normal2(Stream::probe, static_cast<std::uint64_t>(i), static_cast<std::uint32_t>(j))[0];
  return m;
}

MatrixXd chosen_rows(const MatrixXd& m, const std::vector<Index>& rows) {
  MatrixXd out(static_cast<Index>(rows.size()), m.cols());
  for (Index i = 0; i < out.rows(); ++i) out.row(i) = m.row(rows[static_cast<std::size_t>(i)]);
  return out;
}

// Ridge regression by the augmented system: penalty as pseudo-observations, the intercept free (Marquardt 1970).
VectorXd by_augmentation(const MatrixXd& x, const VectorXd& y, double penalty, const MatrixXd& at) {
  MatrixXd design = MatrixXd::Zero(x.rows() + x.cols(), x.cols() + 1);
  VectorXd right = VectorXd::Zero(design.rows());
  design.topLeftCorner(x.rows(), 1).setOnes();
  design.topRightCorner(x.rows(), x.cols()) = x;
  design.bottomRightCorner(x.cols(), x.cols()).diagonal().setConstant(std::sqrt(penalty));
  right.head(x.rows()) = y;
  const VectorXd beta = design.colPivHouseholderQr().solve(right);
  return (at * beta.tail(x.cols())).array() + beta[0];
}

struct Data {
  MatrixXd x, y;
  VectorXd query;
};

// Twelve predictors of which two matter to the first target and none to the second.
Data data(Index rows) {
  Data d{normals(rows, 12, 1), normals(rows, 2, 2), normals(12, 1, 3)};
  d.y.col(0) += 2 * d.x.col(0) - d.x.col(5);
  d.y.array() += 4;
  return d;
}

TEST(Ridge, EveryFoldIsPredictedFromTheOthers) {
  const Data d = data(64);
  const RidgeFit fit = ridge(d.x, d.y, d.query);
  for (Index target = 0; target < 2; ++target) {
    EXPECT_NEAR(fit.predicted[target], by_augmentation(d.x, d.y.col(target), fit.penalty[target], d.query.transpose())[0], 1e-9);
    for (Index fold = 0; fold < kFolds; ++fold) {
      std::vector<Index> in, out;
      for (Index i = 0; i < d.x.rows(); ++i) (i % kFolds == fold ? in : out).push_back(i);
      const VectorXd expected =
          by_augmentation(chosen_rows(d.x, out), chosen_rows(d.y, out).col(target), fit.penalty[target], chosen_rows(d.x, in));
      for (std::size_t k = 0; k < in.size(); ++k) EXPECT_NEAR(fit.held_out(in[k], target), expected[static_cast<Index>(k)], 1e-9);
    }
  }
}

TEST(Ridge, ThePenaltyIsTheBestForRowsLeftOut) {
  const Data d = data(40);
  const RidgeFit fit = ridge(d.x, d.y, d.query);
  const auto error = [&](Index target, double penalty) {
    double sum = 0;
    for (Index i = 0; i < d.x.rows(); ++i) {
      std::vector<Index> others;
      for (Index k = 0; k < d.x.rows(); ++k)
        if (k != i) others.push_back(k);
      sum += std::pow(
          by_augmentation(chosen_rows(d.x, others), chosen_rows(d.y, others).col(target), penalty, d.x.row(i))[0] - d.y(i, target), 2.0);
    }
    return sum;
  };
  for (Index target = 0; target < 2; ++target) {
    const double best = error(target, fit.penalty[target]);
    // The grid has two values per decade; centring by the mean of all rows instead of the others' moves an error by less than 1 %.
    for (const double factor : {0.1, 0.316, 3.16, 10.0}) EXPECT_LT(best, 1.01 * error(target, fit.penalty[target] * factor));
  }
  EXPECT_LT(10 * fit.penalty[0], fit.penalty[1]) << "where predictors say nothing they are shrunk away";
}

TEST(Ridge, MorePredictorsThanRowsAndPredictorsTwiceAreNoTrouble) {
  MatrixXd x = normals(30, 50, 4);
  x.col(7) = x.col(3);
  const MatrixXd y = x.col(3) + 0.1 * normals(30, 1, 5);
  const RidgeFit fit = ridge(x, y, VectorXd::Zero(50));
  EXPECT_TRUE(fit.held_out.allFinite());
  EXPECT_TRUE(fit.predicted.allFinite());
}

}  // namespace
}  // namespace swarmfit
