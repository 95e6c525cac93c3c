// SPDX-License-Identifier: MIT
// What a model of collective motion says of itself: a table of parameters and options, and what it asks for. Plain values that own their
// text, so that models can also be described while the program runs.
#pragma once

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "libswarm/linear_motion.h"

namespace swarmfit {

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
  double initial = 0, lower = 0, upper = 0;
};

// One row of a model's parameter table.
struct Parameter {
  enum class Length { extent, spacing };  // which length of the recording scales it in a fit
  enum class Shown { no, speed };         // what a recording shows of it: nothing, or that everybody flies at this speed

  std::size_t row = 0;      // its place in the table: what the model's own enum calls it
  std::string name;         // on the command line and in results
  std::string symbol = {};  // as printed in the source
  Unit unit = {};           // in length units and seconds
  Range scene = {};         // default and bounds in simulation units, as in the papers: for scenes
  Range fit = {};           // default and bounds in a fit, in multiples of L^length T^time (or NND^length)
  Length length = Length::extent;
  bool log = false;          // searched on a logarithmic scale; needs a positive lower bound of fits
  bool fitted = false;       // searched by default
  bool published = false;    // searched by Ren et al. 2016 (Tables S17 to S20, and λ in their comparison of noises)
  std::string when = {};     // used only with these options: "noise=curl|perlin,interaction=on" (| or, comma and); empty: always
  std::string needs = {};    // a part of the world without which it does nothing, as users call it: "stimuli"
  std::string meaning = {};  // one line
  std::string source = {};   // paper and equation, or why this value
  bool integer = false;
  std::string at_lower = {};  // what it means for a fit to end on the lower bound, where that means something
  Shown shown = Shown::no;

  // What one unit of `fit` is worth in this recording.
  double scale(const Scales& s) const;

  // Where neither the papers nor fits go below zero, nothing may; what is searched on a logarithmic axis must be
  // positive, if it must in scenes. Throws InputError.
  void check(double value) const;
};

// A setting with a closed set of values; the first value is the default.
struct Option {
  std::string name;
  std::vector<std::string> values;
  std::string meaning;
  std::vector<std::string> with = {};  // what each value gives the model, to be read after "with": "no collision avoidance"
};

// Values of a model's options, by name; always complete once made by ModelSpec::resolve.
using Options = std::map<std::string, std::string, std::less<>>;

class Model;
struct Setup;

// All agents at once, from what was; or one after the other, each seeing where those before it are now.
enum class Update { synchronous, sequential };

// How to see the acceleration of a model that has one: a function of places and velocities, not of the step.
struct ForceLike {
  std::string when = {};                 // with which options it has one (as Parameter::when)
  Options options = {};                  // without noise, and without rules that set velocities at once
  std::vector<std::size_t> silent = {};  // rows of parameters that are 0 then
  std::vector<std::size_t> jumps = {};   // and of those at which a force sets in or ends, all at once
  std::string memory = {};               // options with which the noise has one (as ModelSpec::map); empty: it is white
};

struct ModelSpec {
  std::string name;
  std::string summary;    // one line
  std::string citation;   // author, year, doi
  std::vector<int> dims;  // of motion it can simulate
  Update update = Update::synchronous;
  bool needs_reference = false;  // cannot be made without a recording (FASTSWARM)
  bool fixed_step = false;       // steps are the recording's frame interval, without a recording native_dt (FASTSWARM)
  double native_dt = 0.01;       // of scenes [s]
  // With these options (as in Parameter::when; "always") the model is a map from one decision to the next: half the step is another model,
  // and fits take one step per frame. Empty: it stands for motion in continuous time, and any step that is fine enough will do.
  std::string map = {};
  double largest_dt = INFINITY;  // of fits, in units of T: the step that is still stable anywhere inside the fit bounds
  std::string quiet = {};        // options or parameters that leave no randomness: "noise=none", "eta=0,xi=0"; empty: there is none anyway
  std::vector<Option> options = {};
  std::vector<std::string> columns = {};  // names of its private columns in State::own
  std::vector<std::string> kinds = {};    // what State::kind means to it, such as "sheep", "dog"; empty: all agents are alike to it
  std::vector<Parameter> parameters = {};
  std::function<std::unique_ptr<Model>(const Setup&)> make = {};  // called by make_model and nobody else
  // Its motion, where that is linear under these options and parameters (a value per row); null: never.
  std::optional<LinearMotion> (*linear)(const Options&, std::span<const double> parameters) = nullptr;
  std::optional<ForceLike> force = {};  // of models whose velocities change by forces; see has_force

  // Every option with its value; throws InputError naming the legal names or values.
  Options resolve(const Options& given) const;
  // Index of a parameter, or -1.
  int find(std::string_view parameter) const;
  // Is parameter p used under these (complete) options?
  bool uses(std::size_t p, const Options& options) const;
  // Does it decide once per step under these (complete) options? So does whatever has a fixed step.
  bool is_map(const Options& options) const;
  // Has it an acceleration that can be seen under these (complete) options, and noise with a memory?
  bool has_force(const Options& options) const;
  bool remembers(const Options& options) const;
};

// A model with its options, as the user names it: "bswarm[noise=white,avoidance=none]".
struct ModelChoice {
  const ModelSpec* spec = nullptr;
  Options options;   // complete
  std::string name;  // canonical: only options that differ from the default, in table order
};

// The model's summary, after a sentence on what sets a variant apart: "bswarm with no collision avoidance. Insect swarm: ...".
std::string summary_of(const ModelChoice& model);

// All models of this program, in the order of models.def.
std::span<const ModelSpec> models();

// Finds the model among models() and `more`, which outlive the choice. Throws InputError naming the legal names, options or values.
ModelChoice parse_model(std::string_view text, std::span<const ModelSpec> more = {});

}  // namespace swarmfit
