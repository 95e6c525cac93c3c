// SPDX-License-Identifier: MIT
// Where a swarm stays, for models that keep it there: one answer for all of them.
#pragma once

#include <optional>

#include "libswarm/model.h"

namespace swarmfit {

// The middle of an arena [unit]; in the open the origin.
Eigen::Array3d middle_of(const Bounds& bounds);

// The mean position of all observations of the recording; without a recording the middle of the arena.
class SwarmCentre {
 public:
  explicit SwarmCentre(const Setup& setup);

  Eigen::Array3d in(const Bounds& bounds) const { return recorded_ ? *recorded_ : middle_of(bounds); }

 private:
  std::optional<Eigen::Array3d> recorded_;
};

}  // namespace swarmfit
