// SPDX-License-Identifier: MIT
// Reciprocal collision avoidance: every agent takes half of the smallest change of velocity that keeps a pair apart for a time tau.
// J. van den Berg, S. J. Guy, M. Lin, D. Manocha, Reciprocal n-body collision avoidance, ISRR 2009/2011 (doi:10.1007/978-3-642-19457-3_1).
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace swarmfit {

// The velocities with normal · v >= bound; normal is a unit vector.
struct HalfSpace {
  Eigen::Vector3d normal;
  double bound;
  double depth(const Eigen::Vector3d& v) const { return bound - normal.dot(v); }  // > 0 where v is not allowed
};

// What agent i may do about one neighbour.
//   offset    position of the neighbour minus own position
//   velocity  own
//   relative  own velocity minus the neighbour's
//   distance  at which the two touch: the sum of the radii
//   tau       time for which they must not touch; if they touch already they part within one step dt
//   tie       direction in which i leaves when both the places and the velocities are the same; the neighbour's must be the opposite
HalfSpace reciprocal_half_space(const Eigen::Vector3d& offset, const Eigen::Vector3d& velocity, const Eigen::Vector3d& relative,
                                double distance, double tau, double dt, const Eigen::Vector3d& tie);

// Four neighbours of one agent, a component per entry.
struct FourNeighbours {
  double offset[3][4]{}, relative[3][4]{};
};

// The same for n neighbours, four at a time and with the same bits: half-space k is out[k]. The tie is the x axis.
void reciprocal_half_spaces(const FourNeighbours* neighbours, std::size_t n, const Eigen::Vector3d& velocity, double distance, double tau,
                            double dt, HalfSpace* out);

struct Avoidance {
  Eigen::Vector3d velocity;
  bool feasible;  // false: no velocity is in all half-spaces and within the speed limit; `velocity` is then meaningless
};

// The velocity nearest to `preferred` in all half-spaces with |v| <= max_speed, by incremental linear programming (Seidel 1991).
// Planar problems (all normals and `preferred` with z = 0) have planar solutions.
Avoidance nearest_velocity(std::span<const HalfSpace> allowed, const Eigen::Vector3d& preferred, double max_speed);

// For infeasible problems: the velocity with |v| <= max_speed whose largest depth in any half-space is smallest. `scratch` is overwritten.
Eigen::Vector3d least_penetration(std::span<const HalfSpace> allowed, const Eigen::Vector3d& preferred, double max_speed,
                                  std::vector<HalfSpace>& scratch);

}  // namespace swarmfit
