// SPDX-License-Identifier: MIT
// A sweep: simulations over a grid or a Latin hypercube of settings, several seeds per cell, each measured where it is made. What a phase
// diagram is drawn from.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "fit/experiment/ensemble.h"
#include "fit/study/recovery.h"
#include "libeval/group/measured.h"
#include "libswarm/scenario/scenario.h"

namespace swarmfit {

// What is varied along one axis: numbers, or the words that an option of the model takes.
struct SweepAxis {
  std::string name;
  std::vector<double> value;       // of numbers ascending, of words 0, 1, ...
  std::vector<std::string> words;  // as they were given, or the shortest text of the number
  bool log = false;                // evenly spaced logarithms
  bool numeric = true;
  bool whole = false;  // of a Latin hypercube: whole numbers only
};
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

// One simulation, or one stage of an up-and-down sweep.
struct SweepRun {
  std::uint64_t seed = 0;
  bool blew_up = false;
  std::vector<double> means;  // of the order parameters over the frames after the warm-up; NaN where undefined
  std::string state;          // key of the last window's; empty if it blew up
};
inline auto fields(SweepRun& r) {  // as bytes (fit/store/bytes.h)
  return std::tie(r.seed, r.blew_up, r.means, r.state);
}

struct SweepCell {
  std::vector<double> place;       // per axis
  std::vector<std::string> words;  // per axis
  bool down = false;               // of the way back of an up-and-down sweep
  std::vector<SweepRun> runs;
  std::vector<double> mean, sd;  // over the runs, per order parameter; NaN where no run, or fewer than two, have it
  std::string state;             // of most runs, the first in the alphabet among equals; empty if all blew up
  double share = 0;              // of the runs that agree
};

struct Sweep {
  std::string model;  // canonical name, without what is swept
  std::vector<SweepAxis> axes;
  std::vector<const OrderParameter*> what;
  std::vector<SweepCell> cells;  // a grid: first axis fastest; up-and-down: all cells of the way up, then of the way down
  bool latin = false, hysteresis = false;
  int seeds = 0;
};

using OnSweep = std::function<void(std::size_t done, std::size_t all)>;  // runs

// Same bits for any number of threads. Throws InputError as scene_at, and Interrupted. A part's result is of no use (Part).
Sweep run_sweep(const SweepOptions& options, const OnSweep& on_progress = {}, const Runtime& runtime = {}, const Part& part = {});

}  // namespace swarmfit
