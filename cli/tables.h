// SPDX-License-Identifier: MIT
// The parts of the table of settings, in the order in which they are put together.
#pragma once

#include <vector>

#include "cli/setting.h"

namespace swarmfit::cli {

inline constexpr double kMostRecordings = 10'000;  // that a study makes with a model

std::vector<Setting> data_settings();        // what a command works on, and how that is read
std::vector<Setting> run_settings();         // how a command runs
std::vector<Setting> scene_settings();       // what is simulated and filmed
std::vector<Setting> measure_settings();     // what is measured of a group
std::vector<Setting> synthesis_settings();   // what is simulated among recorded tracks
std::vector<Setting> comparison_settings();  // how models are fitted and compared
std::vector<Setting> output_settings();      // what is written where

}  // namespace swarmfit::cli
