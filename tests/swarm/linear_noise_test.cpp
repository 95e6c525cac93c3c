// SPDX-License-Identifier: MIT
#include "libswarm/linear_noise.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <unsupported/Eigen/MatrixFunctions>

namespace swarmfit {
namespace {

using Matrix = LinearNoise<3>::Matrix;
using Eigen::Matrix3d;

Matrix3d of(const Matrix& m) {
  Matrix3d out;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) out(r, c) = m[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
  return out;
}

Matrix3d covariance(const LinearNoise<3>& step) { return of(step.draw) * of(step.draw).transpose(); }

// A damped oscillator driven by noise with a memory, as in langevin.cpp: stiff, soft, with a memory far shorter than a step.
const Matrix kDrifts[] = {
    {{{0, 1, 0}, {-5, -2, 1}, {0, 0, -10}}}, {{{0, 1, 0}, {0, -0.1, 1}, {0, 0, -0.5}}}, {{{0, 1, 0}, {-40, -9, 1}, {0, 0, -900}}}};

// Eigen's matrix exponential is an implementation of its own (Padé approximants; Higham 2005).
TEST(LinearNoise, PropagatorIsTheMatrixExponential) {
  for (const Matrix& a : kDrifts)
    for (const double dt : {1e-3, 0.04, 0.7}) {
      const Matrix3d expected = (of(a) * dt).exp();
      EXPECT_LT((of(LinearNoise<3>(a, {0, 0, 1}, dt).keep) - expected).norm(), 1e-12) << dt;
    }
}

// Van Loan 1978: the covariance out of one exponential of twice the size. That is exact to eight digits only, and to none where a step is
// many times as long as the shortest memory: the exponential of minus the drift is then astronomical.
TEST(LinearNoise, CovarianceIsThatOfVanLoan) {
  for (const Matrix& a : {kDrifts[0], kDrifts[1]})
    for (const double dt : {1e-3, 0.04}) {
      Eigen::Matrix<double, 6, 6> block = Eigen::Matrix<double, 6, 6>::Zero();
      block.topLeftCorner<3, 3>() = -of(a);
      block.bottomRightCorner<3, 3>() = of(a).transpose();
      block(2, 5) = 2.25;
      const Eigen::Matrix<double, 6, 6> e = (block * dt).exp();
      const Matrix3d expected = e.bottomRightCorner<3, 3>().transpose() * e.topRightCorner<3, 3>();
      const Matrix3d seen = covariance(LinearNoise<3>(a, {0, 0, 1.5}, dt));
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen(r, c), expected(r, c), 1e-7 * std::sqrt(expected(r, r) * expected(c, c))) << dt;
    }
}

// The stiff one: two steps are one of twice the length, and after many the covariance is stationary, A C + C Aᵀ + b bᵀ = 0.
TEST(LinearNoise, StiffCovariance) {
  const Matrix3d a = of(kDrifts[2]);
  const LinearNoise<3> once(kDrifts[2], {0, 0, 1.5}, 0.04), twice(kDrifts[2], {0, 0, 1.5}, 0.08), forever(kDrifts[2], {0, 0, 1.5}, 50);
  const Matrix3d c = covariance(once), composed = of(once.keep) * c * of(once.keep).transpose() + c;
  EXPECT_LT((composed - covariance(twice)).norm(), 1e-12 * composed.norm());
  Matrix3d rest = a * covariance(forever) + covariance(forever) * a.transpose();
  rest(2, 2) += 2.25;
  EXPECT_LT(rest.norm(), 1e-9);
}

// A Wiener process drives a velocity: the place has a third of dt³, and their correlation is sqrt(3) / 2.
TEST(LinearNoise, FreeVelocity) {
  const LinearNoise<2> step({{{0, 1}, {0, 0}}}, {0, 1}, 0.5);
  EXPECT_NEAR(step.draw[0][0] * step.draw[0][0], 0.125 / 3, 1e-16);
  EXPECT_NEAR(step.draw[1][0] * step.draw[1][0] + step.draw[1][1] * step.draw[1][1], 0.5, 1e-15);
  EXPECT_NEAR(step.draw[1][0] / std::sqrt(0.5), std::sqrt(3) / 2, 1e-14);
  EXPECT_EQ(step.keep, (LinearNoise<2>::Matrix{{{1, 0.5}, {0, 1}}}));
}

TEST(LinearNoise, NothingDrawnWithoutNoise) { EXPECT_EQ(LinearNoise<3>(kDrifts[0], {0, 0, 0}, 0.1).draw, Matrix{}); }

}  // namespace
}  // namespace swarmfit
