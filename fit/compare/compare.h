// SPDX-License-Identifier: MIT
// The main job: fit every model to a recording and rank them (Ren et al. 2016, algorithm Par-Est).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fit/experiment/ensemble.h"
#include "fit/model_fit/search_plan.h"
#include "fit/results/comparison.h"

namespace swarmfit {

// The plan is that of every model.
struct CompareOptions : SearchPlan {
  std::vector<ModelChoice> models;  // at least one; one model is fitted with equal weights and no calibration
  Binning binning;
  std::string protocol = "default";  // by what name the choices above are reported
  std::vector<int> lags = {1};       // of the metrics of motion [frames], ascending; empty: chosen by choose_lags (libeval/lags.h)
  double error_limit = 0.5;          // a column with a larger share of error counts only beyond what as much error again would change
  bool resolution = true;            // p2 is at least what the recording can tell (libeval/score.h); false: the range, as published
  bool mean_weights = true;          // later passes search under the mean of all passes' weights; false: under the last, as published
  std::vector<std::string> common;   // parameters that were fitted once for all models; only reported
  int bootstrap_recordings = 99;     // recordings that each fitted model makes, to tell how sure its place is; 0: none
  // Fit each half of the recording, too, and rank by the scores on the other (fit/compare/hold_out.h).
  enum class HoldOutWhen { never, worth_it, always };  // worth_it: if halves are long enough, and there is a ranking
  HoldOutWhen hold_out = HoldOutWhen::never;
  int searches = 1;                 // of each half: the best fit is ranked by, the scatter is in the intervals
  bool common_dynamics = false;     // what the models have in common is fitted once, with the first (fit/compare/common_dynamics.h)
  bool posterior = false;           // the posterior of every model's parameters, too
  bool likelihood = false;          // parameters of maximum likelihood, of models that have one
  bool regression = false;          // parameters by regression of accelerations, of models that have forces
  double weight_tolerance = 0.005;  // the calibration has settled when no weight changes by more
};

struct CompareProgress {
  std::string model;
  std::size_t index, models;  // index from 0
  int pass, passes;
  std::int64_t simulations, planned;  // of this model in this pass, those saved by giving up included; the plan may be cut short
  double best;                        // score with the pass's weights
  std::string part{};                 // of the recording that is searched; empty: the whole
};
// Called after every generation, in the thread that called compare().
using OnCompareProgress = std::function<void(const CompareProgress&)>;

// Throws Interrupted when the executor was asked to stop. What the checkpoint holds is not simulated again, and the rest is added to it.
Comparison compare(const Tracks& recording, const CompareOptions& options, const OnCompareProgress& on_progress = {},
                   const Runtime& runtime = {});

// Every row of the model's parameter table with the fitted values: what Objective and plant() take. Rows that the settings do not use are
// 0.
std::vector<double> parameter_values(const ModelChoice& model, const ModelFit& fit);

}  // namespace swarmfit
