// SPDX-License-Identifier: MIT
// Velocities that were recorded, for agents that have to begin with some.
#pragma once

#include <vector>

#include "libtrack/tracks.h"

namespace swarmfit {

// Forward differences of a recording that must outlive it.
class RecordedVelocities {
 public:
  explicit RecordedVelocities(const Tracks& recording);
  bool none() const { return moving_.empty(); }  // nobody is seen in two frames on end
  Eigen::Array3d at(double u) const;             // one of them, u in [0, 1); not if there is none

 private:
  const Tracks& recording_;
  std::vector<Index> moving_;
};

}  // namespace swarmfit
