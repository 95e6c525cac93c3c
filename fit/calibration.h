// SPDX-License-Identifier: MIT
// The search of one model within a comparison: everything it has simulated, and how that is searched further.
#pragma once

#include "fit/compare.h"
#include "fit/objective.h"

namespace swarmfit {

// The best parameters of a model under the present weights, judged on fresh seeds.
struct Selected {
  Point x;
  Outcome outcome;
};

class ModelSearch {
 public:
  // All references must outlive the search. `index` is the model's place in the comparison.
  ModelSearch(std::size_t index, const ModelChoice& model, const Conditions& conditions, const Target& target,
              const CompareOptions& options, std::vector<HistoryRow>& history);

  // One calibration pass: rescores the archive, searches, judges the leaders on fresh seeds, and refines the best of them.
  void pass(int number, const Weighting& weighting, const OnGeneration& on_generation);

  std::int64_t planned(int number) const;  // candidates of the search of a pass
  const Selected& selected() const { return selected_; }
  const SearchSpace& space() const { return space_; }
  const Objective& objective() const { return objective_; }
  std::int64_t evaluations() const { return evaluations_; }  // of the search and the refinement
  std::int64_t simulations() const { return simulations_; }
  std::int64_t failed() const { return failed_; }
  const std::string& stop_reason() const { return stop_reason_; }
  const std::vector<ConvergencePoint>& convergence() const { return convergence_; }
  std::span<const Rng> final_seeds() const { return final_seeds_; }

 private:
  struct Archived {
    Point x;
    Energies raw;
  };
  // The best of an archive under these weights, no two nearer than `apart` in the unit cube.
  static std::vector<Evaluated> rescored(const std::vector<Archived>& archive, const Weighting& weighting, std::size_t most, double apart);
  void record(const Point& x, const Outcome& outcome, int pass, const char* phase);  // in the history
  void keep(const Point& x, const Outcome& outcome, int pass);                       // and in the archive
  void search(int number, const Weighting& weighting, const OnGeneration& on_generation);
  void judge(int number, const Weighting& weighting);
  void polish(int number, const Weighting& weighting);
  void conclude(int number, const Weighting& weighting);
  std::int64_t left() const;  // evaluations that max_evaluations still allows

  std::size_t index_;
  const CompareOptions& options_;
  SearchSpace space_;
  Objective objective_;
  std::vector<HistoryRow>& history_;
  Rng rng_;
  std::vector<Rng> seeds_, selection_seeds_, final_seeds_;
  std::vector<Archived> archive_;  // on the search's seeds
  std::vector<Archived> judged_;   // on the selection's seeds
  Point recommended_;              // by the last search's response surface; empty before
  Selected selected_;
  std::int64_t evaluations_ = 0, simulations_ = 0, failed_ = 0;
  std::string stop_reason_;
  std::vector<ConvergencePoint> convergence_;
};

// Cost of raw energies under a weighting: minus the score; +inf if it is undefined.
double cost_of(const Energies& raw, const Weighting& weighting);

}  // namespace swarmfit
