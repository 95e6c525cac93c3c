// SPDX-License-Identifier: MIT
// Square maps of many small cells, for small multiples: a few colours, one path each, so that a page may hold dozens.
#pragma once

#include <string>
#include <vector>

#include "reports/draw/svg.h"

namespace swarmfit::plot {

// sequential: lower to upper, dark to light; diverging: blue below the middle, orange above, pale between. Both survive colour blindness.
enum class Scheme { sequential, diverging };

struct MapScale {
  double lower = 0, upper = 1;  // values beyond have the colours of the ends
  Scheme scheme = Scheme::sequential;
};

// side × side values, row by row from below; NaN stays grey.
void draw_square_map(svg::Sheet& sheet, const svg::Box& box, const std::vector<double>& value, std::size_t side, const MapScale& scale);

// Upright, with labels to its right and a title above.
void draw_colour_bar(svg::Sheet& sheet, const svg::Box& box, const MapScale& scale, const std::string& title);

}  // namespace swarmfit::plot
