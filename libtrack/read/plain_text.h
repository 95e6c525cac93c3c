// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace swarmfit {

// The unpacked bytes of a file as readers want them: UTF-16 with a mark as UTF-8, lines ended by '\n' where '\r' alone does it, without
// DOS's end of file. Bytes that are no text stay as they are.
std::string plain_bytes(std::string bytes);

}  // namespace swarmfit
