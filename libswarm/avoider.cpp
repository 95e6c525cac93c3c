// SPDX-License-Identifier: MIT
#include "libswarm/avoider.h"

#include <cmath>

#include "libswarm/noise.h"
#include "libswarm/parallel.h"

namespace swarmfit {

using Eigen::Array3d;
using Eigen::Vector3d;

Infeasible parse_infeasible(std::string_view name) {
  if (name == "substep") return Infeasible::substep;
  return name == "zero" ? Infeasible::zero : Infeasible::min_penetration;
}

Avoider::Avoider(int dims, Infeasible infeasible) : dims_(dims), infeasible_(infeasible), threads_(agent_threads()) {}

void Avoider::begin(const State& now, const Bounds& bounds, const Limits& limits) {
  limits_ = limits;
  around_.build(now.pos, bounds, limits.range);
  hint_.resize(static_cast<std::size_t>(now.size()), 0.0);
  for (auto& thread : threads_) thread.infeasible = 0;
}

void Avoider::forbid(const State& now, Index i, std::span<const Neighbours::Found> found, const StepContext& c, PerThread& mine) const {
  const Index self = around_.slot(i);
  const Vector3d own = now.vel.row(i).transpose().matrix();
  mine.near.resize((found.size() + 3) / 4);
  mine.allowed.resize(found.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    const Index j = around_.row(found[k].slot);
    const Array3d offset = around_.offset(self, found[k].slot);
    for (Index axis = 0; axis < 3; ++axis) {
      mine.near[k / 4].offset[axis][k % 4] = offset[axis];
      mine.near[k / 4].relative[axis][k % 4] = own[axis] - now.vel(j, axis);
    }
  }
  reciprocal_half_spaces(mine.near.data(), found.size(), own, 2 * limits_.radius, limits_.time_horizon, c.dt, mine.allowed.data());
  // Those at the same place, who come first: they leave each other in a direction that is drawn.
  for (std::size_t k = 0; k < found.size() && found[k].distance2 == 0; ++k) {
    const Index j = around_.row(found[k].slot);
    if (!(now.pos.row(i) == now.pos.row(j)).all()) continue;
    const Vector3d relative = own - now.vel.row(j).transpose().matrix();
    const Array3d tie = parting_direction(c.rng, c.tick, now.id[static_cast<std::size_t>(i)], now.id[static_cast<std::size_t>(j)], dims_);
    mine.allowed[k] = reciprocal_half_space(around_.offset(self, found[k].slot).matrix(), own, relative, 2 * limits_.radius,
                                            limits_.time_horizon, c.dt, tie.matrix());
  }
}

Array3d Avoider::velocity(const State& now, Index i, const Array3d& preferred, const StepContext& c, std::size_t thread) {
  PerThread& mine = threads_[thread];
  const auto most = static_cast<std::size_t>(std::lround(limits_.neighbours));
  forbid(now, i, around_.nearest(i, most, limits_.range, hint_[static_cast<std::size_t>(i)], mine.nearest), c, mine);
  const auto flat = [this](const Vector3d& v) { return dims_ == 2 ? Array3d(v[0], v[1], 0) : Array3d(v.array()); };
  const auto result = nearest_velocity(mine.allowed, preferred.matrix(), limits_.max_speed);
  if (result.feasible) return flat(result.velocity);
  ++mine.infeasible;
  if (infeasible_ != Infeasible::min_penetration) return Array3d::Zero();
  return flat(least_penetration(mine.allowed, preferred.matrix(), limits_.max_speed, mine.scratch));
}

Step Avoider::end(const StepContext& c) const {
  std::uint64_t infeasible = 0;
  for (const auto& thread : threads_) infeasible += thread.infeasible;
  if (infeasible > 0 && infeasible_ == Infeasible::substep && c.can_halve) return Step::halve_dt;
  c.count.infeasible_avoidance += infeasible;
  return Step::done;
}

}  // namespace swarmfit
