// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "libtrack/curve.h"

namespace swarmfit {

struct DrawnCurve {
  Curve curve;
  bool in_units = false;  // its numbers are lengths of the recording, as in a CSV; otherwise only its shape counts
};

// "heart", "star", or a file: CSV with a point x,y or x,y,z in each line, or the first polyline, polygon or path of straight lines (M, L,
// H, V, Z) of an SVG picture, whose y points down and is turned up. Closed if the picture says so, or if it ends where it begins. Throws
// InputError with the place in the file.
DrawnCurve read_curve(const std::string& name);

}  // namespace swarmfit
