// SPDX-License-Identifier: MIT
#include "fit/experiment/plant.h"

namespace swarmfit {

// A laboratory swarm in round numbers: 20 individuals at some 200 mm/s, filmed at 50 Hz for eight seconds.
Tracks demo_recording() {
  const ModelChoice model = parse_model("bswarm");
  const auto parameters = scene_parameters(model, {{"gamma", 0.02},
                                                   {"noise", 0.9962 * 900},  // gain / scale is the round number
                                                   {"scale", 50},
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
  options.agents = 20;
  options.frames = 400;
  options.dt = 0.02;
  options.substeps = 2;
  options.warm_up = 250;
  options.start_radius = 120;
  options.start_speed = 200;
  options.sigma = 0.1;
  options.dropout = 0.004;
  options.seed = 20161109;
  options.unit = "mm";
  options.path = "demo";
  options.notes = {"synthetic: made by swarmfit's own bswarm with curl noise, a measurement error of 0.1 mm and missed detections"};
  return plant(model, parameters, options);
}

}  // namespace swarmfit
