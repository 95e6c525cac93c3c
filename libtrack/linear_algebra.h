// SPDX-License-Identifier: MIT
// Decompositions of dense matrices of any size by Eigen, whose templates take seconds to compile: here they are compiled once.
// Shapes must agree. What is singular or not finite gives results that are not finite; nothing throws.
#pragma once

#include <Eigen/Core>

namespace swarmfit {

// Lower triangular L with a = L Lᵀ; a is symmetric and positive definite.
Eigen::MatrixXd cholesky_factor(const Eigen::MatrixXd& a);

// L⁻¹ b; L is lower triangular.
Eigen::MatrixXd solve_lower(const Eigen::MatrixXd& l, const Eigen::MatrixXd& b);

// a⁻¹ b; a is symmetric and positive definite, or (semidefinite) may be singular.
Eigen::MatrixXd solve_definite(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
Eigen::MatrixXd solve_semidefinite(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

// Eigenvalues, ascending, and their vectors, in columns, of a symmetric matrix.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& a);

// The shortest x that minimises |a x - b|; and the pseudoinverse, which maps any b to it.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a);

Eigen::MatrixXd inverse(const Eigen::MatrixXd& a);

}  // namespace swarmfit
