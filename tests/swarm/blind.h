// SPDX-License-Identifier: MIT
#pragma once

#include "libswarm/model.h"
#include "libswarm/noise.h"

namespace swarmfit::test {

// Knows of nothing and jumps about.
struct Blind : Model {
  Step step(const State& now, State& next, const World& world, const StepContext& c) const override {
    for (Index i = 0; i < now.size(); ++i) {
      const std::uint32_t id = now.id[static_cast<std::size_t>(i)];
      next.vel.row(i) = 3 * random_direction(c.rng, Stream::noise, c.tick, id, 0, world.dims).transpose();
      next.pos.row(i) = now.pos.row(i) + c.dt * next.vel.row(i);
    }
    return Step::done;
  }
};

}  // namespace swarmfit::test
