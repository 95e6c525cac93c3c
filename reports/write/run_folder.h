// SPDX-License-Identifier: MIT
// The folder of a run: whose it is, how it begins, whether it is complete.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace swarmfit {

// May a run write here? Yes if `dir` does not exist, is empty, or holds an earlier run (a config.toml of ours); that run is then
// replaced. Throws InputError otherwise. Cheap: call it before hours of computing.
void check_run_directory(const std::string& dir);

// Turns `dir` into the folder of a run that has not finished: config.toml, and no results of an earlier one. Throws as above, and RunError.
void begin_run(const std::string& dir, const std::string& config);

// The command of the run that was begun in `dir` and has not finished. Throws InputError if there is none.
std::string unfinished_run(const std::string& dir);

// Throws InputError unless `dir` holds a run that has finished, of whatever command.
void require_finished_run(const std::string& dir);

// Everything needed to repeat a run: under the command's own heading, "name = value" lines, values being TOML already.
using Settings = std::vector<std::pair<std::string, std::string>>;
std::string config_toml(const std::string& command, const Settings& settings);

// The folder of a study that computes first and writes then: config.toml, tables/, and no results of an earlier run. Throws as begin_run.
void begin_study(const std::string& dir, const std::string& command, const Settings& settings);

// Removes what a kill left in `dir` of files that were being written.
void remove_torn(const std::string& dir);

}  // namespace swarmfit
