// SPDX-License-Identifier: MIT
// The calibration loop (Ren et al. 2016, algorithm Par-Est): models are searched under weights, and weights made of what the searches
// found.
#pragma once

#include <vector>

#include "fit/compare/compare.h"
#include "fit/model_fit/model_search.h"

namespace swarmfit {

// The comparison in progress: one search per model, and the weights they are judged by.
class Calibration {
 public:
  // used: columns of the score. All other references must outlive it.
  Calibration(const CompareOptions& options, const Conditions& conditions, const Target& target, const PerColumn<bool>& used,
              const OnCompareProgress& on_progress, const Runtime& runtime, const FinalView& view = {});
  Calibration(const Calibration&) = delete;  // the searches write to its history
  Calibration& operator=(const Calibration&) = delete;

  // Par-Est, steps 1 to 5. What the models are ranked by.
  CalibrationFacts run(const PerColumn<double>& resolution);

  const std::vector<ModelSearch>& searches() const { return searches_; }  // in the order in which models were named
  const std::vector<HistoryRow>& history() const { return history_; }     // every candidate that was simulated
  const Weighting& weighting() const { return weighting_; }

 private:
  void exchange();  // settings of one model learn from each other
  void tell(std::size_t m, int pass, int passes, std::int64_t simulations, double best) const;

  const CompareOptions& options_;
  const Target& target_;
  const std::vector<bool> used_;
  const OnCompareProgress& on_progress_;
  std::vector<HistoryRow> history_;
  std::vector<ModelSearch> searches_;
  Weighting weighting_;
};

}  // namespace swarmfit
