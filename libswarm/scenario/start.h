// SPDX-License-Identifier: MIT
#pragma once

#include "libswarm/scenario/scenario.h"

namespace swarmfit {

// With centre and radius filled in where the bounds decide them.
Start settled(const Start& start, const Bounds& bounds, int dims);

// Place and velocity of agent `id`, the k-th of n that start so. A pure function of the seed and its arguments.
struct Beginning {
  Eigen::Array3d pos, vel;
};
Beginning beginning(const Start& settled, const Rng& rng, std::uint32_t id, Index k, Index n, int dims);

}  // namespace swarmfit
