// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace swarmfit::cli {

// The JSON schema (draft 7) of scenario files, for editors that check TOML by one: every key of scenario_keys() and no other.
std::string scenario_schema();

}  // namespace swarmfit::cli
