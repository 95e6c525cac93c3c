// SPDX-License-Identifier: MIT
// Comparisons with a name: which models --preset stands for.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "libswarm/model_spec.h"

namespace swarmfit::cli {

std::vector<std::string_view> preset_names();
std::string_view preset_help();  // "noise: ...; ablation: ...", one line
std::string preset_list();       // "noise|ablation|..."
// One of the names. as_published: under --protocol ren2016.
std::vector<ModelChoice> preset_models(const std::string& preset, bool as_published = false);
// Leaves out what is made of a recording, for studies that have none of their own.
void without_learners(std::vector<ModelChoice>& models);

}  // namespace swarmfit::cli
