// SPDX-License-Identifier: MIT
// Ridge regression with the penalty chosen by leave-one-out (Hoerl and Kennard 1970; Allen 1974), and predictions that do not know
// their own row.
#pragma once

#include <Eigen/Core>

namespace swarmfit {

inline constexpr Eigen::Index kFolds = 10;

struct RidgeFit {
  Eigen::MatrixXd held_out;   // rows × targets: row i predicted from all rows but those of its fold, i modulo kFolds
  Eigen::VectorXd predicted;  // one per target: at the query, from all rows
  Eigen::VectorXd penalty;    // one per target
};

// Linear regression of every column of y (rows × targets) on the columns of x (rows × predictors; as many as you like), with an intercept
// that is not penalised. Every target has a penalty of its own: of a grid, the one with the least squared error of single rows left out.
// Predictors should have similar spreads, since they are penalised alike, and the order of rows should not matter. At least 2 kFolds rows;
// everything finite.
//
// Folds and not single rows are held out from the predictions: where predictors say nothing, a row's prediction is the mean of all others,
// which by itself tells the row's value exactly.
RidgeFit ridge(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y, const Eigen::VectorXd& query);

}  // namespace swarmfit
