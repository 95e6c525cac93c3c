// SPDX-License-Identifier: MIT
// The names of columns that pandas pickled, without unpickling.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace swarmfit {

// A list of tuples of texts, pickled by protocol 0: [("scorer", "nose", "x"), …]. Nothing is run or looked up: of the opcodes only those
// that such a list needs are known, and nothing comes back when there is another.
std::optional<std::vector<std::vector<std::string>>> pickled_names(std::string_view pickle);

}  // namespace swarmfit
