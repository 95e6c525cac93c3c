// SPDX-License-Identifier: MIT
#include "libswarm/force_law.h"

#include <algorithm>

namespace swarmfit {

std::string to_string(ForceGroup group) {
  switch (group) {
    case ForceGroup::drag:
      return "drag";
    case ForceGroup::speed_drag:
      return "drag that depends on speed";
    case ForceGroup::confinement:
      return "confinement";
    case ForceGroup::hardening:
      return "confinement that depends on distance";
    case ForceGroup::push:
      return "constant push";
    case ForceGroup::pair:
      return "forces between pairs";
    case ForceGroup::alignment:
      return "alignment of pairs";
  }
  return {};
}

std::size_t ForceBasis::count(ForceGroup group) const {
  switch (group) {
    case ForceGroup::drag:
    case ForceGroup::hardening:
      return 1;
    case ForceGroup::speed_drag:
      return 2;
    case ForceGroup::confinement:
    case ForceGroup::push:
      return static_cast<std::size_t>(dims);
    case ForceGroup::pair:
    case ForceGroup::alignment:
      return kernel_size();
  }
  return 0;
}

std::size_t ForceBasis::first(ForceGroup group) const {
  std::size_t sum = 0;
  for (std::size_t g = 0; g < static_cast<std::size_t>(group); ++g) sum += count(static_cast<ForceGroup>(g));
  return sum;
}

ForceBasis::Hat ForceBasis::hat(double distance) const {
  if (knots.empty() || !(distance < knots.back())) return {};
  if (distance <= knots.front()) return {0, 1, 0};
  const auto above = static_cast<std::size_t>(std::upper_bound(knots.begin(), knots.end(), distance) - knots.begin());
  const double along = (distance - knots[above - 1]) / (knots[above] - knots[above - 1]);
  return {above - 1, 1 - along, above < kernel_size() ? along : 0};
}

double ForceLaw::drag(double speed) const {
  const double s = std::min(speed, basis.top_speed);
  return -(at(ForceGroup::drag) + s * (at(ForceGroup::speed_drag, 0) + s * at(ForceGroup::speed_drag, 1)));
}

double ForceLaw::confinement(double distance) const {
  const double d = std::min(distance, basis.reach);
  double sum = 0;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(basis.dims); ++axis) sum += at(ForceGroup::confinement, axis);
  return -(sum / basis.dims + d * d * at(ForceGroup::hardening));
}

double ForceLaw::kernel(ForceGroup group, double distance) const {
  const auto [first, weight, next] = basis.hat(distance);
  if (weight == 0 && next == 0) return 0;
  return weight * at(group, first) + (next > 0 ? next * at(group, first + 1) : 0);
}

}  // namespace swarmfit
