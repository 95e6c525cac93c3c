// SPDX-License-Identifier: MIT
// The same models on several recordings.
#pragma once

#include <string>
#include <vector>

#include "libeval/columns.h"
#include "libtrack/nan.h"

namespace swarmfit {

// A mean over recordings and its interval, Student's t at 95 %, the recording being the replicate; undefined: NaN.
struct MeanOverRecordings {
  double mean = kNaN, lower = kNaN, upper = kNaN;
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

}  // namespace swarmfit
