// SPDX-License-Identifier: MIT
// A TOML file as plain values that know their place.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace swarmfit {

struct Node {
  using Array = std::vector<Node>;
  struct Entries {  // in the order of the file
    std::vector<std::string> keys;
    std::vector<Node> values;
  };

  std::variant<std::monostate, bool, std::int64_t, double, std::string, Array, Entries> value;  // monostate: dates and times
  long line = 0, column = 0;
};

// Throws InputError "file:line:column: ..." on what is no TOML.
Node parse_toml(const std::string& path, const std::string& text);

}  // namespace swarmfit
