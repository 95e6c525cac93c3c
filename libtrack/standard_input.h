// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace swarmfit {

// All bytes of standard input, from wherever they come. Throws as read_file(): also InputError when a pipe does not end before an eighth of
// this machine's memory is full.
std::string read_standard_input();

}  // namespace swarmfit
