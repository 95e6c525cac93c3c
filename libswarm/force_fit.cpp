// SPDX-License-Identifier: MIT
#include "libswarm/force_fit.h"

#include <algorithm>
#include <cmath>

#include "libtrack/nan.h"

namespace swarmfit {

using Eigen::MatrixXd;
using Eigen::VectorXd;

double ForceFit::se(ForceGroup group, std::size_t k) const {
  const auto c = static_cast<Index>(law.basis.first(group) + k);
  return std::sqrt(covariance(c, c));
}

// What nobody saw does not spoil the errors of the rest.
MatrixXd ForceFit::known() const { return covariance.array().isFinite().select(covariance.array(), 0.0).matrix(); }

double ForceFit::kernel_se(ForceGroup group, double distance) const {
  const auto [first, weight, next] = law.basis.hat(distance);
  VectorXd w = VectorXd::Zero(covariance.rows());
  const auto c = static_cast<Index>(law.basis.first(group) + first);
  if (weight == 0 && next == 0) return 0;
  if (weight != 0 && !std::isfinite(covariance(c, c))) return kNaN;
  if (next > 0 && !std::isfinite(covariance(c + 1, c + 1))) return kNaN;
  w[c] = weight;
  if (next > 0) w[c + 1] = next;
  return std::sqrt(w.dot(known() * w));
}

double ForceFit::confinement_se(double distance) const {
  const double d = std::min(distance, law.basis.reach);
  VectorXd w = VectorXd::Zero(covariance.rows());
  for (int axis = 0; axis < law.basis.dims; ++axis)
    w[static_cast<Index>(law.basis.first(ForceGroup::confinement)) + axis] = 1.0 / law.basis.dims;
  w[static_cast<Index>(law.basis.first(ForceGroup::hardening))] = d * d;
  return std::sqrt(w.dot(known() * w));
}

double ForceFit::drag_se(double speed) const {
  const double s = std::min(speed, law.basis.top_speed);
  VectorXd w = VectorXd::Zero(covariance.rows());
  const auto c = static_cast<Index>(law.basis.first(ForceGroup::speed_drag));
  w[static_cast<Index>(law.basis.first(ForceGroup::drag))] = 1;
  w[c] = s;
  w[c + 1] = s * s;
  return std::sqrt(w.dot(known() * w));
}

}  // namespace swarmfit
