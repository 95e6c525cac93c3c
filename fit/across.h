// SPDX-License-Identifier: MIT
// The same models compared on several recordings: one summary (Ren et al. 2016, Figs 10, 13 and 15).
#pragma once

#include <span>

#include "fit/results.h"

namespace swarmfit {

// One model over all recordings, in the order in which they were given.
struct ModelAcross {
  std::string model;
  std::vector<double> score;  // NaN: undefined
  std::vector<int> rank;      // 0: undefined
  double mean_score = 0;      // over the recordings where it is defined; NaN if nowhere
  double mean_rank = 0;
  int wins = 0;  // first, ties with the second included
};

struct Across {
  std::vector<std::string> recordings;                                   // paths as given
  std::vector<Column> columns = columns_at({1});                         // of any recording
  std::vector<PerColumn<double>> weights;                                // of each recording; NaN: it has no such column
  PerColumn<double> mean_weight{}, smallest_weight{}, largest_weight{};  // over the recordings
  std::vector<ModelAcross> models;                                       // by mean rank, then by mean score
};

// All comparisons must be of the same models. Scores of different recordings are normalised differently (p1, p2), so ranks are what can be
// averaged; mean scores are shown because the paper shows them.
Across across(std::span<const Comparison> comparisons);

}  // namespace swarmfit
