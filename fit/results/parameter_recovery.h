// SPDX-License-Identifier: MIT
// Do intervals hold the parameters with which recordings were made?
#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "fit/results/axis_scale.h"
#include "fit/results/interval.h"

namespace swarmfit {

// One recording.
struct ParameterCase {
  std::uint64_t seed = 0;
  std::vector<double> truth;  // searched parameters, in table order, physical units
  std::vector<ParameterInterval> found;
  std::vector<double> truth_place, median_place, width;  // on the axes of the search, 0 .. 1: true value, posterior median, 95 % interval
};
inline auto fields(ParameterCase& c) {  // as bytes (fit/store/bytes.h)
  return std::tie(c.seed, c.truth, c.found, c.truth_place, c.median_place, c.width);
}

// One parameter over all recordings; biases and errors on the axis of the search, as a share of its range.
struct ParameterCoverage {
  std::string name, unit;               // "mm/s^2"; "" for a pure number
  AxisScale scale = AxisScale::linear;  // on which it is searched
  int recordings = 0, covered = 0;
  int identified = 0, one_sided = 0, flat = 0;  // verdicts
  double bias = 0, rmse = 0, width = 0;         // of the median: mean and root mean square of its error; mean width of the interval
};

struct ParameterRecovery {
  std::string model;
  std::vector<ParameterCase> cases;
  std::vector<ParameterCoverage> parameters;
  int left_out = 0;  // plants outside what a fit of them would search, or that carry no fit
  int fewest,
      most;  // covered of so many recordings by intervals that hold the truth 95 times in 100: central 99 % of the binomial, Bonferroni
};

}  // namespace swarmfit
