// SPDX-License-Identifier: MIT
// Who is near whom. A cell grid for a fixed radius, all pairs for small groups (faster there, and the oracle of the tests), k nearest.
#pragma once

#include <vector>

#include "libswarm/state.h"
#include "libswarm/world.h"

namespace swarmfit {

// Reusable search structure of one run; allocates only when a group outgrows all before it.
//
//   near.build(now.pos, world.bounds, radius);
//   near.visit(i, [&](Index j, const Eigen::Array3d& offset, double distance) { ... });
//
// visit reports every j != i with |offset| < radius, offset = separation(i, j), in an order that depends only on the positions.
class Neighbours {
 public:
  enum class Method { automatic, all_pairs, grid };

  void build(const Rows& pos, const Bounds& bounds, double radius, Method method = Method::automatic);
  template <class Visit>
  void visit(Index i, Visit&& visit) const;

 private:
  // completed by the implementation
};

}  // namespace swarmfit
