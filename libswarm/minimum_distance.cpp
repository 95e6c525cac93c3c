// SPDX-License-Identifier: MIT
#include "libswarm/minimum_distance.h"

#include "libswarm/noise.h"
#include "libswarm/parallel.h"

namespace swarmfit {

using Eigen::Array3d;

std::uint64_t enforce(const MinimumDistance& distance, State& state, const World& world, const StepContext& c) {
  c.near.build(state.pos, world.bounds, distance.least);
  const auto cell_of = [&](Index i) { return Array3d((state.pos.row(i).transpose() / distance.cell).floor()); };
  Rows push = Rows::Zero(state.size(), 3);
  std::vector<std::uint8_t> moved(static_cast<std::size_t>(state.size()), 0);
  for_each_agent(state.size(), [&](Index i, std::size_t) {
    const std::uint32_t id = state.id[static_cast<std::size_t>(i)];
    Array3d sum = Array3d::Zero();
    c.near.visit(i, [&](Index j, const Array3d& offset, double d) {
      if (distance.cell > 0 && (cell_of(i) != cell_of(j)).any()) return;
      const Array3d away =
          d > 0 ? Array3d(offset / -d) : parting_direction(c.rng, c.tick, id, state.id[static_cast<std::size_t>(j)], world.dims);
      sum += 0.5 * (distance.least - d) * away;
      moved[static_cast<std::size_t>(i)] = 1;
    });
    push.row(i) = sum.transpose();
  });
  std::uint64_t count = 0;
  for (Index i = 0; i < state.size(); ++i) {
    if (moved[static_cast<std::size_t>(i)] == 0) continue;
    state.pos.row(i) += push.row(i);
    ++count;
  }
  return count;
}

}  // namespace swarmfit
