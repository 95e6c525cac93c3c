// SPDX-License-Identifier: MIT
// The parser of the command line, made from the tables of commands and settings.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/arguments.h"

namespace swarmfit::cli {

// What the words after the program's name ask for; nothing if that was help or the version, which are printed. Throws InputError.
std::optional<Arguments> parse(const std::vector<std::string>& words);

}  // namespace swarmfit::cli
