// SPDX-License-Identifier: MIT
// From parameters to energies: runs of an ensemble, measured and compared with the recording.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "fit/experiment/ensemble.h"
#include "fit/experiment/outcome.h"

namespace swarmfit {

// The objective of one model on one recording. Const and shared by threads; holds references, so all arguments must outlive it.
class Objective {
 public:
  // The target must have been measured as conditions.metrics says. What is kept in the runtime's checkpoint is not simulated again.
  Objective(const ModelChoice& model, const Conditions& conditions, const Target& target, const Runtime& runtime = {});

  const Ensemble& ensemble() const { return ensemble_; }
  const Target& target() const { return target_; }
  void use_steps(int steps) { ensemble_.use_steps(steps); }

  // Evaluates candidates (full parameter vectors) on the same replicate seeds: common random numbers make candidates comparable.
  // One batch of candidate × replicate. `finer` divides the time step.
  std::vector<Outcome> evaluate(const std::vector<std::vector<double>>& candidates, std::span<const Rng> seeds, int finer = 1) const;
  Outcome evaluate(const std::vector<double>& candidate, std::span<const Rng> seeds, int finer = 1) const;

  // The same without distributions, and kept.
  Outcome energies(const std::vector<double>& candidate, std::span<const Rng> seeds, int finer = 1) const;

  // Many candidates in two heats, without distributions, and kept. Which candidates go on, judged by their Outcome::first; the others'
  // outcomes hold the first replicates only.
  using Worth = std::function<std::vector<bool>(const std::vector<Outcome>& first)>;
  std::vector<Outcome> race(const std::vector<std::vector<double>>& candidates, std::span<const Rng> seeds, std::size_t first,
                            const Worth& worth) const;

  // One run, scored by itself; and what all replicates of a candidate come to.
  ScoredRun scored(const Run& run) const;
  Outcome outcome(std::span<const ScoredRun> replicates) const;

  // One run, binned by itself.
  SingleRun single(const Run& run) const;

 private:
  using Candidates = std::vector<std::vector<double>>;
  using Replicates = std::vector<std::vector<ScoredRun>>;  // of each candidate
  // Runs on these seeds, appended to those of each candidate that is wanted.
  void extend(Replicates& replicates, const Candidates& candidates, const std::vector<bool>& wanted, std::span<const Rng> seeds,
              int finer) const;
  // Outcomes of those that are wanted, from the checkpoint or from as many more runs as it takes. Of so many seeds they are known already.
  std::vector<Outcome> outcomes(Replicates& replicates, const Candidates& candidates, const std::vector<bool>& wanted,
                                std::span<const Rng> seeds, int finer, std::size_t known) const;
  Energies energy_scores(std::span<const ScoredRun> runs, std::vector<Energies>& replicates) const;

  const Target& target_;
  Ensemble ensemble_;
};

}  // namespace swarmfit
