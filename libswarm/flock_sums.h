// SPDX-License-Identifier: MIT
// What Reynolds' three rules sum over an agent's neighbours.
#pragma once

#include "libswarm/neighbours.h"

namespace swarmfit {

// Velocities in the order of a neighbour search's slots.
class SlotVelocities {
 public:
  void take(const Neighbours& neighbours, const Rows& vel);
  const double* component(std::size_t axis) const { return v_[axis].data(); }

 private:
  std::array<std::vector<double>, 3> v_;
};

struct FlockSums {
  Eigen::Array3d separation;  // of (p_i - p_j) / distance² over distances in (0, inner)
  Eigen::Array3d alignment;   // of v_j - v_i over distances below outer
  Eigen::Array3d cohesion;    // of p_j - p_i over the same
};

// `neighbours` is built with at least `outer`, which is at least `inner`; velocities are those of its last build.
FlockSums flock_sums(const Neighbours& neighbours, const SlotVelocities& velocities, Index i, double inner, double outer);

}  // namespace swarmfit
