// SPDX-License-Identifier: MIT
// Words from anywhere, fit to be shown.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace swarmfit {

// "a", "a and b", "a, b and c".
std::string enumerate(const std::vector<std::string>& items);

// Text of unknown origin with control characters (terminal escapes, line breaks) replaced by "?".
std::string printable(std::string_view text);

}  // namespace swarmfit
