// SPDX-License-Identifier: MIT
// Plain UTF-8 text of any origin in the languages of papers, shown as text.
#pragma once

#include <string>
#include <string_view>

namespace swarmfit {

// LaTeX's special characters are escaped; Greek letters, signs and superscripts become commands; control characters "?". Letters of other
// alphabets stay as they are: pdflatex knows those of European languages, lualatex all that its font has.
std::string latex_text(std::string_view utf8);

// Characters that Markdown takes for markup have a backslash before them; control characters become "?".
std::string markdown_text(std::string_view utf8);

}  // namespace swarmfit
