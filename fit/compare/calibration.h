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
  // used: columns of the score. All references must outlive it; candidates are added to the history.
  Calibration(const CompareOptions& options, const Conditions& conditions, const Target& target, const std::vector<bool>& used,
              std::vector<HistoryRow>& history, const OnCompareProgress& on_progress, const Runtime& runtime, const FinalView& view = {});

  // Par-Est, steps 1 to 5. What the models are ranked by.
  Ranking run(const PerColumn<double>& resolution);

  const std::vector<ModelSearch>& searches() const { return searches_; }  // in the order in which models were named
  const Weighting& weighting() const { return weighting_; }

 private:
  void exchange();  // settings of one model learn from each other
  void tell(std::size_t m, int pass, int passes, std::int64_t simulations, double best) const;

  const CompareOptions& options_;
  const Target& target_;
  const std::vector<bool>& used_;
  const OnCompareProgress& on_progress_;
  std::vector<ModelSearch> searches_;
  Weighting weighting_;
};

}  // namespace swarmfit
