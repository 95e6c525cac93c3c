// SPDX-License-Identifier: MIT
// A TOML file as plain values that know their place.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace swarmfit {

struct Node {
  using Array = std::vector<Node>;
  using Entries = std::vector<std::pair<std::string, Node>>;  // in the order of the file

  std::variant<std::monostate, bool, std::int64_t, double, std::string, Array, Entries> value;  // monostate: dates and times
  long line = 0, column = 0;
};

// Throws InputError "file:line:column: ..." on what is no TOML.
Node parse_toml(const std::string& path, const std::string& text);

}  // namespace swarmfit
