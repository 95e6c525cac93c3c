// SPDX-License-Identifier: MIT
// Linear regression of accelerations that neither localisation error nor a memory of the noise misleads.
#pragma once

#include <array>
#include <vector>

#include "libswarm/symmetric_differences.h"

namespace swarmfit {

// Both sides: accelerations, and terms at the same places. A row per row of the differences; axes beyond dims are empty.
struct RegressionDesign {
  RegressionDesign(const SymmetricDifferences& seen, Index coefficients);  // terms are 0
  Index rows() const { return acceleration[0].size(); }

  Index coefficients, dims;
  double dt;
  std::vector<SymmetricDifferences::Run> runs;
  std::array<Eigen::VectorXd, 3> acceleration;
  std::array<Eigen::MatrixXd, 3> terms;  // rows × coefficients
};

// Noise that remembers: variance per axis, and by what it shrinks in a frame.
struct NoiseMemory {
  double rho = 0;
  Eigen::Array3d variance = Eigen::Array3d::Zero();
};

// With noise that remembers by rho from frame to frame,
//
//   a_t - rho a_{t-1} = theta · (c_t - rho c_{t-1}) + new noise,
//
// and new noise is independent of the terms c four frames before, which share no position with either side: they are the instruments of
// a regression that neither localisation error nor the memory of the noise misleads (Söderström and Stoica 1983). rho and the variance of
// the remembered noise are those of an exponential through the autocovariance of the residuals from the third frame on, where error is
// gone, to where it has died away; the shortest memory is taken that agrees with its own theta. What is white is what the first two
// autocovariances have beside it and beside the localisation error:
//
//   sigma² = 6 / (11 dt³) (2 Var D + 3 Cov(D_t, D_t+1)),  D = a dt²
//
// Errors are those of a sandwich over pieces of tracks; tests are Hotelling's, as there may be few of them.
class InstrumentalRegression {
 public:
  explicit InstrumentalRegression(RegressionDesign design);

  Index rows() const { return rows_; }  // that have instruments

  // Coefficients of these columns, with the memory that goes with them, or with the memory as it is. Those that no row can tell stay 0.
  void fit(const std::vector<Index>& columns);
  void refit(const std::vector<Index>& columns);
  void use(const NoiseMemory& memory) { memory_ = memory; }

  const NoiseMemory& memory() const { return memory_; }
  const Eigen::VectorXd& coefficients() const { return theta_; }     // 0 for those that were not fitted
  const Eigen::MatrixXd& covariance() const { return covariance_; }  // 0 for those; NaN for those that no row can tell
  double p_of(Index first, Index count) const;                       // could all of these coefficients be 0? NaN: it cannot be told
  Eigen::Array3d white() const;                                      // strength of what is white, per axis
  double unexplained() const;                                        // mean square of the residuals, without what the noise remembers

 private:
  // Sums for any memory of the noise.
  struct Moments {
    Eigen::MatrixXd now, before;  // instruments · terms of the same and of the preceding frame
    Eigen::VectorXd a_now, a_before;
  };

  std::vector<SymmetricDifferences::Run> long_runs() const;
  void choose(const std::vector<Index>& columns);
  void solve();
  void add_errors();
  double autocovariance(Index axis, Index shift) const;
  Eigen::ArrayX3d remembered() const;
  void find_memory();
  bool remembers() const;

  RegressionDesign design_;
  Eigen::VectorXd scale_;  // root mean square of every term
  Moments moments_;
  Index rows_ = 0;
  std::vector<Index> columns_, unseen_;  // that are fitted, and that no row can tell
  Eigen::MatrixXd normal_, covariance_;
  Eigen::VectorXd theta_;
  std::array<Eigen::VectorXd, 3> residuals_;
  NoiseMemory memory_;
  Index pieces_ = 0;
};

}  // namespace swarmfit
