// SPDX-License-Identifier: MIT
#include "fit/plant.h"

namespace swarmfit {

// A laboratory midge swarm in round numbers: 16 individuals within 100 mm of their centre at some 200 mm/s, filmed at 100 Hz.
Tracks demo_recording() {
  const ModelChoice model = parse_model("bswarm");
  const auto parameters = scene_parameters(model, {{"gamma", 0.01},
                                                   {"noise", 1600},
                                                   {"scale", 60},
                                                   {"chi_rep", 400},
                                                   {"r_rep", 60},
                                                   {"chi_att", 900},
                                                   {"r_att", 400},
                                                   {"chi_ali", 0},
                                                   {"r_ali", 0},
                                                   {"radius", 4},
                                                   {"max_speed", 5000},
                                                   {"neighbour_distance", 80},
                                                   {"time_horizon", 0.2}});
  PlantOptions options;
  options.agents = 16;
  options.frames = 400;
  options.dt = 0.01;
  options.warm_up = 200;
  options.start_radius = 120;
  options.start_speed = 200;
  options.sigma = 0.4;
  options.dropout = 0.004;
  options.seed = 20161109;
  options.unit = "mm";
  options.path = "demo";
  options.notes = {"synthetic: made by swarmfit's own bswarm with curl noise, a localisation error of 0.4 mm and missed detections"};
  return plant(model, parameters, options);
}

}  // namespace swarmfit
