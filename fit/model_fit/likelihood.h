// SPDX-License-Identifier: MIT
// Maximum likelihood, where a model has one in closed form (ModelSpec::linear): the Kalman filter (Kalman 1960, doi:10.1115/1.3662552;
// Durbin and Koopman, Time Series Analysis by State Space Methods, 2nd ed. 2012, chapters 4 and 7). It uses every correlation in time that
// the recording has, where the metrics see distributions over a few frames.
#pragma once

#include <optional>
#include <vector>

#include "fit/experiment/conditions.h"
#include "fit/model_fit/search_space.h"
#include "libswarm/linear_motion.h"

namespace swarmfit {

// The natural logarithm of the likelihood of all tracks, each component by itself, given the first two positions of each: velocities are
// not known before. Gaps are bridged exactly. sd: of what measurement adds to positions, per axis [unit]. -inf where the model is no model.
double log_likelihood(const Tracks& recording, const LinearMotion& motion, const Eigen::Array3d& sd);

// Of one parameter, in physical units; the ends of the 95 % interval are NaN where the maximum lies on a bound.
struct MostLikely {
  std::size_t row;  // of the parameter table
  double value, lower, upper;
};

struct MaximumLikelihood {
  double log_likelihood;
  std::vector<MostLikely> parameters;  // those that are searched, in table order
  double error;  // localisation error, in the mean over the axes [unit]: fitted, too; its ratios between axes are those estimated
};

// Nothing for models without a likelihood, and where there is nothing to search. Searches from `start`, the middle of the bounds and a few
// more points; intervals are Wald's, from the curvature at the maximum on the axes of the search. They take the model for true.
std::optional<MaximumLikelihood> maximum_likelihood(const SearchSpace& space, const Conditions& conditions, const Point& start,
                                                    const Rng& rng);

}  // namespace swarmfit
