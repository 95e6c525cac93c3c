// SPDX-License-Identifier: MIT
// A scene in simulation units: who moves by which model, where, from what start, and what of their motion is expected. One plain value for
// everything that simulates without a recording: scenario files, a bare model, the gallery, planted recordings.
//
//   Scenario scene = read_scenario("mine.toml", read_file("mine.toml"));     // or plain_scenario(parse_model("boids"))
//   set_parameter(scene, "radius", 3);
//   play(scene, sink);                                                       // frames 0 .. scene.frames - 1
//
// Times count from the first frame that is written, t = 0; what comes before is warm-up, at negative times.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "libswarm/bridge.h"
#include "libswarm/curve_guide.h"
#include "libswarm/model.h"
#include "libswarm/paths.h"
#include "libswarm/simulate.h"
#include "libswarm/stimuli.h"
#include "libswarm/walls.h"
#include "libtrack/tracks.h"

namespace swarmfit {

// Where and how agents begin.
struct Start {
  enum class Shape {
    ball,     // uniform in a ball (disc) about `centre`; radius 0: about the middle of the bounds, a quarter of them wide (in the open 1)
    box,      // uniform between `lower` and `upper`
    line,     // evenly spaced from `lower` to `upper`, both included
    grid,     // on a regular grid that fills the box between `lower` and `upper`
    ring,     // evenly round the horizontal circle about `centre`: in the plane of x and z; in two dimensions of x and y
    curve,    // each within `radius` of one of `points`, drawn at random
    recorded  // the k-th at the k-th of `points`, with the k-th of `velocities`
  };
  Shape shape = Shape::ball;
  Eigen::Array3d centre = Eigen::Array3d::Zero(), lower = Eigen::Array3d::Zero(), upper = Eigen::Array3d::Zero();  // [unit]
  double radius = 0;                                                                                               // >= 0 [unit]
  std::vector<Eigen::Array3d> points = {}, velocities = {};                                                        // [unit], [unit/s]
  double speed = 0.3;                               // of everybody at the start, >= 0 [unit/s]
  Eigen::Array3d heading = Eigen::Array3d::Zero();  // all into this direction; 0: each into a direction drawn at random
};

// Agents that begin alike. Those of the first group have the first ids, and so on.
struct Group {
  std::uint8_t kind = 0;  // among ModelSpec::kinds
  int agents = 100;       // >= 1
  Start start{};
  double arrive = -std::numeric_limits<double>::infinity();  // when the first is there; -inf: from the very start [s]
  double every = 0;                                          // time from one arrival to the next, >= 0 [s]
  double leave = std::numeric_limits<double>::infinity();    // when all are gone [s]
};

// A number that is computed from the trajectories, and what it should be. Which measures there are is not known here.
struct Expectation {
  std::string name, measure;
  double above = -std::numeric_limits<double>::infinity(), below = std::numeric_limits<double>::infinity();  // bounds, both allowed
  std::vector<std::pair<std::string, std::vector<double>>> arguments = {};                                   // of the measure, by name
  std::string published = {};                                                                                // what the source says
  std::string place = {};                                                                                    // file:line:column
};

struct Scenario {
  std::string name, title, source;  // of the file; one line what it shows; where it is published
  std::string shows;                // the model of whose pages it makes the picture; empty: of none
  ModelChoice model;
  std::vector<double> parameters;                // a value for every row of the model's table, in simulation units
  Scales scales{};                               // what the model is told of the group's size and speed
  std::shared_ptr<const Tracks> reference = {};  // what models learn from that need a recording; frames are as far apart as its own
  int dims = 3;
  std::int64_t frames = 500, warm_up = 0;
  double dt = 0.01;  // frame interval, > 0 [s]
  int substeps = 0;  // steps per frame; 0: as many as the model's native step asks for
  std::uint64_t seed = 1;
  std::string unit = "su";
  Bounds bounds{};
  std::vector<Obstacle> obstacles = {};
  std::vector<Stimulus> stimuli = {};
  std::vector<Goal> goals = {};
  PathOptions paths = {};                  // to the goals; the grid covers the bounds if it is not given (one cell)
  std::optional<BridgeShape> bridge = {};  // with arrivals of its own
  std::optional<CurveToFollow> curve = {};
  std::vector<Schedule> schedules = {};
  std::optional<DensityFeedback> feedback = {};
  std::vector<Group> groups = {Group{}};
  std::vector<Expectation> expectations = {};

  int agents() const;  // of all groups, also those who arrive later
  int steps_per_frame() const;
};

// A model with the defaults of its table: 100 agents in a reflecting box of side 20 about the origin.
Scenario plain_scenario(const ModelChoice& model, int dims = 3);

// Row of the model's table. Throws InputError naming those that there are.
std::size_t parameter_row(const ModelSpec& spec, std::string_view name);

// Throws InputError "name...: what is wrong; what was expected": no such parameter, a value it cannot have, or one that acts on a part of
// the world which this one has not.
void set_parameter(Scenario& scene, std::string_view name, double value);

// The reflecting box of this side about the origin, or with side 0 open space.
Bounds box_of(double side, int dims);

// What of a scenario is simulated: for whoever steps it otherwise than play(). `seed` and `warm_up` are the scenario's.
std::unique_ptr<Model> model_of(const Scenario& scene);  // throws InputError if it refuses the scene
World world_of(const Scenario& scene);
State start_of(const Scenario& scene);  // without those who arrive later
Plan plan_of(const Scenario& scene);    // frame 0 of the plan is the first of the warm-up

// Simulates. `agents` gets the frames 0 .. frames-1, ids being agent numbers; `stimuli`, if there is one, those that are there and
// the goals, ids being their numbers, those of goals after those of stimuli. Throws InputError if the model refuses the scene, or the
// simulation blows up.
Counters play(const Scenario& scene, FrameSink& agents, FrameSink* stimuli = nullptr);

// Tracks of a scene that was played.
TrackMeta meta_of(const Scenario& scene);

}  // namespace swarmfit
