// SPDX-License-Identifier: MIT
// What tracks look like in some hundred numbers, for statistics that are learned from simulations (fit/infer/posterior.h).
#pragma once

#include <Eigen/Core>
#include <array>

#include "fit/experiment/conditions.h"
#include "libeval/energy.h"

namespace swarmfit {

// Dimensionless and finite, near normal where that can be had; their number and meaning are set by the recording alone. Const and shared by
// threads; holds references, so all arguments must outlive it.
//   - Of every column of the energy table that the recording defines: mean and standard deviation (logarithms; for signed columns the mean
//     over the recorded standard deviation), and square roots, whose spread does not depend on the share, of the shares of samples in
//     parts of the axis that hold a tenth of the recording's samples each, as far as bins allow.
//   - At every lag, what goes with accelerations: their means along the velocity (by quarters of the recorded speeds), away from the
//     recording's mean position (by distance), towards the nearest neighbour (by distance) and along the others' mean velocity less one's
//     own; their mean squares (by speed); their correlation from one lag to the next and between nearest neighbours (near, far); the
//     correlation of nearest neighbours' velocities (by distance); the mean square distance from the mean position. Such moments are to a
//     second-order model what least squares on accelerations would be. Sampling and localisation error bias them, in simulations alike.
class RunFeatures {
 public:
  RunFeatures(const Conditions& conditions, const Target& target);
  // What is undefined is 0.
  Eigen::VectorXd operator()(const Tracks& tracks) const;

 private:
  using Limits = std::array<double, 3>;  // between quarters
  struct Lag {
    int frames;
    Limits speed, place, near;
  };
  struct Turn;
  static std::vector<Turn> turns(const Tracks& tracks, int lag);
  Limits distances_from_middle(const std::vector<Turn>& turns) const;
  void add_drives(std::vector<double>& out, const Tracks& tracks, const Nearest& nearest, const Lag& lag) const;

  const Conditions& conditions_;
  const Target& target_;
  Eigen::Array3d middle_;
  std::vector<std::vector<std::size_t>> parts_;  // per column: first bins
  std::vector<Lag> lags_;
};

}  // namespace swarmfit
