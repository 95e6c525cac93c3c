// SPDX-License-Identifier: MIT
// The recordings a command works on.
#pragma once

#include <string>

#include "libtrack/read/read.h"

namespace swarmfit::cli {

// Of a file, "-" or "demo"; of all kinds of individuals if none is named.
Tracks load(const ReadOptions& options, const std::string& path, const std::string& kind);

}  // namespace swarmfit::cli
