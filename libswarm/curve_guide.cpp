// SPDX-License-Identifier: MIT
#include "libswarm/curve_guide.h"

#include <cmath>

namespace swarmfit {

using Eigen::Array3d;

void CurveGuide::next(Errand& errand) const {
  const std::size_t n = curve_->points.size();
  if (!curve_->closed && errand.key == (errand.direction > 0 ? n - 1 : 0)) errand.direction = -errand.direction;
  errand.key = (errand.key + (errand.direction > 0 ? 1 : n - 1)) % n;
}

void CurveGuide::advance(const Clock& clock, const World& world, State& state) {
  for (Index row = 0; row < state.size(); ++row) {
    const std::uint32_t id = state.id[static_cast<std::size_t>(row)];
    if (id >= errands_.size()) errands_.resize(id + 1);
    Errand& errand = errands_[id];
    const Array3d here = state.pos.row(row).transpose();
    const auto distance = [&](std::size_t key) { return std::sqrt(world.bounds.separation(here, curve_->points[key]).square().sum()); };
    if (errand.direction == 0) {
      errand.direction = clock.rng.uniform(Stream::goal, 0, id) < 0.5 ? -1 : 1;
      for (std::size_t key = 1; key < curve_->points.size(); ++key)
        if (distance(key) < distance(errand.key)) errand.key = key;
      next(errand);
    } else if (distance(errand.key) < reach_) {
      next(errand);
    }
  }
}

std::optional<Array3d> CurveGuide::goal(std::uint32_t id) const {
  if (id >= errands_.size() || errands_[id].direction == 0) return std::nullopt;
  return curve_->points[errands_[id].key];
}

}  // namespace swarmfit
