// SPDX-License-Identifier: MIT
// What may stand in a scenario file: every key once, with its type, its range and its meaning. The reader takes ranges and words from here,
// and so does the schema for editors.
#pragma once

#include <limits>
#include <span>
#include <string_view>
#include <vector>

namespace swarmfit {

// What numbers are allowed: from `lower` to `upper`, both included.
struct NumberRange {
  double lower = -1e9, upper = 1e9;
};
inline constexpr NumberRange kAnyNumber{};
inline constexpr NumberRange kNotNegative{0, 1e9};
inline constexpr NumberRange kPositive{1e-9, 1e9};
inline constexpr double kMostCounted = 1e7;  // agents, frames
inline constexpr double kForever = std::numeric_limits<double>::infinity();

struct ScenarioKey {
  enum class Type {
    text,
    choice,   // one of `words`
    number,   // within `range`
    whole,    // likewise
    place,    // [x, y, z], or [x, y] in two dimensions
    rows,     // [[...], ...], ascending in their first number
    table,    // [key]; its own keys stand under its name
    tables,   // [[key]]; likewise
    by_name,  // [key] with names of its own: numbers (parameters), rows (schedule) or tables (expect)
  };
  std::string_view of, name;  // the table it stands in; "" is the file itself
  Type type = Type::text;
  std::string_view meaning{};
  bool required = false;  // wherever its table is, whatever else that says
  NumberRange range{};
  std::vector<std::string_view> words{};
};

std::span<const ScenarioKey> scenario_keys();

// Of a table called as in errors: "[bounds]", "[[stimulus]]", "[stimulus.ring]", "". Null: there is none.
const ScenarioKey* find_scenario_key(std::string_view heading, std::string_view name);

}  // namespace swarmfit
