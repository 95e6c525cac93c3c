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

}  // namespace swarmfit::cli
