// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "libtrack/read/raw_table.h"

namespace swarmfit {

// What stands in a container that swarmfit itself has written (libtrack/write/own_columns.h), by name; scalars are vectors of one.
struct OwnParts {
  std::map<std::string, std::vector<double>> numbers;
  std::map<std::string, std::vector<std::string>> texts;
};

constexpr const char* kOwnMark = "swarmfit";  // names the layout

// Throws InputError where it does not hold together.
RawTable own_table(const std::string& file, OwnParts parts);

}  // namespace swarmfit
