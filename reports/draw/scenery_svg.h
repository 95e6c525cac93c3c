// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "fit/results/scenery.h"
#include "reports/draw/projection.h"

namespace swarmfit {

// Colours that tell apart who sees all colours and who does not (Okabe and Ito); as those of assets/player.js.
const char* colour_of_kind(int kind);
const char* colour_of(Scenery::Mark::Kind kind);

// Bodies, the faces that the eye sees, the far ones first; a round arena; and the marks of this frame.
std::string scenery_svg(const Scenery& scenery, std::int64_t frame, int dims, const PageFrame& page);

}  // namespace swarmfit
