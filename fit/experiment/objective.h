// SPDX-License-Identifier: MIT
// From parameters to energies: simulate under the recording's conditions, observe, measure, compare.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "fit/experiment/conditions.h"
#include "fit/experiment/journal.h"
#include "fit/experiment/outcome.h"

namespace swarmfit {

// The objective of one model on one recording. Const and shared by threads; holds references, so all arguments must outlive it.
class Objective {
 public:
  // The target must have been measured as conditions.metrics says. What race() finds in the journal it does not simulate again.
  Objective(const ModelChoice& model, const Conditions& conditions, const Target& target, Journal* journal = nullptr);

  // Evaluates candidates (full parameter vectors) on the same replicate seeds: common random numbers make candidates comparable.
  // Runs candidate × replicate in parallel; results do not depend on the number of threads. `finer` divides the time step.
  std::vector<Outcome> evaluate(const std::vector<std::vector<double>>& candidates, std::span<const Rng> seeds, int finer = 1) const;
  Outcome evaluate(const std::vector<double>& candidate, std::span<const Rng> seeds, int finer = 1) const;

  // The same in two heats, without distributions. Which candidates go on, judged by their Outcome::first; the others' outcomes hold the
  // first replicates only.
  using Worth = std::function<std::vector<bool>(const std::vector<Outcome>& first)>;
  std::vector<Outcome> race(const std::vector<std::vector<double>>& candidates, std::span<const Rng> seeds, std::size_t first,
                            const Worth& worth) const;

  // Each run by itself. In parallel; results do not depend on the number of threads.
  std::vector<SingleRun> singles(const std::vector<double>& candidate, std::span<const Rng> seeds) const;

  // The observed tracks of one run: what evaluate() measures.
  Tracks simulate(const std::vector<double>& candidate, const Rng& seed, int finer = 1) const;

  // The same; nothing if the run blew up.
  std::optional<Tracks> finished(const std::vector<double>& candidate, const Rng& seed) const;

  // Steps per frame: as the conditions ask for, or as few as are stable until others are set.
  int steps() const { return plan_.substeps; }
  int stable_steps() const { return stable_steps_; }
  // Not while anything is simulated. Maps keep their one.
  void use_steps(int steps);

 private:
  struct Trial;
  using Candidates = std::vector<std::vector<double>>;
  Trial run(const std::vector<double>& candidate, const Rng& seed, int finer) const;
  // Runs on these seeds, appended to those of each candidate that is wanted.
  void extend(std::vector<std::vector<Trial>>& trials, const Candidates& candidates, const std::vector<bool>& wanted,
              std::span<const Rng> seeds, int finer) const;
  // Outcomes of those that are wanted, from the journal or from as many more trials as it takes.
  std::vector<Outcome> outcomes(std::vector<std::vector<Trial>>& trials, const Candidates& candidates, const std::vector<bool>& wanted,
                                std::span<const Rng> seeds) const;
  Energies scored(const std::vector<Trial>& trials, std::vector<Energies>& replicates) const;
  Outcome pool(const std::vector<Trial>& trials) const;
  Tracks simulate(const std::vector<double>& candidate, const Rng& seed, int finer, Counters& count, bool& blew_up) const;

  const Conditions& conditions_;
  const Target& target_;
  Journal* journal_;
  ModelChoice choice_;
  std::unique_ptr<Model> model_;
  Plan plan_;
  int stable_steps_ = 1;
};

// Replicate seeds: the same for every model and candidate of a run.
std::vector<Rng> replicate_seeds(const Rng& root, Stream stream, int replicates);

}  // namespace swarmfit
