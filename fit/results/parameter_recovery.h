// SPDX-License-Identifier: MIT
// Do intervals hold the parameters with which recordings were made?
#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "fit/results/axis_scale.h"
#include "fit/results/interval.h"
#include "libtrack/nan.h"

namespace swarmfit {

// One recording.
struct ParameterCase {
  std::uint64_t seed = 0;
  std::vector<double> truth;  // searched parameters, in table order, physical units
  std::vector<ParameterInterval> found;
  std::vector<double> truth_place, median_place, width;  // on the axes of the search, 0 .. 1: true value, posterior median, 95 % interval
  // Of the posterior under the prior that true values were drawn from: share below the true value, per parameter, and share nearer to a
  // random point than the truth is, for all together. Uniform on 0 .. 1 over recordings if posteriors are right; NaN: no sample there.
  std::vector<double> rank = {};
  double nearer = kNaN;
};
inline auto fields(ParameterCase& c) {  // as bytes (fit/store/bytes.h)
  return std::tie(c.seed, c.truth, c.found, c.truth_place, c.median_place, c.width, c.rank, c.nearer);
}

// One parameter over all recordings; biases and errors on the axis of the search, as a share of its range.
struct ParameterCoverage {
  std::string name, unit;               // "mm/s^2"; "" for a pure number
  AxisScale scale = AxisScale::linear;  // on which it is searched
  int recordings = 0, covered = 0;
  int identified = 0, one_sided = 0, flat = 0;  // verdicts
  double bias = 0, rmse = 0, width = 0;         // of the median: mean and root mean square of its error; mean width of the interval
  double from_uniform = kNaN;                   // largest distance of the distribution of ranks from the uniform one
};

struct ParameterRecovery {
  std::string model;
  std::vector<ParameterCase> cases;
  std::vector<ParameterCoverage> parameters;
  int left_out = 0;  // plants outside what a fit of them would search, or that carry no fit
  // Covered of so many recordings by intervals that hold the truth 95 times in 100: central 99 % of the binomial, Bonferroni.
  int fewest = 0, most = 0;
  double from_uniform = kNaN, uniform_band = kNaN;  // as of one parameter, for all together; what chance exceeds in 5 % of studies
};

}  // namespace swarmfit
