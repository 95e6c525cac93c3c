// SPDX-License-Identifier: MIT
#include "fit/infer/ridge.h"

#include <cassert>
#include <cmath>

#include "libtrack/linear_algebra.h"

namespace swarmfit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLeastPenalty = 1e-8, kLargestPenalty = 10;  // in units of the largest eigenvalue of xᵀx
constexpr int kPenalties = 19;                                // two per decade

// Sums over the rows of one fold (all: every row) that least squares need.
struct Sums {
  double rows = 0;
  VectorXd x, y;
  MatrixXd xx, xy;
  Sums operator-(const Sums& o) const { return {rows - o.rows, x - o.x, y - o.y, xx - o.xx, xy - o.xy}; }
};

Sums sums(const MatrixXd& x, const MatrixXd& y) {
  const VectorXd ones = VectorXd::Ones(x.rows());
  return {static_cast<double>(x.rows()), x.transpose() * ones, y.transpose() * ones, x.transpose() * x, x.transpose() * y};
}

MatrixXd rows_of_fold(const MatrixXd& m, Index fold) {
  MatrixXd part((m.rows() - fold + kFolds - 1) / kFolds, m.cols());
  for (Index c = 0; c < m.cols(); ++c)
    for (Index i = 0; i < part.rows(); ++i) part(i, c) = m(fold + i * kFolds, c);
  return part;
}

// One column of coefficients per target; prediction is y_mean + (x - x_mean)ᵀ slopes.
struct Fit {
  VectorXd x_mean, y_mean;
  MatrixXd slopes;
  VectorXd at(const VectorXd& query) const { return y_mean + slopes.transpose() * (query - x_mean); }
  MatrixXd at(const MatrixXd& x) const {
    const VectorXd constant = y_mean - slopes.transpose() * x_mean;
    return x * slopes + VectorXd::Ones(x.rows()) * constant.transpose();
  }
};

Fit fit(const Sums& s, const VectorXd& penalty) {
  Fit out{s.x / s.rows, s.y / s.rows, MatrixXd(s.x.size(), s.y.size())};
  const MatrixXd gram = s.xx - s.x * s.x.transpose() / s.rows, moment = s.xy - s.x * s.y.transpose() / s.rows;
  for (Index j = 0; j < penalty.size(); ++j) {
    MatrixXd ridged = gram;
    ridged.diagonal().array() += penalty[j];
    const VectorXd right = moment.col(j);
    out.slopes.col(j) = solve_definite(ridged, right);
  }
  return out;
}

// Per target, by the leverages: without row i its residual is e_i / (1 - h_i).
VectorXd best_penalties(const MatrixXd& x, const MatrixXd& y, const Sums& s) {
  const VectorXd ones = VectorXd::Ones(x.rows());
  const MatrixXd from_mean = x - ones * (s.x / s.rows).transpose(), target = y - ones * (s.y / s.rows).transpose();
  const MatrixXd gram = s.xx - s.x * s.x.transpose() / s.rows;
  const SymmetricEigen eigen = symmetric_eigen(gram);
  const VectorXd power = eigen.values.cwiseMax(0.0);
  const MatrixXd rotated = from_mean * eigen.vectors, squared = rotated.cwiseAbs2();
  const MatrixXd moment = rotated.transpose() * target;
  const double largest = power.size() > 0 && power.maxCoeff() > 0 ? power.maxCoeff() : 1;
  VectorXd least = VectorXd::Constant(y.cols(), INFINITY), best = VectorXd::Constant(y.cols(), largest * kLargestPenalty);
  for (int k = 0; k < kPenalties; ++k) {
    const double penalty = largest * kLeastPenalty * std::pow(kLargestPenalty / kLeastPenalty, k / (kPenalties - 1.0));
    const VectorXd shrink = (power.array() + penalty).inverse().matrix();
    const VectorXd leverage = squared * shrink;
    const MatrixXd fitted = rotated * (shrink.asDiagonal() * moment);
    for (Index j = 0; j < y.cols(); ++j) {
      double error = 0;
      for (Index i = 0; i < y.rows(); ++i) {
        const double residual = (target(i, j) - fitted(i, j)) / std::max(1 - 1 / s.rows - leverage[i], 1e-9);
        error += residual * residual;
      }
      if (error < least[j]) least[j] = error, best[j] = penalty;
    }
  }
  return best;
}

}  // namespace

RidgeFit ridge(const MatrixXd& x, const MatrixXd& y, const VectorXd& query) {
  assert(x.rows() == y.rows() && x.rows() >= 2 * kFolds && x.cols() == query.size());
  const Sums all = sums(x, y);
  RidgeFit out{MatrixXd(y.rows(), y.cols()), {}, best_penalties(x, y, all)};
  out.predicted = fit(all, out.penalty).at(query);
  for (Index fold = 0; fold < kFolds; ++fold) {
    const MatrixXd held = rows_of_fold(x, fold);
    const MatrixXd predicted = fit(all - sums(held, rows_of_fold(y, fold)), out.penalty).at(held);
    for (Index j = 0; j < y.cols(); ++j)
      for (Index i = 0; i < predicted.rows(); ++i) out.held_out(fold + i * kFolds, j) = predicted(i, j);
  }
  return out;
}

}  // namespace swarmfit
