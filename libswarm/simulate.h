// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "libswarm/model.h"

namespace swarmfit {

// A parameter that changes over time: piecewise linear between keys, constant outside.
struct Schedule {
  std::size_t parameter;                        // row of the parameter table
  std::vector<std::pair<double, double>> keys;  // (time [s], value), times ascending
  double at(double t) const;
};

// Parameters that follow how dense the group is. Every `every` frames all of them are multiplied by the root (the third in space) of the
// density of the ellipsoid of two standard deviations over that which is wanted: by 1/4 to 4 of what they were at the start, taken
// together.
struct DensityFeedback {
  std::vector<std::size_t> parameters;  // rows of the parameter table
  double density = 1;                   // that is wanted, > 0 [1/unit³, 1/unit²]
  std::int64_t every = 1;               // >= 1
};

// What all runs of a batch share.
struct Plan {
  double frame_dt = 0.01;  // [s]
  int substeps = 1;        // steps per frame
  std::int64_t first_frame = 0;
  std::int64_t frames = 1;  // number of frames to emit, the first included
  std::vector<Schedule> schedules = {};
  std::optional<DensityFeedback> feedback = {};
  double speed_limit = 1e300;  // a run whose agents exceed it has blown up [unit/s]
};

// One run: one candidate × replicate. `state` is the start; it is advanced in place.
struct Lane {
  std::vector<double> p;  // parameter values
  Rng rng;
  State state;
  World world;
  FrameSink* out = nullptr;
  Counters count;
  bool blew_up = false;  // stopped early: motion was not finite, or beyond the speed limit
};

// Steps many lanes at once: one after the other here on the CPU, side by side on a GPU later.
struct Backend {
  virtual ~Backend() = default;
  virtual void run(const Model&, const Plan&, std::span<Lane>) const = 0;
};

const Backend& cpu_backend();

// Steps needed per frame so that no step is longer than the model's largest in this recording's time scale; one for maps.
int stable_steps(const ModelChoice&, const Scales&, double frame_dt);

}  // namespace swarmfit
