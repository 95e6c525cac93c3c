// SPDX-License-Identifier: MIT
// Settings: what simulate and recover simulate and film.
#include "cli/parse.h"
#include "cli/tables.h"

namespace swarmfit::cli {
namespace {

constexpr double kMostFrames = 10'000'000;
constexpr double kMostAgents = 10'000'000;     // of simulate
constexpr double kMostAnimals = 100'000;       // of a recording that is fitted
constexpr double kFewestPerSecond = 1e-6;      // frames per second: many steps of a model lie between two frames
constexpr double kSmall = 1e-9, kLarge = 1e9;  // lengths and speeds, in any unit

// Nothing that is not given is changed: a scenario says all, and a model alone stands for one with 100 agents for 500 frames of 0.01 s in a
// box of side 20. One that learns from a recording moves in the open, in the recording's units and frames.
constexpr decltype(Setting::elsewhere) kTheScenarios{kSimulate | kSweep, ""};

std::vector<Setting> of_all_scenes() {
  return {
      {.name = "fps",
       .in = kSimulate | kRecover | kSweep,
       .help = "frames per second",
       .allowed = above(kFewestPerSecond, kLarge),
       .initial = "100",
       .elsewhere = kTheScenarios,
       .use =
           [](Arguments& a, const Value& v) {
             a.scene.fps = v.number();
             a.recovery.film.dt = 1 / v.number();
           }},
      {.name = "dims",
       .in = kSimulate | kRecover | kSweep,
       .help = "2 or 3",
       .allowed = whole(2, 3),
       .initial = "3",
       .elsewhere = kTheScenarios,
       .use =
           [](Arguments& a, const Value& v) {
             a.recovery.film.dims = v.whole<int>();
             a.scene.dims = a.recovery.film.dims;
           }},
      {.name = "obs-noise",
       .in = kSimulate,
       .help = "measurement error to add to positions",
       .allowed = number(0, kLarge),
       .use = [](Arguments& a, const Value& v) { a.scene.noise = v.number(); }},
      {.name = "film-noise",
       .in = kRecover,
       .help = "measurement error of the simulated recordings [unit]",
       .allowed = number(0, kLarge),
       .initial = "0",
       .use = [](Arguments& a, const Value& v) { a.recovery.film.sigma = v.number(); }},
      {.name = "dropout",
       .in = kSimulate | kRecover,
       .help = "probability per individual and frame that it is lost for up to five frames",
       .allowed = number(0, 1),
       .initial = "0",
       .use = [](Arguments& a, const Value& v) { a.scene.dropout = a.recovery.film.dropout = v.number(); }},
  };
}

std::vector<Setting> of_recover() {
  return {
      {.name = "spread",
       .in = kRecover,
       .help = "true parameters are drawn within this factor of the defaults, anew for every recording; 1: the defaults",
       .allowed = number(1, 100),
       .initial = "2",
       .use = [](Arguments& a, const Value& v) { a.recovery.spread = v.number(); }},
      {.name = "extent",
       .in = kRecover,
       .help = "rms radius of the simulated groups [unit]",
       .allowed = above(kSmall, kLarge),
       .initial = "100",
       .use = [](Arguments& a, const Value& v) { a.recovery.scales.extent = v.number(); }},
      {.name = "spacing",
       .in = kRecover,
       .help = "their nearest-neighbour distance [unit]",
       .allowed = above(kSmall, kLarge),
       .initial = "70",
       .use = [](Arguments& a, const Value& v) { a.recovery.scales.spacing = v.number(); }},
      {.name = "speed",
       .in = kRecover,
       .help = "their mean speed [unit/s]",
       .allowed = above(kSmall, kLarge),
       .initial = "225",  // with the others a laboratory swarm of midges, in mm and s
       .use = [](Arguments& a, const Value& v) { a.recovery.scales.speed = v.number(); }},
      {.name = "unit",
       .in = kRecover,
       .help = "name of the length unit",
       .initial = "mm",
       .use = [](Arguments& a, const Value& v) { a.recovery.film.unit = v.text(); }},
  };
}

std::vector<Setting> of_simulate() {
  return {
      {.name = "set",
       .in = kSimulate | kSweep,
       .help = "parameter=value, in simulation units",
       .allowed = texts(),
       .use =
           [](Arguments& a, const Value& v) {
             parse_assignments(v.words);
             a.scene.set = v.words;
           }},
      {.name = "agents",
       .in = kSimulate | kSweep,
       .help = "number of agents; of a scenario with one group",
       .allowed = whole(1, kMostAgents),
       .use = [](Arguments& a, const Value& v) { a.scene.agents = v.whole<int>(); }},
      {.name = "frames",
       .in = kSimulate | kSweep,
       .help = "frames to write, or to measure",
       .allowed = whole(1, kMostFrames),
       .use = [](Arguments& a, const Value& v) { a.scene.frames = v.whole<std::int64_t>(); }},
      {.name = "warm-up",
       .in = kSimulate | kSweep,
       .help = "frames to simulate before the first of these",
       .allowed = whole(0, kMostFrames),
       .use = [](Arguments& a, const Value& v) { a.scene.warm_up = v.whole<std::int64_t>(); }},
      {.name = "box",
       .in = kSimulate | kSweep,
       .help = "side of the reflecting box about the origin; 0 for open space",
       .allowed = number(0, kLarge),
       .use = [](Arguments& a, const Value& v) { a.scene.box = v.number(); }},
      {.name = "start-radius",
       .in = kSimulate | kSweep,
       .help = "agents start inside this radius; 0: a quarter of the box",
       .allowed = number(0, kLarge),
       .use = [](Arguments& a, const Value& v) { a.scene.start_radius = v.number(); }},
      {.name = "start-speed",
       .in = kSimulate | kSweep,
       .help = "speed at the start",
       .allowed = number(0, kLarge),
       .use = [](Arguments& a, const Value& v) { a.scene.start_speed = v.number(); }},
      {.name = "curve",
       .in = kSimulate,
       .help = "curve that fastswarm flies along: heart, star, a CSV of points x,y[,z], or an SVG with a polyline",
       .use = [](Arguments& a, const Value& v) { a.scene.curve = v.text(); }},
      {.name = "like",
       .in = kSimulate | kSweep,
       .help = "recording that models learn from that need one, demo if not given; frames are as far apart as its own",
       .use = [](Arguments& a, const Value& v) { a.scene.like = v.text(); }},
      {.name = "check",
       .in = kSimulate,
       .help = "print the numbers that the scenario expects of its motion beside those measured; exit code 1 if they disagree",
       .allowed = on_or_off(),
       .use = [](Arguments& a, const Value& v) { a.check = v.on(); }},
      {.name = "unit",
       .in = kSimulate | kSweep,
       .help = "name of the length unit",
       .use = [](Arguments& a, const Value& v) { a.scene.unit = v.text(); }},
  };
}

}  // namespace

std::vector<Setting> scene_settings() {
  std::vector<Setting> all = {
      {.name = "seeds",
       .in = kRecover,
       .help = "recordings per model",
       .allowed = whole(1, kMostRecordings),
       .initial = "10",
       .use = [](Arguments& a, const Value& v) { a.recovery.seeds = v.whole<int>(); }},
      {.name = "agents",
       .in = kRecover,
       .help = "individuals in a recording",
       .allowed = whole(2, kMostAnimals),
       .initial = "10",
       .use = [](Arguments& a, const Value& v) { a.recovery.film.agents = v.whole<int>(); }},
      {.name = "frames",
       .in = kRecover,
       .help = "frames of a recording, simulated with ten steps per frame",
       .allowed = whole(1, kMostFrames),
       .initial = "300",
       .use = [](Arguments& a, const Value& v) { a.recovery.film.frames = v.whole<std::int64_t>(); }},
  };
  for (const auto& part : {of_all_scenes(), of_recover(), of_simulate()}) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace swarmfit::cli
