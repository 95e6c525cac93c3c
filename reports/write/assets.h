// SPDX-License-Identifier: MIT
// Files that are built into the program: reports/assets/*, and Chart.js from the system's package (see assets/embed.cmake).
#pragma once

#include <string_view>

namespace swarmfit::assets {

extern const std::string_view report_html;      // the page, with {{placeholders}}
extern const std::string_view across_html;      // the page of a comparison on several recordings, likewise
extern const std::string_view tracks_html;      // the page of one set of tracks, likewise
extern const std::string_view evaluation_html;  // the page of two sets of tracks, likewise
extern const std::string_view gallery_html;
extern const std::string_view study_html;  // the page of recover and power, likewise
extern const std::string_view report_css;
extern const std::string_view report_js;
extern const std::string_view film_js, scenery_js, stage_js, player_js;  // the player's parts, in this order
extern const std::string_view sort_js;                                   // tables that sort themselves
extern const std::string_view chart_js;                                  // Chart.js, MIT licence

}  // namespace swarmfit::assets
