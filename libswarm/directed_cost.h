// SPDX-License-Identifier: MIT
// The least cost of getting to a goal in the plane where the cost of a way depends on its direction, by fast marching: A. Treuille,
// S. Cooper, Z. Popović, Continuum crowds, ACM Transactions on Graphics 25(3), 2006 (doi:10.1145/1141911.1142008), section 4.3.
#pragma once

#include <array>
#include <vector>

#include "libswarm/cost_field.h"

namespace swarmfit {

// The faces of a cell in the plane, and of each the step to the cell beyond it.
inline constexpr std::array<std::array<int, 2>, 4> kFaces{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};

class DirectedCostField {
 public:
  // One value per face of a cell: the cost per length of a way out through it, > 0; infinite: nobody passes.
  using Faces = std::array<double, 4>;

  // grid: one cell along z. goal: the cost of these cells is 0.
  DirectedCostField(const FieldGrid& grid, std::vector<Faces> slowness, const std::vector<bool>& goal);

  double cost(Index cell) const { return cost_[static_cast<std::size_t>(cell)]; }  // infinite where no way leads to a goal

  // Unit vector down the cost, as shares of the four faces: of each pair at most one is above 0. All are 0 in goals and where no way leads
  // to one.
  Faces downhill(Index cell) const;

 private:
  struct Way {
    double cost;  // of the cell beyond the face
    double step;  // what it costs to get there
    std::size_t face;
  };
  std::array<Way, 2> ways(Index cell) const;  // the cheaper one along either axis
  double update(Index cell) const;
  Index beyond(Index cell, std::size_t face) const;  // -1: the grid ends here

  FieldGrid grid_;
  std::vector<Faces> slowness_;
  std::vector<double> cost_;
};

}  // namespace swarmfit
