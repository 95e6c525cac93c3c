// SPDX-License-Identifier: MIT
// A law of motion as a sum of simple terms: what any model of pairs that answer each other's places and velocities at once could be.
//
//   dv = F(x, v, others) dt + white dW + eta dt
//   F  = - drag(|v|) v - stiffness (x - c) - hardening |x - c|² (x - c) + push
//        + sum over others of  pair(r) r̂ + alignment(r) (v_j - v_i)
//
// r̂ points to the other at distance r; pair > 0 attracts. drag is a polynomial of the speed, kernels are straight between knots.
// F. Lu, M. Zhong, S. Tang, M. Maggioni, PNAS 116: 14424, 2019 (doi:10.1073/pnas.1822012116) for kernels of pairs.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "libtrack/tracks.h"

namespace swarmfit {

// What a law is made of: terms that are in it or out of it together.
enum class ForceGroup { drag, speed_drag, confinement, hardening, push, pair, alignment };
inline constexpr std::size_t kForceGroups = 7;
std::string to_string(ForceGroup);

// Places and ranges that terms refer to, set by the recording: two laws of one basis can be compared term by term.
struct ForceBasis {
  int dims = 3;
  Eigen::Array3d centre = Eigen::Array3d::Zero();  // c: mean of all places [unit]
  double top_speed = 0;                            // of which the recording has 1 % faster [unit/s]; drag is not extrapolated
  double reach = 0;                                // of which it has 1 % farther from c [unit]; nor is confinement
  std::vector<double> knots;                       // of kernels, ascending, at least two or none [unit]; from the last on they are 0

  std::size_t kernel_size() const { return knots.empty() ? 0 : knots.size() - 1; }
  std::size_t first(ForceGroup) const;  // its place among the coefficients
  std::size_t count(ForceGroup) const;  // how many it has
  std::size_t size() const { return first(ForceGroup::alignment) + count(ForceGroup::alignment); }

  // Weights of the kernels' coefficients at this distance: two neighbouring ones at most, the first of which has this number. {0, 0, 0}
  // from the last knot on.
  struct Hat {
    std::size_t first = 0;
    double weight = 0, next = 0;
  };
  Hat hat(double distance) const;
};

// Terms for this recording. Kernels have knots at quantiles of the distances of pairs; fewer than two individuals, no kernels.
ForceBasis force_basis(const Tracks& recording);

struct ForceLaw {
  ForceBasis basis;
  Eigen::VectorXd coefficients;                      // basis.size(), in physical units
  Eigen::Array3d white = Eigen::Array3d::Zero();     // strength of white noise per axis [unit/s^1.5]
  Eigen::Array3d coloured = Eigen::Array3d::Zero();  // standard deviation of eta per axis [unit/s²]
  double memory = 0;                                 // of eta: Ornstein-Uhlenbeck [s]; 0: there is none

  double at(ForceGroup group, std::size_t k = 0) const { return coefficients[static_cast<Eigen::Index>(basis.first(group) + k)]; }
  double drag(double speed) const;                         // [1/s]
  double confinement(double distance) const;               // mean over the axes of stiffness, with hardening [1/s²]
  double kernel(ForceGroup group, double distance) const;  // pair [unit/s²], alignment [1/s]
};

}  // namespace swarmfit
