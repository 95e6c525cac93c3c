// SPDX-License-Identifier: MIT
// A made-up comparison with plausible numbers: no simulation behind it, every field filled, the same bits every time.
#pragma once

#include <string>
#include <vector>

#include "fit/results/comparison.h"

namespace swarmfit {

// What the sample invents a model from.
struct Sketch {
  std::string name;
  double score, score_se;
  double stretch;  // of its distributions against the recording's
};

Comparison sample_comparison(const std::vector<Sketch>& models);
Comparison sample_comparison();  // five models, a clear winner, two metrics left out
Comparison sample_at_lags();     // the same at lags 1, 4 and 16, frames of 0.01 s; lag 16 carries most of the weight

}  // namespace swarmfit
