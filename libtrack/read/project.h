// SPDX-License-Identifier: MIT
#pragma once

#include "libtrack/read/raw_table.h"

namespace swarmfit {

// Longitude (x) and latitude (y) on the WGS 84 ellipsoid become metres east and north of the recording's centre, its median position:
// the azimuthal equidistant projection, in which every position has its true distance and direction from the centre. A note tells the
// centre and how far other distances are off. Throws InputError at a position that is none on Earth. Source: C. F. F. Karney, Algorithms
// for geodesics, J. Geodesy 87:43 (2013).
void project_degrees(RawTable& table);

}  // namespace swarmfit
