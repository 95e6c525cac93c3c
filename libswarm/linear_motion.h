// SPDX-License-Identifier: MIT
// Models whose agents move independently, linearly and with normal noise: those have a likelihood in closed form.
#pragma once

#include <array>

#include "libswarm/linear_noise.h"

namespace swarmfit {

// Every component of y = (x, v, hidden) by itself, x being relative to the swarm's centre (libswarm/centre.h): dy = drift y dt + noise dW.
struct LinearMotion {
  LinearNoise<3>::Matrix drift{};
  std::array<double, 3> noise{};
  // What an agent brings along and no recording shows, given where it enters and how fast: hidden_on · (x, v) + hidden_sd · (a normal
  // number).
  std::array<double, 2> hidden_on{};
  double hidden_sd = 0;
};

}  // namespace swarmfit
