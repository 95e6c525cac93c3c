// SPDX-License-Identifier: MIT
// Scenario files: docs/scenarios.md says what may stand in one.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "libswarm/scenario/scenario.h"

namespace swarmfit {

// Throws InputError "file:line:column: what is wrong; what was expected". `path` is how errors call the file, and without folder and
// ending the scenario's name.
Scenario read_scenario(const std::string& path, const std::string& text);

// A file of scenarios/, built in by cmake/scenarios.cmake as the library scenario_files.
struct ScenarioFile {
  std::string_view name, text;
};
std::span<const ScenarioFile> scenario_files();  // by name

// The meshes that lie there, by name with their ending.
std::span<const ScenarioFile> scenario_meshes();

}  // namespace swarmfit
