// SPDX-License-Identifier: MIT
// Models, scenarios, formats: lists for the terminal.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "reports/write/text_table.h"

namespace swarmfit {

// One line of `swarmfit models`, `scenarios` or `formats`.
struct ListEntry {
  std::string name, summary;
  std::vector<std::pair<std::string, std::string>> facts;  // further lines: ("options", "noise=curl|white"), ("source", ...)
};

std::string list_text(const std::vector<ListEntry>&, TextStyle);

}  // namespace swarmfit
