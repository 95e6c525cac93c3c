// SPDX-License-Identifier: MIT
// The same models compared on several recordings: one summary (Ren et al. 2016, Figs 10, 13 and 15).
#pragma once

#include <cmath>
#include <span>

#include "fit/results/comparison.h"

namespace swarmfit {

// A mean over recordings and its interval, Student's t at 95 %, the recording being the replicate; undefined: NaN.
struct MeanOverRecordings {
  double mean = NAN, lower = NAN, upper = NAN;
};

// One model over all recordings, in the order in which they were given.
struct ModelAcross {
  std::string model;
  std::vector<double> score;  // NaN: undefined
  std::vector<int> rank;      // 0: undefined
  double mean_score = 0;      // over the recordings where it is defined; NaN if nowhere
  double mean_rank = 0;
  int wins = 0;               // first, ties with the second included
  MeanOverRecordings lead{};  // of the first model's score over this one's, where both are defined; undefined for the first
};

struct Across {
  std::vector<std::string> recordings;                                   // paths as given
  std::vector<Column> columns = columns_at({1});                         // of any recording
  std::vector<PerColumn<double>> weights;                                // of each recording; NaN: it has no such column
  PerColumn<double> mean_weight{}, smallest_weight{}, largest_weight{};  // over the recordings
  std::vector<ModelAcross> models;                                       // by mean rank, then by mean score
};

// All comparisons must be of the same models. Scores of different recordings are normalised differently (p1, p2), so ranks are what can be
// averaged; mean scores are shown because the paper shows them. Leads are paired within recordings; their intervals hold together (the
// level is shared among the models behind the first, after Bonferroni) and say what to expect of other recordings like these, if these were
// picked at random.
Across across(std::span<const Comparison> comparisons);

// Student's t interval of the mean of the values that are defined, at 1 - alpha; fewer than two give no interval.
MeanOverRecordings mean_over_recordings(std::span<const double> values, double alpha);

}  // namespace swarmfit
