// SPDX-License-Identifier: MIT
// The least cost of getting to a goal from everywhere, by fast marching: J. A. Sethian, A fast marching level set method for monotonically
// advancing fronts, PNAS 93, 1996 (doi:10.1073/pnas.93.4.1591). First-order upwind differences; |grad C| = slowness.
#pragma once

#include <array>
#include <vector>

#include "libtrack/tracks.h"

namespace swarmfit {

// Cubic cells; values belong to their centres.
struct FieldGrid {
  Eigen::Array3d lower = Eigen::Array3d::Zero();  // corner of the first cell [unit]
  double cell = 0.1;                              // side, > 0 [unit]
  std::array<Index, 3> count{1, 1, 1};            // in two dimensions 1 along z

  Index cells() const { return count[0] * count[1] * count[2]; }
  Index index(Index i, Index j, Index k) const { return i + count[0] * (j + count[1] * k); }
  std::array<Index, 3> at(Index c) const { return {c % count[0], c / count[0] % count[1], c / (count[0] * count[1])}; }
  Eigen::Array3d centre(Index c) const;
  Index cell_of(const Eigen::Array3d& place) const;  // the nearest, for places beyond the grid
};

class CostField {
 public:
  // slowness: cost per length by cell, > 0; infinite: nobody passes. goal: the cost of these cells is 0.
  CostField(const FieldGrid& grid, std::vector<double> slowness, std::vector<bool> goal);

  double cost(Index cell) const { return cost_[static_cast<std::size_t>(cell)]; }  // infinite where no way leads to a goal
  // Unit vector down the cost, from the eight centres about the place; 0 in goals, and where no way leads to one.
  Eigen::Array3d direction(const Eigen::Array3d& place) const;
  const FieldGrid& grid() const { return grid_; }
  Index unreachable() const;  // passable cells from which no way leads to a goal

 private:
  void march();
  double update(Index cell) const;
  Eigen::Array3d downhill(Index cell) const;
  Eigen::Array3d to_least_neighbour(Index cell) const;

  FieldGrid grid_;
  std::vector<double> slowness_, cost_;
  std::vector<bool> goal_;
  std::vector<Eigen::Array3d> direction_;
};

}  // namespace swarmfit
