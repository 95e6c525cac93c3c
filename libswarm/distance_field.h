// SPDX-License-Identifier: MIT
// How far it is to the nearest obstacle, exactly, and which way is out.
#pragma once

#include <limits>
#include <vector>

#include "libswarm/walls.h"

namespace swarmfit {

struct Surface {
  double distance;         // > 0 outside, < 0 inside [unit]
  Eigen::Array3d outward;  // its gradient: unit vector from the nearest point of the surface to the place, reversed inside
};

// To one body. Where several points of the surface are nearest, one of them: the centre of a sphere leaves along x.
Surface surface_of(const Obstacle& obstacle, const Eigen::Array3d& place, int dims);

// To the nearest of several: exact outside, and inside of bodies that do not overlap. Without any the distance is infinite, and so it may
// be where it is more than `within`: then nobody looks.
Surface nearest_surface(const std::vector<Obstacle>& obstacles, const Eigen::Array3d& place, int dims,
                        double within = std::numeric_limits<double>::infinity());

// Wang et al. 2014 (doi:10.1111/cgf.12277), Eq 6: 1 inside, 0 from `reach` on, Wyvill's polynomial in distance / reach between.
double repulsion(double distance, double reach);

}  // namespace swarmfit
