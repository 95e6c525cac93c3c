// SPDX-License-Identifier: MIT
// The direction in which an agent moves, for models of agents that steer at constant speed.
#pragma once

#include "libswarm/model.h"
#include "libswarm/parallel.h"

namespace swarmfit {

// Nobody is at rest: whoever has no velocity gets a direction of its own, drawn for good.
Eigen::Array3d own_heading(const State& state, Index i, const Rng& rng, int dims);

// Those of everybody in one step, for models that look at each other's.
struct OwnHeadings : Workspace {
  Rows of;

  void take(const State& state, const Rng& rng, int dims) {
    of.resize(state.size(), 3);
    for_each_agent(state.size(), [&](Index i, std::size_t) { of.row(i) = own_heading(state, i, rng, dims).transpose(); });
  }
};

}  // namespace swarmfit
