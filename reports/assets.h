// SPDX-License-Identifier: MIT
// Files that are built into the program: reports/assets/*, and Chart.js from the system's package (see assets/embed.cmake).
#pragma once

#include <string_view>

namespace swarmfit::assets {

extern const std::string_view report_html;  // the page, with {{placeholders}}
extern const std::string_view across_html;  // the page of a comparison on several recordings, likewise
extern const std::string_view report_css;
extern const std::string_view report_js;
extern const std::string_view chart_js;  // Chart.js, MIT licence

}  // namespace swarmfit::assets
