// SPDX-License-Identifier: MIT
// Parameter recovery: recordings are made with known parameters of a model; do the intervals hold them?
#pragma once

#include "fit/model_fit/parameter_posterior.h"
#include "fit/study/recovery.h"

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
  std::string name;
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

using OnParameterCase = std::function<void(std::size_t done)>;

// options.planted is one model; options.spread is not used: true values are drawn evenly from the central 90 % of the search's axes, of
// which the intervals' prior is the whole. Draws until options.seeds recordings carry a fit, or ten times as many have not;
// a part only from the first options.seeds draws.
ParameterRecovery recover_parameters(const RecoveryOptions& options, const OnParameterCase& on_case = {}, const Runtime& runtime = {},
                                     const Part& part = {});

// Central 99 % of a binomial of n at 0.95, shared among `tests`: least and most.
std::pair<int, int> coverage_band(int n, int tests);

}  // namespace swarmfit
