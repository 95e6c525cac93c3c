// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace swarmfit {

// Looks at the outer structure of a MATLAB 5 file before matio does, which reads a cut or damaged file without a word: every element must
// be known and lie within the file, and every compressed one must unpack with the right checksum. Throws InputError.
void check_mat5(const std::string& name, std::string_view bytes);

}  // namespace swarmfit
