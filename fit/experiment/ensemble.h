// SPDX-License-Identifier: MIT
// The one door through which simulations are asked for: runs of a model under the recording's conditions, in batches, each measured where
// it was made and kept where the run's checkpoint can find it again.
#pragma once

#include <memory>
#include <span>

#include "fit/experiment/conditions.h"
#include "fit/experiment/executor.h"
#include "fit/store/bytes.h"
#include "fit/store/checkpoint.h"
#include "libswarm/simulate.h"

namespace swarmfit {

// What was asked for, counted. Filled by one thread at a time: whoever asks.
struct Tally {
  std::int64_t made = 0, found = 0;  // simulations; those in the checkpoint
  std::int64_t batches = 0;          // in which they were made
  std::size_t largest_batch = 0;
};

// By whom simulations are made, where they are kept, and who counts them (null: nowhere, nobody).
struct Runtime {
  const Executor* executor = &threads();
  Checkpoint* checkpoint = nullptr;
  Tally* tally = nullptr;
};

// Of what simulations are made under: two parts of a recording, or two recordings of a study, may be compared in one run. A key of a
// checkpoint.
std::string fingerprint(const Conditions& conditions);

// One simulation to be made.
struct Job {
  std::vector<double> parameters;  // of every row of the model's table, in physical units
  Rng seed;
  int finer = 1;  // divides the time step
};

// One simulation, as the camera saw it.
struct Run {
  Tracks seen;  // with the recording's names, frames and unit; smoothed as the recording is
  Counters count;
  bool blew_up = false;  // `seen` ends there
};

// Const and shared by threads; holds references, so all arguments must outlive it.
class Ensemble {
 public:
  // Throws as the model's factory.
  Ensemble(const ModelChoice& model, const Conditions& conditions, const Runtime& runtime = {});

  // What `measure` says of every run, in the order of the jobs, the same whoever made it. measure(run, k) is a function of its arguments
  // alone, from any thread; T can be put into bytes (fit/store/bytes.h). With a name, results are kept under it, the model and the job:
  // what is there is not simulated again. Throws what measure or the model throws, and Interrupted.
  template <class T, class Measure>
  std::vector<T> measured(std::span<const Job> jobs, const std::string& name, const Measure& measure) const {
    std::vector<T> out;
    for (const std::string& bytes : measured_bytes(jobs, name, [&](const Run&run, std::size_t k) { return to_bytes(T(measure(run, k))); }))
      out.push_back(from_bytes<T>(bytes));
    return out;
  }

  // One run, here and now: for a film. The same bits in every process. Throws Interrupted.
  Run run(const Job& job) const;

  const ModelChoice& model() const { return choice_; }
  const Conditions& conditions() const { return conditions_; }
  const Runtime& runtime() const { return runtime_; }

  // Steps per frame: as the conditions ask for, or as few as are stable until others are set.
  int steps() const { return plan_.substeps; }
  int stable_steps() const { return stable_steps_; }
  // Not while anything is simulated. Maps keep their one.
  void use_steps(int steps);

  // What a simulation is a function of beside its parameters and seed, for keys of a checkpoint.
  std::string identity(int finer) const;

 private:
  using Measure = std::function<std::string(const Run&, std::size_t)>;
  std::vector<std::string> made(std::size_t count, const Executor::Work& work) const;
  std::vector<std::string> measured_bytes(std::span<const Job> jobs, const std::string& name, const Measure& measure) const;

  const Conditions& conditions_;
  Runtime runtime_;
  ModelChoice choice_;
  std::unique_ptr<Model> model_;
  Plan plan_;
  int stable_steps_ = 1;
  std::string under_;  // fingerprint of the conditions
};

// Replicate seeds: the same for every model and candidate of a run.
std::vector<Rng> replicate_seeds(const Rng& root, Stream stream, int replicates);

// These parameters on these seeds.
std::vector<Job> jobs_on(const std::vector<double>& parameters, std::span<const Rng> seeds);

}  // namespace swarmfit
