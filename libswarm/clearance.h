// SPDX-License-Identifier: MIT
// How far from a surface a place is at least, without looking at the surface: from its distance at the centres of a few thousand cells. A
// distance changes by no more than the way.
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

namespace swarmfit {

class Clearance {
 public:
  Clearance() = default;
  // Of a surface within this box; distance: > 0 outside, < 0 inside.
  Clearance(const Eigen::Array3d& lower, const Eigen::Array3d& upper, const std::function<double(const Eigen::Array3d&)>& distance);

  // At most the distance from the surface, with its sign; 0: cannot be told [unit].
  double at(const Eigen::Array3d& place) const;

 private:
  Eigen::Array3d lower_ = Eigen::Array3d::Zero(), upper_ = Eigen::Array3d::Zero();
  double cell_ = 1, slack_ = 0;
  std::array<Eigen::Index, 3> count_{};
  std::vector<double> distance_;  // at the centres
};

}  // namespace swarmfit
