// SPDX-License-Identifier: MIT
// Where individuals went, coloured by time.
#pragma once

#include "libtrack/tracks.h"
#include "reports/draw/svg.h"

namespace swarmfit::plot {

// What is seen of the x-y plane [unit].
struct Window {
  double x = 0, y = 0, half = 1;  // centre, half the side
};

// Holds all of these tracks; of motion that has an extent.
Window window_of(const std::vector<const Tracks*>& all);

// From above, in the frame of the box, early dark and late light; a gap breaks a path. Thinned to some thousand points.
void draw_paths(svg::Sheet& sheet, const svg::Box& box, const Tracks& tracks, const Window& window);

}  // namespace swarmfit::plot
