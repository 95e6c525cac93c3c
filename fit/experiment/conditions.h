// SPDX-License-Identifier: MIT
// The recording's own conditions, under which every candidate is simulated: who was there when, where, and how well the camera saw it.
#pragma once

#include <memory>
#include <string>

#include "fit/experiment/entry.h"
#include "libeval/localisation.h"
#include "libeval/rounding.h"
#include "libswarm/model.h"
#include "libswarm/world.h"

namespace swarmfit {

// A file with [bounds] and [[obstacle]], as libswarm/scenario/surroundings.h reads them; without a path: none.
struct WorldFile {
  std::string path, text;
};

struct ConditionOptions {
  enum class Presence { recorded, constant };
  // estimate: none where the estimate is not white, since it then measures something else, or too small to show in any metric
  enum class Error { estimate, given, none };

  Presence presence = Presence::recorded;
  std::string arena = "open";  // open | box | sphere | x0:x1,y0:y1[,z0:z1]
  WorldFile world = {};        // walls where the recording was made; with bounds of its own the arena stays open
  Error error = Error::estimate;
  double sigma = 0;      // localisation error of every axis, for Error::given [unit]
  int population = 0;    // how many there really were, where only part of the group was tracked; 0: as recorded
  double smoothing = 0;  // Gaussian smoothing of both sides, standard deviation in frames
  VelocitySource velocity = VelocitySource::difference;
  bool rounding = true;  // simulated positions are rounded as the recorded ones are
  // Steps per frame of all models that are no maps; 0: as many as each needs (fit/experiment/time_step.h), kFewestSteps: as few as are
  // stable.
  int steps = 0;
  EntryVelocity entry = EntryVelocity::estimated;
};
inline constexpr int kFewestSteps = -1;

// Immutable and shared by all simulations of a fit.
struct Conditions {
  ConditionOptions options;
  Tracks recording;                               // as compared: smoothed if asked for, without the warm-up
  Scales scales;                                  // L, NND, V of the recording
  World world;                                    // arena, presence and obstacles
  Localisation localisation;                      // as estimated, whatever is used
  Eigen::Array3d sigma = Eigen::Array3d::Zero();  // localisation error put on simulated positions, per axis [unit]
  Grid grid;                                      // to which simulated positions are rounded
  MetricOptions metrics;                          // how both sides are measured
  std::int64_t first_frame = 0, frames = 0;       // that are simulated
  int unseen = 0;                                 // simulated individuals that the camera does not see
  // Of what models are told (Setup::reference), such as where the swarm stays; null: of the recording that is compared.
  std::shared_ptr<const Tracks> reference;
};

// The first `warm_up` frames are simulated, but not compared: in them a run forgets where it started.
// Throws InputError where the recording cannot carry a fit: no motion, one individual only, an arena that excludes recorded positions, or
// obstacles with more than one in a hundred of them inside.
Conditions make_conditions(const Tracks& recording, const ConditionOptions& options, std::int64_t warm_up = 0);

// Those of a part that was not fitted. Who is there, and where and how fast they enter, is its own; scales, localisation error, lags and
// what models are told of the recording were learned from the part that was: they may not know the answer.
Conditions held_out_conditions(const Tracks& held_out, const Conditions& fitted, std::int64_t warm_up = 0);

// Standard deviation of what measurement adds to positions, per axis: localisation error and rounding [unit].
Eigen::Array3d measurement_error(const Conditions& conditions);

// L, NND and V of a recording; NND is 0 when no frame has two individuals.
Scales natural_scales(const Tracks& recording);

// Parses --arena; box and sphere are fitted round the recorded positions.
Bounds parse_arena(const std::string& text, const Tracks& recording);

}  // namespace swarmfit
