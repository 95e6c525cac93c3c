// SPDX-License-Identifier: MIT
#include "libswarm/force_design.h"

#include <algorithm>
#include <cmath>

#include "libswarm/symmetric_differences.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

class Terms {
 public:
  Terms(const ForceBasis& basis, std::array<Eigen::MatrixXd, 3>& out) : basis_(basis), out_(out) {
    for (std::size_t g = 0; g < kForceGroups; ++g) first_[g] = static_cast<Index>(basis.first(static_cast<ForceGroup>(g)));
  }

  void alone(Index row, const Array3d& place, const Array3d& v) {
    const Array3d x = place - basis_.centre;
    const double speed = std::min(std::sqrt(v.square().sum()), basis_.top_speed);
    const double distance = std::min(std::sqrt(x.square().sum()), basis_.reach);
    add(row, ForceGroup::drag, 0, v);
    add(row, ForceGroup::speed_drag, 0, speed * v);
    add(row, ForceGroup::speed_drag, 1, speed * speed * v);
    add(row, ForceGroup::hardening, 0, distance * distance * x);
    for (int axis = 0; axis < basis_.dims; ++axis) {
      Array3d along = Array3d::Zero();
      along[axis] = 1;
      add(row, ForceGroup::confinement, static_cast<std::size_t>(axis), along * x);
      add(row, ForceGroup::push, static_cast<std::size_t>(axis), along);
    }
  }

  // Another, that far away and with that difference of velocities.
  void pair(Index row, const Array3d& away, const Array3d& difference) {
    const double distance = std::sqrt(away.square().sum());
    const auto [first, weight, next] = basis_.hat(distance);
    if (!(distance > 0) || (weight == 0 && next == 0)) return;
    const auto kernel = [&](std::size_t k, double by) {
      add(row, ForceGroup::pair, k, by / distance * away);
      add(row, ForceGroup::alignment, k, by * difference);
    };
    kernel(first, weight);
    if (next > 0) kernel(first + 1, next);
  }

 private:
  void add(Index row, ForceGroup group, std::size_t k, const Array3d& value) {
    const Index column = first_[static_cast<std::size_t>(group)] + static_cast<Index>(k);
    for (int axis = 0; axis < basis_.dims; ++axis) out_[static_cast<std::size_t>(axis)](row, column) += value[axis];
  }

  const ForceBasis& basis_;
  std::array<Eigen::MatrixXd, 3>& out_;
  std::array<Index, kForceGroups> first_{};
};

}  // namespace

RegressionDesign force_design(const Tracks& tracks, const ForceBasis& basis) {
  const SymmetricDifferences seen(tracks);
  RegressionDesign out(seen, static_cast<Index>(basis.size()));
  Terms terms(basis, out.terms);
  for (std::size_t u = 0; u < seen.rows().size(); ++u) {
    const Index row = seen.rows()[u], equation = static_cast<Index>(u);
    const Array3d x = seen.x(row), v = seen.v(row);
    terms.alone(equation, x, v);
    if (basis.kernel_size() == 0) continue;
    const FrameRange& frame = seen.frame_of(row);
    for (Index other = frame.first; other < frame.first + frame.count; ++other)
      if (other != row) terms.pair(equation, seen.x(other) - x, seen.whole(other) ? Array3d(seen.v(other) - v) : Array3d::Zero());
  }
  return out;
}

}  // namespace swarmfit
