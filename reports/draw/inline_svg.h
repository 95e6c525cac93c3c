// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "reports/write/html_table.h"

namespace swarmfit {

// A document of svg::Sheet as part of a page that may hold others: names within it begin with `prefix`, letters only.
Html inline_svg(const std::string& document, std::string_view prefix);

// The same on a white sheet, which scrolls where the page is narrower than the drawing.
Html sheet_of(const std::string& document, std::string_view prefix);

}  // namespace swarmfit
