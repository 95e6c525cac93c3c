// SPDX-License-Identifier: MIT
#include "libswarm/own_heading.h"

#include "libswarm/headings.h"
#include "libswarm/noise.h"

namespace swarmfit {

Eigen::Array3d own_heading(const State& state, Index i, const Rng& rng, int dims) {
  const Eigen::Array3d heading = heading_of(state.vel.row(i).transpose());
  return (heading == 0).all() ? random_direction(rng, Stream::tie_break, 0, state.id[static_cast<std::size_t>(i)], 0, dims) : heading;
}

}  // namespace swarmfit
