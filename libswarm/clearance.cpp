// SPDX-License-Identifier: MIT
#include "libswarm/clearance.h"

#include <algorithm>
#include <cmath>

namespace swarmfit {
namespace {

using Eigen::Array3d;
using Eigen::Index;

constexpr double kCells = 16;     // along the longest side
constexpr double kSlack = 1e-12;  // of the longest side: rounding

}  // namespace

Clearance::Clearance(const Array3d& lower, const Array3d& upper, const std::function<double(const Array3d&)>& distance)
    : lower_(lower), upper_(upper), cell_((upper - lower).maxCoeff() / kCells), slack_(kSlack * (upper - lower).maxCoeff()) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double side = upper[static_cast<Index>(axis)] - lower[static_cast<Index>(axis)];
    count_[axis] = std::max<Index>(1, static_cast<Index>(std::ceil(side / cell_)));
  }
  distance_.reserve(static_cast<std::size_t>(count_[0] * count_[1] * count_[2]));
  for (Index k = 0; k < count_[2]; ++k)
    for (Index j = 0; j < count_[1]; ++j)
      for (Index i = 0; i < count_[0]; ++i)
        distance_.push_back(
            distance(lower_ + cell_ * (Array3d(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)) + 0.5)));
}

double Clearance::at(const Array3d& place) const {
  const Array3d beyond = (lower_ - place).max(place - upper_).max(0);
  const double outside = std::sqrt(beyond.square().sum());
  if (distance_.empty() || outside > 0) return std::max(0.0, outside - slack_);
  std::array<Index, 3> cell{};
  Array3d from = place - lower_;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<Index>(axis);
    cell[axis] = std::min(static_cast<Index>(from[a] / cell_), count_[axis] - 1);
    from[a] -= cell_ * (static_cast<double>(cell[axis]) + 0.5);
  }
  const double there = distance_[static_cast<std::size_t>(cell[0] + count_[0] * (cell[1] + count_[1] * cell[2]))];
  const double sure = std::max(0.0, std::abs(there) - std::sqrt(from.square().sum()) - slack_);
  return there < 0 ? -sure : sure;
}

}  // namespace swarmfit
