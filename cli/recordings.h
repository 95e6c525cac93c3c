// SPDX-License-Identifier: MIT
// The recordings a command works on.
#pragma once

#include <string>

#include "cli/arguments.h"

namespace swarmfit::cli {

// Of a file, "-" or "demo": read, of one kind of individuals if one is named, and cleaned.
Tracks load(const Arguments& how, const std::string& path);

}  // namespace swarmfit::cli
