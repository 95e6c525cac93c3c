// SPDX-License-Identifier: MIT
// Unit vectors and how they turn, for models of agents that steer. In two dimensions everything turns about z and stays in the plane.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "libtrack/tracks.h"

namespace swarmfit {

// a / |a|, and 0 for 0.
inline Eigen::Array3d heading_of(const Eigen::Array3d& a) {
  const double length = std::sqrt(a.square().sum());
  return length > 0 ? Eigen::Array3d(a / length) : Eigen::Array3d(Eigen::Array3d::Zero());
}

// A unit vector at right angles to the unit vector d: one for every angle in [0, 2π), evenly round d. In two dimensions d turned by +90°.
inline Eigen::Array3d perpendicular(const Eigen::Array3d& d, double angle, int dims) {
  if (dims == 2) return {-d[1], d[0], 0};
  Index least = 0;
  d.abs().minCoeff(&least);
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  axis[least] = 1;
  const Eigen::Vector3d first = axis.cross(d.matrix()).normalized(), second = d.matrix().cross(first);
  return (std::cos(angle) * first + std::sin(angle) * second).array();
}

// The unit vector d turned by `angle` towards the perpendicular unit vector `side`.
inline Eigen::Array3d turned(const Eigen::Array3d& d, const Eigen::Array3d& side, double angle) {
  return heading_of(std::cos(angle) * d + std::sin(angle) * side);
}

// Angle between two unit vectors [rad], exact also near 0 and π.
inline double angle_between(const Eigen::Array3d& a, const Eigen::Array3d& b) {
  return 2 * std::atan2(std::sqrt((a - b).square().sum()), std::sqrt((a + b).square().sum()));
}

// The unit vector v turned towards the unit vector `goal`, by `most` at most [rad]; `side`: where to when they are opposite.
inline Eigen::Array3d turned_towards(const Eigen::Array3d& v, const Eigen::Array3d& goal, double most, const Eigen::Array3d& side) {
  if (angle_between(v, goal) <= most) return goal;
  const Eigen::Array3d across = goal - (goal * v).sum() * v;
  const double length = std::sqrt(across.square().sum());
  return turned(v, length > 1e-12 ? Eigen::Array3d(across / length) : side, most);
}

}  // namespace swarmfit
