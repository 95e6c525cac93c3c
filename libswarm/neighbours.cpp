// SPDX-License-Identifier: MIT
#include "libswarm/neighbours.h"

namespace swarmfit {

void Neighbours::build(const Rows& pos, const Bounds& bounds, double radius, Method) {
  const auto n = static_cast<std::size_t>(pos.rows());
  radius_ = radius;
  for (Index axis = 0; axis < 3; ++axis) {
    const double width = bounds.kind == Bounds::Kind::periodic ? bounds.upper[axis] - bounds.lower[axis] : 0;
    period_[axis] = width;
    half_[axis] = width > 0 ? width / 2 : std::numeric_limits<double>::infinity();
  }
  row_.resize(n);
  slot_.resize(n);
  for (auto& x : x_) x.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    row_[i] = slot_[i] = static_cast<Index>(i);
    for (std::size_t axis = 0; axis < 3; ++axis) x_[axis][i] = pos(static_cast<Index>(i), static_cast<Index>(axis));
  }
}

}  // namespace swarmfit
