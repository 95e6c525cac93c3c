// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace swarmfit {

// The manual page of a model: the comment that opens libswarm/models/NAME.cpp, comment signs included, built in by cmake/manuals.cmake as
// the library model_manuals. Empty for a name without a file.
std::string_view model_comment(std::string_view name);

}  // namespace swarmfit
