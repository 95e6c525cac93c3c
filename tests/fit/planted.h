// SPDX-License-Identifier: MIT
// Small planted recordings that several tests of fit/ share.
#pragma once

#include "fit/experiment/plant.h"

namespace swarmfit::test {

// A midge-like swarm in mm made by a model with known parameters; a few animals, a second of film.
inline PlantOptions small_swarm(std::uint64_t seed) {
  PlantOptions o;
  o.agents = 10;
  o.frames = 120;
  o.dt = 0.01;
  o.warm_up = 100;
  o.start_radius = 120;
  o.start_speed = 200;
  o.seed = seed;
  o.unit = "mm";
  return o;
}

inline std::map<std::string, double> midge_parameters() {
  return {{"gamma", 0.01},      {"noise", 1600}, {"scale", 60}, {"chi_rep", 400}, {"r_rep", 60},       {"chi_att", 900},
          {"r_att", 400},       {"chi_ali", 0},  {"r_ali", 0},  {"radius", 4},    {"max_speed", 5000}, {"neighbour_distance", 80},
          {"time_horizon", 0.2}};
}

inline Tracks planted_swarm(std::uint64_t seed, double sigma = 0, double dropout = 0) {
  const auto model = parse_model("bswarm");
  auto o = small_swarm(seed);
  o.sigma = sigma;
  o.dropout = dropout;
  return plant(model, scene_parameters(model, midge_parameters()), o);
}

}  // namespace swarmfit::test
