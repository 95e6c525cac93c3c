// SPDX-License-Identifier: MIT
// Simulations in simulation units, as `simulate` and the gallery make them.
#pragma once

#include <string>
#include <vector>

#include "cli/arguments.h"
#include "libswarm/model.h"
#include "libtrack/tracks.h"
#include "reports/recording/model_card.h"

namespace swarmfit::cli {

struct Scene {
  ModelChoice model;
  std::vector<double> parameters;
  Tracks tracks;
};
Scene simulated(const SceneArguments&);
Scene along_curve(const SceneArguments&);  // with a note of how well

ModelCard card_of(const Scene&);

// What shows best what a model is known for, in few frames; the defaults for models that need no help.
SceneArguments scene_of(const std::string& model);
// The same as flags of `simulate`, for another number of frames if one is given.
std::string scene_flags(const std::string& model, std::int64_t frames = 0);

}  // namespace swarmfit::cli
