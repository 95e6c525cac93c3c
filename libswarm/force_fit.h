// SPDX-License-Identifier: MIT
// A force law that was found, and how sure it is.
#pragma once

#include <array>

#include "libswarm/force_law.h"

namespace swarmfit {

using ForceGroups = std::array<bool, kForceGroups>;  // which are in a law

struct ForceFit {
  ForceLaw law;                          // NaN coefficients if there is too little to see
  ForceGroups groups{};                  // that are in it
  Eigen::MatrixXd covariance;            // of the coefficients; 0 for those that are not in it, NaN for those that no row can tell
  std::array<double, kForceGroups> p{};  // of each group that is in it: could all its coefficients be 0? NaN: it is not
  Index rows = 0;                        // accelerations that were used

  double se(ForceGroup group, std::size_t k = 0) const;
  double drag_se(double speed) const;
  double confinement_se(double distance) const;
  double kernel_se(ForceGroup group, double distance) const;

 private:
  Eigen::MatrixXd known() const;
};

}  // namespace swarmfit
