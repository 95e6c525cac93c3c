// SPDX-License-Identifier: MIT
// Sums over the neighbours in two zones, the inner loop of every zonal model.
#pragma once

#include "libswarm/neighbours.h"

namespace swarmfit {

// Unit vectors from agent i to everybody with distance < inner (near), and outer_from <= distance <= outer_to (far), summed.
struct ZoneSums {
  Eigen::Array3d near = Eigen::Array3d::Zero(), far = Eigen::Array3d::Zero();
  double near_count = 0, far_count = 0;
  Index coincident = 0;  // others at the same place: they have no direction, and are in neither sum nor count
};

// Closer than this two agents are at the same place [unit].
inline constexpr double kCoincident = 1e-9;

// `neighbours` is built with at least the largest of the radii.
ZoneSums zone_sums(const Neighbours& neighbours, Index i, double inner, double outer_from, double outer_to);

}  // namespace swarmfit
