// SPDX-License-Identifier: MIT
// By what models were ranked, and what the ranking rests on.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "libeval/columns.h"
#include "libtrack/nan.h"

namespace swarmfit {

// One pass of the calibration loop.
struct WeightStep {
  int pass;
  PerColumn<double> searched;         // weights that its searches minimised
  PerColumn<double> weights, p1, p2;  // of the energies they found
  double largest_change;              // max |w - w before|
};

// What the columns of one lag contribute.
struct LagFacts {
  int lag = 1;                // [frames]; 0: the columns without one, d and eta
  int scored = 0;             // columns in the score
  double weight = 0;          // their weights, summed
  double error_share = kNaN;  // the largest of its columns; NaN unknown
};

// Between which bounds 95 % of the recordings made by one model lie, each bin by itself: shares of the samples. Empty: not known.
struct Band {
  PerColumn<std::vector<double>> lower{}, upper{};
};

// The ranking of the others, from the same energies, when one model is not compared.
struct LeftOut {
  std::string model;
  PerColumn<double> weights{};
  std::vector<std::pair<std::string, double>> ranking;  // names and scores, best first
  bool reordered = false;                               // two of the others change places
  bool winner_changed = false;                          // another than the first leads, the first not being the one left out
};

// What the calibration loop settled on.
struct CalibrationFacts {
  PerColumn<double> weights{}, p1{}, p2{};
  std::vector<WeightStep> weight_history{};
  bool mean_weights = true;  // each pass searches under the mean of the weights before it, else under the last
  bool weights_converged = false;
};

struct Ranking : CalibrationFacts {
  std::vector<LagFacts> lags;    // ascending, those without a lag last
  int bootstrap_recordings = 0;  // recordings made by each fitted model, behind Standing::certainty; 0: none
  Band band;                     // of the first model
  std::vector<LeftOut> without;  // per model by rank; empty for fewer than three
  bool walk_suffices = false;    // no model has more skill than the random walk, by two standard errors of both
};

}  // namespace swarmfit
