// SPDX-License-Identifier: MIT
// What a model does over a range of settings.
#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "libeval/group/measured.h"

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

}  // namespace swarmfit
