// SPDX-License-Identifier: MIT
// The recordings a command works on.
#pragma once

#include <string>

#include "libtrack/read/read.h"

namespace swarmfit::cli {

Tracks load(const ReadOptions& options, const std::string& path);  // a file, "-" or "demo"

}  // namespace swarmfit::cli
