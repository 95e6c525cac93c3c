// SPDX-License-Identifier: MIT
// config.toml: what a run's settings are, written so that they read back the same.
#pragma once

#include <string>
#include <vector>

#include "cli/setting.h"
#include "reports/write/run_folder.h"

namespace swarmfit::cli {

std::string toml_string(const std::string& text);
std::string toml_array(const std::vector<std::string>& texts);

// Every setting of the command that travels and has a value, in the order of the table. Throws InputError on text that no TOML file can
// hold: it must be UTF-8.
Settings config_of(Commands command, const Values& values);
Settings with(Settings config, std::string_view name, const std::string& toml);  // another value for a name that is there

// What the file says under the command's heading, unchecked but for its form. Throws InputError "file:line:column: ..." on anything that is
// not TOML, not a setting of this command, or under no heading.
Values read_config(const std::string& path, const std::string& text, const Command& command);

// Do two texts of config.toml say the same? Earlier versions wrote some settings in another order.
bool same_config(const std::string& one, const std::string& other);

}  // namespace swarmfit::cli
