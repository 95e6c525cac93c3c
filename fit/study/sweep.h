// SPDX-License-Identifier: MIT
// A sweep: simulations over a grid or a Latin hypercube of settings, several seeds per cell, each measured where it is made. What a phase
// diagram is drawn from.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "fit/experiment/ensemble.h"
#include "fit/results/sweep.h"
#include "fit/study/recovery.h"
#include "libeval/group/measured.h"
#include "libswarm/scenario/scenario.h"

namespace swarmfit {

// "name=lo:hi:n", "name=lo:hi:n:log", "name=a,b,c". Throws InputError.
SweepAxis parse_axis(const std::string& text);

// What is simulated in one cell, from a word per axis. Throws InputError on a name or a value that is not allowed.
using SceneAt = std::function<Scenario(const std::vector<std::string>&)>;

struct SweepOptions {
  std::vector<SweepAxis> axes;  // three at most in a grid
  int latin = 0;                // points of a Latin hypercube between the ends of the axes; 0: the grid
  int seeds = 5;                // runs per cell, with seeds that count up from `seed`: the same in every cell
  std::uint64_t seed = 1;
  std::int64_t every = 1;   // measured every so many frames
  bool hysteresis = false;  // along the first axis, a parameter of the model, up and down again, each cell from where the last one ended
  MeasureOptions measure;   // window 0: 200 frames
  SceneAt scene_at;
};

using OnSweep = std::function<void(std::size_t done, std::size_t all)>;  // runs

// Same bits for any number of threads. Throws InputError as scene_at, and Interrupted. A part's result is of no use (Part).
Sweep run_sweep(const SweepOptions& options, const OnSweep& on_progress = {}, const Runtime& runtime = {}, const Part& part = {});

}  // namespace swarmfit
