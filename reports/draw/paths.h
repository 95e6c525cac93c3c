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

// Holds these tracks; of motion that has an extent.
Window window_of(const Tracks& tracks);
// Holds all of them and the window of the first if twice the size that the first one needs is enough; else it is of that size, about the
// first.
Window window_for(const std::vector<const Tracks*>& all);

// The share of positions that the window does not show.
double share_outside(const Tracks& tracks, const Window& window);

// From above, in the frame of the box, early dark and late light; a gap breaks a path. Thinned to some thousand points.
void draw_paths(svg::Sheet& sheet, const svg::Box& box, const Tracks& tracks, const Window& window);
// The outline of another window in that frame, dashed.
void draw_window(svg::Sheet& sheet, const svg::Box& box, const Window& shown, const Window& window);

}  // namespace swarmfit::plot
