// SPDX-License-Identifier: MIT
// What a regression of accelerations has on either side: accelerations, and every term of a force law at the same places.
#pragma once

#include <array>
#include <vector>

#include "libswarm/force_law.h"
#include "libtrack/tracks.h"

namespace swarmfit {

// Rows are symmetric differences in unbroken runs of three frames or more: x̄ = (x_- + x + x_+) / 3, v = (x_+ - x_-) / (2 dt),
// a = (x_+ - 2 x + x_-) / dt². Of a recording with more than 40 000 rows, equal parts of it are used, none of fewer than 200 frames (or
// all there are), and if these are still too many, every second, third, ... individual; the others remain as neighbours.
class ForceDesign {
 public:
  struct Run {
    Index first, count;  // rows of one individual, a frame apart
  };

  ForceDesign(const Tracks& tracks, const ForceBasis& basis);

  Index rows() const { return acceleration_[0].size(); }
  const std::vector<Run>& runs() const { return runs_; }
  const Eigen::VectorXd& acceleration(int axis) const { return acceleration_[static_cast<std::size_t>(axis)]; }
  const Eigen::MatrixXd& terms(int axis) const { return terms_[static_cast<std::size_t>(axis)]; }  // rows × coefficients

 private:
  std::vector<Run> runs_;
  std::array<Eigen::VectorXd, 3> acceleration_;
  std::array<Eigen::MatrixXd, 3> terms_;
};

}  // namespace swarmfit
