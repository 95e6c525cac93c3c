// SPDX-License-Identifier: MIT
// What surrounds the individuals of a film, in a form that pictures and players draw.
#pragma once

#include <optional>
#include <vector>

#include "libtrack/polyhedron.h"
#include "libtrack/tracks.h"

namespace swarmfit {

struct Scenery {
  struct Ball {
    Eigen::Array3d centre;
    double radius;  // > 0 [unit]
  };
  using Solid = Polyhedron;
  // Something that agents fly to, or flee from.
  struct Mark {
    enum class Kind { attract, repel, goal };
    Kind kind = Kind::attract;
    double radius = 0;  // of a goal, or of the horizontal circle that each agent follows round; 0: a point [unit]
  };

  std::vector<Ball> balls = {};
  std::vector<Solid> solids = {};
  std::optional<Ball> round_arena = {};  // an arena that is a sphere or a disc
  std::vector<Mark> marks = {};
  std::optional<Tracks> seen = {};  // where the marks are, frame by frame; names of tracks are numbers of marks
  // The box that holds all of it and everybody; nothing where only agents are to be seen.
  struct Box {
    Eigen::Array3d lower, upper;
  };
  std::optional<Box> box = {};
};

}  // namespace swarmfit
