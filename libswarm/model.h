// SPDX-License-Identifier: MIT
// The rule by which a model moves its agents. What it says of itself is in model_spec.h.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "libswarm/model_spec.h"
#include "libswarm/neighbours.h"
#include "libswarm/state.h"
#include "libswarm/world.h"
#include "libtrack/rng.h"

namespace swarmfit {

// What is known when a model is made, before any agent exists.
struct Setup {
  int dims = 3;
  Options options = {};               // complete once make_model hands it on
  Scales scales = {};                 // of the recording, or all 1 in a scene
  const Tracks* reference = nullptr;  // the recording, for models that need one; outlives the model
  Rng rng{};                          // for what is drawn once per model, such as samples of the reference
  double step = 0;                    // length of the steps to come [s]; 0: not known yet
  int kinds = 1;                      // State::kind will be less than this
};

// A model's private workspace for one run: noise tables, buffers. Never carries results between steps.
struct Workspace {
  virtual ~Workspace() = default;
};

// Counted events of a run.
struct Counters {
  std::uint64_t agent_steps = 0;
  std::uint64_t infeasible_avoidance = 0;  // agents and steps without any collision-free velocity
  std::uint64_t halved_steps = 0;
  std::uint64_t enforced = 0;  // agents and steps that minimum-distance enforcement moved
};

struct StepContext {
  double t, dt;               // [s]
  std::uint64_t tick;         // eighths of a step since frame 0: the time axis of random numbers
  bool can_halve;             // false: this step may not return halve_dt
  std::span<const double> p;  // one value per row of the parameter table, schedules applied, in the state's units
  Rng rng;
  Neighbours& near;
  Workspace* work;  // made by Model::workspace for this run
  Counters& count;
  std::span<const Index> order = {};  // sequential models: rows in the order in which they move, drawn by id for every step
};

enum class Step { done, halve_dt, blew_up };

// The rule of motion. Const and shared by all runs: what changes lives in State, StepContext and Workspace.
class Model {
 public:
  virtual ~Model() = default;

  // What the spec said, for whoever steps it; kept by make_model.
  const std::string& name() const { return name_; }
  Update update() const { return update_; }

  // Number of private columns: ModelSpec::columns.size().
  virtual Index columns() const { return 0; }

  // Fills the private columns of agents that have just appeared: rows first .. end.
  virtual void enter(State&, Index /*first*/, const World&, const StepContext&) const {}

  virtual std::unique_ptr<Workspace> workspace(const World&, const Rng&) const { return nullptr; }

  // Advances all agents by one step. Reads only the frozen `now`, writes only pos, vel and own of `next`, which has the same agents in the
  // same rows and the same private columns. For a sequential model `next` starts as a copy of `now`: it moves the rows of
  // StepContext::order one after the other, and may reread what it wrote. Returns halve_dt to have the step redone as two, and blew_up when
  // motion is no longer finite. One call per step, never per agent. World::constrain follows.
  virtual Step step(const State& now, State& next, const World&, const StepContext&) const = 0;

 private:
  friend std::unique_ptr<Model> make_model(const ModelChoice&, Setup);
  std::string name_ = "unnamed";
  Update update_ = Update::synchronous;
};

// The only way to make a model: checks that it gets what its spec asks for, and that the spec agrees with itself. Options are those of the
// choice. Throws InputError: dimensions it cannot move in, no recording or one in other dimensions, steps that are not its own, more kinds
// of agents than it has, an option it does not know.
std::unique_ptr<Model> make_model(const ModelChoice& choice, Setup setup);

}  // namespace swarmfit
