// SPDX-License-Identifier: MIT
// Who is near whom. A cell grid for a fixed radius, all pairs for small groups (faster there, and the oracle of the tests), k nearest.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "libswarm/state.h"
#include "libswarm/world.h"

namespace swarmfit {

// Reusable search structure of one run; allocates only when a group outgrows all before it.
//
//   near.build(now.pos, world.bounds, radius);
//   near.visit(i, [&](Index j, const Eigen::Array3d& offset, double distance) { ... });
//
// Positions are copied in the order of their cells, so that neighbours in space are neighbours in memory. A place in that order is a slot.
class Neighbours {
 public:
  enum class Method { automatic, all_pairs, grid };

  // automatic: all pairs below this many agents. Measured (bench/neighbours_bench.cpp); depends on nothing but the number of agents, so
  // that the order of summation, and with it the last bits, never depends on where the agents are.
  static constexpr Index kAllPairsBelow = 400;

  struct Found {
    double distance2;  // squared distance [unit²]
    Index row;
    Eigen::Array3d offset;  // separation(i, row)
  };

  void build(const Rows& pos, const Bounds& bounds, double radius, Method method = Method::automatic);

  // Reports every j != i with |offset| < radius, offset = separation(i, j), in an order that depends only on the positions.
  template <class Visit>
  void visit(Index i, Visit&& visit) const {
    const Index self = slot_[static_cast<std::size_t>(i)];
    const Eigen::Array3d at = position(self);
    for_each_run(self, [&](Index first, Index end) {
      for (Index s = first; s < end; ++s) {
        const Eigen::Array3d offset = shortest(position(s) - at);
        const double d2 = offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2];
        if (d2 < radius_ * radius_ && s != self) visit(row_[static_cast<std::size_t>(s)], offset, std::sqrt(d2));
      }
    });
  }

 private:
  template <class Run>
  void for_each_run(Index /*self*/, Run&& run) const {
    run(Index{0}, size());
  }
  Index size() const { return static_cast<Index>(row_.size()); }
  Eigen::Array3d position(Index s) const {
    return {x_[0][static_cast<std::size_t>(s)], x_[1][static_cast<std::size_t>(s)], x_[2][static_cast<std::size_t>(s)]};
  }
  Eigen::Array3d shortest(Eigen::Array3d d) const {
    for (Index axis = 0; axis < 3; ++axis) {
      if (d[axis] > half_[axis]) d[axis] -= period_[axis];
      if (d[axis] < -half_[axis]) d[axis] += period_[axis];
    }
    return d;
  }

  double radius_ = 0;
  Eigen::Array3d period_ = Eigen::Array3d::Zero(), half_ = Eigen::Array3d::Zero();
  std::array<std::vector<double>, 3> x_;
  std::vector<Index> row_, slot_;
};

}  // namespace swarmfit
