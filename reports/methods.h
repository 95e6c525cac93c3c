// SPDX-License-Identifier: MIT
// The methods of a run as text to paste: the section of its report, in another language.
#pragma once

#include <string>
#include <string_view>

namespace swarmfit {

// `page` is what report_html returns. Paragraphs, then the numbered references; empty if the page has no section of methods.
std::string methods_markdown(std::string_view page);
std::string methods_latex(std::string_view page);

}  // namespace swarmfit
