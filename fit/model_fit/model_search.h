// SPDX-License-Identifier: MIT
// The search of one model within a comparison: everything it has simulated, and how that is searched further.
#pragma once

#include "fit/experiment/time_step.h"
#include "fit/model_fit/race.h"
#include "fit/model_fit/search_plan.h"

namespace swarmfit {

// What is looked at in the final replicates beside their score; k counts them. As Ensemble::measured wants it, and as bytes.
using FinalView = std::function<std::string(const Run& run, std::size_t k)>;

// The best parameters of a model under the present weights, judged on fresh seeds.
struct Selected {
  Point x;
  Outcome outcome;
  std::vector<std::string> views;  // of every final replicate
};

// Told the simulations of this pass so far and the best score.
using OnSearch = std::function<void(std::int64_t simulations, double best)>;

class ModelSearch {
 public:
  // All references must outlive the search. `index` is the model's place in the comparison.
  ModelSearch(std::size_t index, const ModelChoice& model, const Conditions& conditions, const Target& target, const SearchPlan& plan,
              std::vector<HistoryRow>& history, const Runtime& runtime, FinalView view);

  // One calibration pass, in rounds of fewer candidates and more replicates: rescores what is known, searches, searches again about the
  // leaders, confirms the best of those, and reports the winner on seeds that had no part in choosing it.
  void pass(int number, const Weighting& weighting, const OnSearch& on_search);

  // The next pass tries what another search has selected: together with this one's own parameters, and with the lowest of all that the
  // other does not have, which is the other where its settings only leave something out.
  void suggest(const ModelSearch& other);

  std::size_t index() const { return index_; }
  std::int64_t planned(int number) const;  // simulations of a pass, at most
  const Selected& selected() const { return selected_; }
  const std::vector<Energies>& selections() const { return selections_; }  // raw energies of what each pass selected, on the final seeds
  const SearchSpace& space() const { return space_; }
  const Objective& objective() const { return objective_; }
  std::int64_t evaluations() const { return evaluations_; }  // of both searches
  std::int64_t simulations() const { return simulations_; }
  std::int64_t failed() const { return failed_; }
  const std::string& stop_reason() const { return stop_reason_; }
  const std::vector<ConvergencePoint>& convergence() const { return convergence_; }
  std::span<const Rng> final_seeds() const { return final_seeds_; }

 private:
  void try_out(const std::vector<Point>& points, Round& round, const char* phase);  // in the first pass
  bool chooses_steps() const;
  StepSeeds step_seeds() const;
  bool settle(Round& round, int most, const Weighting& weighting, int first, int finest = kMostSteps);  // are steps others now?
  static Round on_seeds(const SearchPlan& plan, Stream stream, int replicates);
  // The best of an archive under these weights, no two nearer than `apart` in the unit cube: by what a search minimises, or by the score.
  static std::vector<Evaluated> leaders(const Round& round, const Weighting& weighting, std::size_t most, double apart,
                                        Energies Archived::*by = &Archived::guided);
  void keep(Round& round, const Point& x, const Outcome& outcome, int pass, const char* phase);
  Found explore(Round& round, const SearchSize& size, int pass, const char* phase, const Weighting& weighting,
                const std::function<void(const GenerationReport&)>& report);
  void promote(const Round& from, Round& to, std::size_t most, double apart, int pass, const char* phase, const Weighting& weighting);
  Selected on_final_seeds(const Point& x) const;
  void conclude(int number, const Weighting& weighting);

  std::size_t index_;
  const Target& target_;
  const SearchPlan& plan_;
  SearchSpace space_;
  Objective objective_;
  std::vector<HistoryRow>& history_;
  FinalView view_;
  Rng rng_;
  Round search_, selection_, confirmation_;
  std::vector<Rng> final_seeds_;
  Selected selected_;
  std::vector<Energies> selections_;
  std::int64_t evaluations_ = 0, simulations_ = 0, failed_ = 0;
  std::string stop_reason_;
  std::vector<ConvergencePoint> convergence_;
};

}  // namespace swarmfit
