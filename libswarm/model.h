// SPDX-License-Identifier: MIT
// What a model of collective motion is: a table that describes it (ModelSpec) and a step (Model).
#pragma once

#include <cmath>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "libswarm/neighbours.h"
#include "libswarm/state.h"
#include "libswarm/world.h"
#include "libtrack/rng.h"

namespace swarmfit {

// ---- describing a model -------------------------------------------------------------------------------------------------------

// The recording's own scales: L = root-mean-square radius about the frame centroid, NND = mean nearest-neighbour distance,
// V = mean speed. T = L / V and A = L / T² follow. Bounds and defaults of fits are stated in them.
struct Scales {
  double extent = 1;   // L [unit]
  double spacing = 1;  // NND [unit]
  double speed = 1;    // V [unit/s]
  double unlike = 1;   // relative standard deviation of the speeds (half their central 95 % over 1.96, over V): 0 if all are the same
  double time() const { return extent / speed; }
};

// A unit as powers of length and time: an acceleration is {1, -2}.
struct Unit {
  double length = 0, time = 0;
};
std::string to_string(Unit unit, const std::string& length_unit);  // "mm/s^2"; "" for a pure number

struct Range {
  double initial, lower, upper;
};

// One row of a model's parameter table.
struct Parameter {
  enum class Length { extent, spacing };  // which length of the recording scales it in a fit
  enum class Shown { no, speed };         // what a recording shows of it: nothing, or that everybody flies at this speed

  std::string_view name;    // on the command line and in results
  std::string_view symbol;  // as printed in the source
  Unit unit;                // in length units and seconds
  Range scene;              // default and bounds in simulation units, as in the papers: for scenes
  Range fit;                // default and bounds in a fit, in multiples of L^length T^time (or NND^length)
  Length length = Length::extent;
  bool log = false;          // searched on a logarithmic scale; needs a positive lower bound
  bool fitted = false;       // searched by default
  std::string_view when;     // used only with these options: "noise=curl|perlin,interaction=on" (| or, comma and); empty: always
  std::string_view meaning;  // one line
  std::string_view source;   // paper and equation, or why this value
  bool integer = false;
  std::string_view at_lower = {};  // what it means for a fit to end on the lower bound, where that means something
  Shown shown = Shown::no;

  // What one unit of `fit` is worth in this recording.
  double scale(const Scales& s) const;
};

// A setting with a closed set of values; the first value is the default.
struct Option {
  std::string_view name;
  std::vector<std::string_view> values;
  std::string_view meaning;
};

// Values of a model's options, by name; always complete once made by ModelSpec::resolve.
using Options = std::map<std::string, std::string, std::less<>>;

class Model;
struct Setup;

enum class Update { synchronous, sequential };

struct ModelSpec {
  std::string_view name;
  std::string_view summary;   // one line
  std::string_view citation;  // author, year, doi
  std::vector<int> dims;      // of motion it can simulate
  Update update = Update::synchronous;
  bool needs_reference = false;  // cannot be made without a recording (FASTSWARM)
  double native_dt = 0.01;       // of scenes [s]
  // With these options (as in Parameter::when; "always") the model is a map from one decision to the next: half the step is another model,
  // and fits take one step per frame. Empty: it stands for motion in continuous time, and any step that is fine enough will do.
  std::string_view map = {};
  double largest_dt = INFINITY;  // of fits, in units of T: the step that is still stable anywhere inside the fit bounds
  std::string_view quiet = {};   // options or parameters that leave no randomness: "noise=none", "eta=0,xi=0"; empty: there is none anyway
  std::vector<Option> options;
  std::vector<std::string_view> columns;  // names of its private columns in State::own
  std::vector<Parameter> parameters;
  std::unique_ptr<Model> (*make)(const Setup&) = nullptr;

  // Every option with its value; throws InputError naming the legal names or values.
  Options resolve(const Options& given) const;
  // Index of a parameter, or -1.
  int find(std::string_view parameter) const;
  // Is parameter p used under these (complete) options?
  bool uses(std::size_t p, const Options& options) const;
  // Does it decide once per step under these (complete) options?
  bool is_map(const Options& options) const;
};

// A model with its options, as the user names it: "bswarm[noise=white,avoidance=none]".
struct ModelChoice {
  const ModelSpec* spec = nullptr;
  Options options;   // complete
  std::string name;  // canonical: only options that differ from the default, in table order
};
ModelChoice parse_model(std::string_view text);  // throws InputError

// All models, in the order of models.def.
std::span<const ModelSpec> models();

// ---- running a model ----------------------------------------------------------------------------------------------------------

// What is known when a model is made, before any agent exists.
struct Setup {
  int dims = 3;
  Options options;                    // complete
  Scales scales;                      // of the recording, or all 1 in a scene
  const Tracks* reference = nullptr;  // the recording, for models that need one; outlives the model
  Rng rng{};                          // for what is drawn once per model, such as samples of the reference
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
};

enum class Step { done, halve_dt, blew_up };

// The rule of motion. Const and shared by all runs: what changes lives in State, StepContext and Workspace.
class Model {
 public:
  virtual ~Model() = default;

  // Number of private columns: ModelSpec::columns.size().
  virtual Index columns() const { return 0; }

  // Fills the private columns of agents that have just appeared: rows first .. end.
  virtual void enter(State&, Index /*first*/, const World&, const StepContext&) const {}

  virtual std::unique_ptr<Workspace> workspace(const World&, const Rng&) const { return nullptr; }

  // Advances all agents by one step. Reads only the frozen `now`, writes only pos, vel and own of `next`, which has the same agents in the
  // same rows and the same private columns; a model that declares itself sequential may reread what it wrote. Returns halve_dt to have the
  // step redone as two, and blew_up when motion is no longer finite. One call per step, never per agent. The bounds are kept afterwards.
  virtual Step step(const State& now, State& next, const World&, const StepContext&) const = 0;
};

}  // namespace swarmfit
