// SPDX-License-Identifier: MIT
// A drawing of how a group moves, for pages and manuals.
#pragma once

#include <string>

#include "fit/results/scenery.h"

namespace swarmfit {

// The individuals of the last frame as arrowheads, coloured by the direction in which they fly across the page, or by kind if there are
// several, with the paths that led there as tails that fade into the past; a scale bar in length units. Behind them obstacles, stimuli and
// goals as they are in the last frame, and a key to the colours. Motion in three dimensions is seen from above and aside, without
// perspective, the far ones paler. A gap breaks a tail. An SVG document that needs nothing beside it; `title` is for screen readers. At
// most some 400 bytes per individual. Throws InputError when there is nothing to draw.
std::string picture_svg(const Tracks& tracks, const std::string& title, const Scenery& scenery = {});

}  // namespace swarmfit
