// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace swarmfit {

// One line of `swarmfit models`, `scenarios` or `formats`.
struct ListEntry {
  std::string name, summary;
  std::vector<std::pair<std::string, std::string>> facts;  // further lines: ("options", "noise=curl|white"), ("source", ...)
};

}  // namespace swarmfit
