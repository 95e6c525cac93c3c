// SPDX-License-Identifier: MIT
#pragma once

#include "fit/experiment/plant.h"
#include "fit/results/scenery.h"
#include "libswarm/walls.h"

namespace swarmfit {

// Of a scene that was filmed: obstacles, the arena, stimuli and goals. Boxes end where the arena does.
Scenery scenery_of(const Scenario& scene, const Film& made);

// Of an arena with obstacles in which these individuals move.
Scenery scenery_of(const Bounds& bounds, const std::vector<Obstacle>& obstacles, const Tracks& tracks);

// All bodies with flat faces, balls among them.
std::vector<Polyhedron> bodies_of(const Scenery& scenery, int dims);

}  // namespace swarmfit
