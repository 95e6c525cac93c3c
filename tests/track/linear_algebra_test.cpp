// SPDX-License-Identifier: MIT
#include "libtrack/linear_algebra.h"

#include <gtest/gtest.h>

#include <cmath>

namespace swarmfit {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd definite() {
  MatrixXd a(3, 3);
  a << 4, 1, 0, 1, 3, 1, 0, 1, 2;
  return a;
}

TEST(LinearAlgebra, FactorsAndSolutionsGiveTheMatrixBack) {
  const MatrixXd a = definite(), l = cholesky_factor(a), b = MatrixXd::Random(3, 2);
  EXPECT_TRUE((l * l.transpose()).isApprox(a, 1e-14));
  EXPECT_EQ(l(0, 2), 0);
  EXPECT_TRUE((l * solve_lower(l, b)).isApprox(b, 1e-14));
  EXPECT_TRUE((a * solve_definite(a, b)).isApprox(b, 1e-13));
  EXPECT_TRUE((a * solve_semidefinite(a, b)).isApprox(b, 1e-13));
  EXPECT_TRUE((a * inverse(a)).isIdentity(1e-13));
}

TEST(LinearAlgebra, EigenvaluesAscend) {
  MatrixXd a(2, 2);
  a << 2, 1, 1, 2;
  const auto [values, vectors] = symmetric_eigen(a);
  EXPECT_NEAR(values[0], 1, 1e-14);
  EXPECT_NEAR(values[1], 3, 1e-14);
  EXPECT_TRUE((vectors * values.asDiagonal() * vectors.transpose()).isApprox(a, 1e-14));
}

// Two equal columns share what one would have.
TEST(LinearAlgebra, TheShortestOfManySolutions) {
  MatrixXd a(3, 2);
  a << 1, 1, 2, 2, 3, 3;
  const VectorXd b = VectorXd::LinSpaced(3, 2, 6);
  EXPECT_TRUE(least_squares(a, b).isApprox(VectorXd::Ones(2), 1e-13));
  EXPECT_TRUE((pseudo_inverse(a) * b).isApprox(VectorXd::Ones(2), 1e-13));
}

}  // namespace
}  // namespace swarmfit
