// SPDX-License-Identifier: MIT
// How far apart individuals would be if they did not care about each other.
#pragma once

namespace swarmfit {

// Volume [unit³] (area [unit²]) of the uniform ellipsoid (ellipse) whose covariance has this determinant: its semi-axes are sqrt(5) (2)
// standard deviations.
double uniform_volume(double determinant, int dims);

// Mean distance to the nearest point of a Poisson process, times its density^(1/dims): 1/2, or Γ(4/3) (4π/3)^(-1/3).
double poisson_nearest(int dims);

}  // namespace swarmfit
