// SPDX-License-Identifier: MIT
// What was measured of a group, drawn: SVG documents.
#pragma once

#include <string>

#include "libeval/group/measured.h"

namespace swarmfit {

// "mm²/s" of an order parameter or of an axis of a curve; empty for a pure number.
std::string powers_unit(int length, int time, const std::string& length_unit);

// Every order parameter against time, a curve per group; empty if nothing was measured.
std::string series_svg(const TrackMeta& meta, const Measured& measured);
// Every curve of the first group with bands of two standard errors; empty if there are none.
std::string group_curves_svg(const TrackMeta& meta, const MeasuredGroup& group);
// Where nearest neighbours are; empty if there are none.
std::string neighbour_map_svg(const TrackMeta& meta, const NeighbourMap& map);

}  // namespace swarmfit
