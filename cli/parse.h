// SPDX-License-Identifier: MIT
// From words of the command line to options of the rooms: what the settings of the table mean. Every function throws InputError "what is
// wrong; what was expected"; whoever calls it names the flag.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cli/setting.h"
#include "libeval/energy.h"

namespace swarmfit::cli {

// "bswarm,boids[…],…" split at the commas outside brackets, each parsed; duplicates are refused.
std::vector<ModelChoice> parse_models(const std::vector<std::string>& texts);

std::map<std::string, double> parse_assignments(const std::vector<std::string>& texts);                     // parameter=value
std::map<std::string, std::map<std::string, double>> parse_planted(const std::vector<std::string>& texts);  // model.parameter=value
std::map<std::string, std::pair<double, double>> parse_bounds(const std::vector<std::string>& texts);       // parameter=lower:upper

PerIndividual parse_frames(const std::vector<std::string>& texts, std::int64_t otherwise);  // F or NAME=F

char parse_delimiter(const std::string& text);  // one character, tab or space
int parse_steps(const std::string& text);       // auto, fewest or a number, as ConditionOptions::steps has them
void set_localisation_error(ConditionOptions& conditions, const std::string& text);  // estimate, or a length

// Bins and scoring are taken from the other settings, where they are given.
Binning binning(const std::string& normalisation, const Values& others);

}  // namespace swarmfit::cli
