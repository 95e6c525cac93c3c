// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace swarmfit {

// One unit per character; bytes that are no UTF-8 become U+FFFD.
std::u32string to_utf32(std::string_view utf8);
std::string to_utf8(std::u32string_view text);  // characters beyond Unicode become U+FFFD

// A name that every format can hold on one line: control characters and bytes that are no UTF-8 become \x0a, blanks around it go.
std::string plain_name(std::string_view name);

}  // namespace swarmfit
