// SPDX-License-Identifier: MIT
#include "libtrack/linear_algebra.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

namespace swarmfit {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd cholesky_factor(const MatrixXd& a) { return a.llt().matrixL(); }

MatrixXd solve_lower(const MatrixXd& l, const MatrixXd& b) { return l.triangularView<Eigen::Lower>().solve(b); }

MatrixXd solve_definite(const MatrixXd& a, const MatrixXd& b) { return a.llt().solve(b); }

MatrixXd solve_semidefinite(const MatrixXd& a, const MatrixXd& b) { return a.ldlt().solve(b); }

SymmetricEigen symmetric_eigen(const MatrixXd& a) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

VectorXd least_squares(const MatrixXd& a, const VectorXd& b) { return a.completeOrthogonalDecomposition().solve(b); }

MatrixXd pseudo_inverse(const MatrixXd& a) { return a.completeOrthogonalDecomposition().pseudoInverse(); }

MatrixXd inverse(const MatrixXd& a) { return a.inverse(); }

}  // namespace swarmfit
