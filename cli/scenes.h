// SPDX-License-Identifier: MIT
// Scenarios as the program knows them: by name, by file, or as a model alone.
#pragma once

#include <string>
#include <string_view>

#include "cli/arguments.h"
#include "fit/experiment/plant.h"
#include "libswarm/scenario/read.h"
#include "reports/recording/model_card.h"
#include "reports/write/list_text.h"

namespace swarmfit::cli {

const ScenarioFile& scenario_file(std::string_view name);  // throws InputError naming those that there are
Scenario scenario_named(std::string_view name);

// What simulate is asked for, with all that is to be otherwise. Throws InputError.
Scenario scenario_of(const SceneArguments& a);

// Where the model learns from a recording, that of this name: demo or a file.
void learn_from(Scenario& scene, const std::string& recording);

// Has a model alone led along the curve of that name, with the paper's weights. Throws InputError if it cannot be.
void lead_along(Scenario& scene, const SceneArguments& a);

// How well the agents of a scene with a curve drew it, in a sentence.
std::string drawn_text(const Scenario& scene, const Tracks& agents);

ModelCard card_of(const Scenario& scene);
ListEntry scenario_entry(const Scenario& scene);

// The scenario that shows what a model is known for; its own name, which stands for it alone in a box, if there is none.
std::string scene_showing(std::string_view model);

}  // namespace swarmfit::cli
