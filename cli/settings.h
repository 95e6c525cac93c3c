// SPDX-License-Identifier: MIT
// From words of the command line to options of the rooms. Every function throws InputError naming the flag.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "cli/arguments.h"
#include "fit/compare/compare.h"
#include "libeval/energy.h"
#include "libtrack/tracks.h"

namespace swarmfit::cli {

Tracks load(const DataArguments& data, const std::string& path);  // a file, "-" or "demo"
inline Tracks load(const DataArguments& data) { return load(data, data.path); }

// "bswarm,boids[…],…" split at the commas outside brackets, each parsed; duplicates are refused.
std::vector<ModelChoice> parse_models(const std::vector<std::string>& texts);
std::vector<ModelChoice> preset_models(const std::string& preset);

std::map<std::string, double> parse_assignments(const std::vector<std::string>& texts);  // --set
Binning binning(const std::string& normalisation, int bins, const std::string& scoring = "");
// The arguments with the choices of their protocol where the user made none of his own.
FitArguments with_protocol(FitArguments arguments);
CompareOptions compare_options(const FitArguments& arguments);

// Every flag of the command as used, name and TOML value, for config.toml.
std::vector<std::pair<std::string, std::string>> resolved(const FitArguments& arguments, const std::vector<ModelChoice>& models);

// A TOML string, and a list of them, for config.toml.
std::string quoted(const std::string& text);
std::string quoted(const std::vector<std::string>& texts);

void use_threads(const Common& common);

}  // namespace swarmfit::cli
