// SPDX-License-Identifier: MIT
#include "libswarm/scenario/keys.h"

#include <algorithm>
#include <limits>
#include <string>

namespace swarmfit {
namespace {

using Type = ScenarioKey::Type;

constexpr double kMostSeeds = 9223372036854775807.0;

// Rows longer than a line would be taken apart, one field a line:
// clang-format off
std::vector<ScenarioKey> of_the_file() {
  return {
      {"", "title", Type::text, "one line: what it shows", true},
      {"", "source", Type::text, "where it is published; the model's if not given"},
      {"", "model", Type::text, "with its options, as in bswarm[noise=white]", true},
      {"", "shows", Type::text, "the model of whose manual page it draws the picture"},
      {"", "dims", Type::whole, "dimensions; 3 if the model moves in them", false, {2, 3}},
      {"", "agents", Type::whole, "number of agents, 100 if not given; with [[group]] each has its own", false, {1, kMostCounted}},
      {"", "frames", Type::whole, "frames to write, 500 if not given", false, {1, kMostCounted}},
      {"", "warm_up", Type::whole, "frames to simulate before them, 0 if not given", false, {0, kMostCounted}},
      {"", "fps", Type::number, "frames per second, 100 if not given", false, {1e-6, 1e9}},
      {"", "steps", Type::whole, "steps per frame; as many as the model's own step asks for", false, {1, 10'000}},
      {"", "seed", Type::whole, "of all random numbers, 1 if not given", false, {0, kMostSeeds}},
      {"", "unit", Type::text, "name of the length unit, su if not given"},
      {"", "parameters", Type::by_name, "values of the model's parameters by name, as swarmfit models NAME lists them"},
      {"", "schedule", Type::by_name, "parameters over time, name = [[time, value], ...]: straight between, constant before and after"},
      {"", "bounds", Type::table, "shape of the arena; open if not given"},
      {"", "temperature", Type::table, "how many insects there are, or how dense, from the temperature"},
      {"", "obstacle", Type::tables, "solid bodies that nobody passes through"},
      {"", "stimulus", Type::tables, "what agents fly to or flee from"},
      {"", "goal", Type::tables, "balls that agents head for round obstacles; they need bounds that are a box"},
      {"", "paths", Type::table, "how ways to goals are found"},
      {"", "bridge", Type::table, "a bridge with ants that arrive at both ends"},
      {"", "curve", Type::table, "a line that agents are led along, in either direction"},
      {"", "start", Type::table, "where and how agents begin; a ball about the middle if not given"},
      {"", "group", Type::tables, "agents that begin in the same way"},
      {"", "expect", Type::by_name, "numbers to measure, and what they should be"},
  };
}

std::vector<ScenarioKey> of_the_world() {
  return {
      {"bounds", "shape", Type::choice, "", true, {}, {"open", "box", "sphere", "periodic"}},
      {"bounds", "lower", Type::place, "corner of a box"},
      {"bounds", "upper", Type::place, "the corner opposite"},
      {"bounds", "centre", Type::place, "of a sphere; the origin if not given"},
      {"bounds", "radius", Type::number, "of a sphere", false, kPositive},
      {"bounds", "wall", Type::choice, "what becomes of the velocity into it", false, {}, {"reflect", "slip"}},

      {"obstacle", "shape", Type::choice, "", true, {}, {"sphere", "box", "cylinder", "plane", "mesh"}},
      {"obstacle", "lower", Type::place, "corner of a box, or centre of one end of a cylinder"},
      {"obstacle", "upper", Type::place, "the corner opposite, or the other end"},
      {"obstacle", "centre", Type::place, "of a sphere, or a point of a plane"},
      {"obstacle", "radius", Type::number, "of a sphere or a cylinder", false, kPositive},
      {"obstacle", "normal", Type::place, "of a plane, to the side of the agents"},
      {"obstacle", "file", Type::text, "of a mesh: .obj, .stl or .ply, beside this file"},
      {"obstacle", "scale", Type::number, "by which a mesh is enlarged, 1 if not given", false, kPositive},
      {"obstacle", "at", Type::place, "where the origin of a mesh is put"},
      {"obstacle", "wall", Type::choice, "what becomes of the velocity into it", false, {}, {"reflect", "slip"}},

      {"stimulus", "kind", Type::choice, "", true, {}, {"attract", "repel"}},
      {"stimulus", "at", Type::place, "where it is at t = 0"},
      {"stimulus", "velocity", Type::place, "of a stimulus that moves straight on"},
      {"stimulus", "path", Type::rows, "rows of time and place: straight between"},
      {"stimulus", "lead", Type::place, "how far away from the middle of the swarm it stays"},
      {"stimulus", "ring", Type::table, "for each agent ahead of it on a horizontal circle"},
      {"stimulus", "wander", Type::table, "along curl noise on a leash"},
      {"stimulus", "from", Type::number, "when it comes [s]"},
      {"stimulus", "until", Type::number, "when it leaves [s]"},
      {"ring", "centre", Type::place, "the origin if not given"},
      {"ring", "radius", Type::number, "", true, kPositive},
      {"ring", "ahead", Type::number, "degrees", true, {-180, 180}},
      {"wander", "centre", Type::place, "the origin if not given"},
      {"wander", "radius", Type::number, "length of the leash", true, kPositive},
      {"wander", "scale", Type::number, "feature size of the noise", true, kPositive},
      {"wander", "speed", Type::number, "", true, kNotNegative},

      {"goal", "radius", Type::number, "", true, kPositive},
      {"goal", "at", Type::place, "its centre"},
      {"goal", "path", Type::rows, "rows of time and centre: straight between"},

      {"paths", "cell", Type::number, "side of the cells; a 20th of the shortest side of the bounds", false, kPositive},
      {"paths", "length_weight", Type::number, "cost of a way by length, 0.6 if not given", false, kPositive},
      {"paths", "repulsion_weight", Type::number, "more of it near obstacles, 0.4 if not given", false, kNotNegative},
      {"paths", "reach", Type::number, "of the repulsion; 2.83 cells if not given", false, kNotNegative},

      {"curve", "file", Type::text, "heart, star, a CSV of points x,y[,z], or an SVG with a polyline, beside this file", true},
      {"curve", "spacing", Type::number, "mean distance of its key points, of a shape without lengths", false, kPositive},
      {"curve", "at", Type::place, "where the mean of its key points is put; the origin if not given"},
      {"curve", "reach", Type::number, "within which a key point is reached; a quarter of their distance if not given", false, kPositive},

      {"bridge", "length", Type::number, "", false, kPositive},
      {"bridge", "width", Type::number, "", false, {0, kForever}},
      {"bridge", "mean_interval", Type::number, "mean time between arrivals [s]", false, kPositive},
      {"bridge", "laden", Type::number, "share of ants that carry something", false, {0, 1}},
      {"bridge", "entry_y", Type::number, "where on its width ants arrive; its middle if not given", false, {0, kForever}},
      {"bridge", "entry_y_spread", Type::number, "standard deviation of that", false, {0, kForever}},
      {"bridge", "speed", Type::number, "", false, kPositive},
  };
}

std::vector<ScenarioKey> of_agents() {
  return {
      {"start", "shape", Type::choice, "ball if not given", false, {}, {"ball", "box", "line", "grid", "ring", "curve", "recorded"}},
      {"start", "centre", Type::place, "of a ball or a ring"},
      {"start", "radius", Type::number, "of a ball or a ring, or about the key points of the curve", false, kNotNegative},
      {"start", "lower", Type::place, "corner of a box or a grid, end of a line"},
      {"start", "upper", Type::place, "the corner or the end opposite"},
      {"start", "file", Type::text, "recording, beside this file, whose individuals are where agents begin, and as fast"},
      {"start", "frame", Type::whole, "of that recording; the first if not given", false, {-1e9, 1e9}},
      {"start", "speed", Type::number, "0.3 if not given", false, kNotNegative},
      {"start", "heading", Type::place, "of all; random if not given"},

      {"group", "agents", Type::whole, "", true, {1, kMostCounted}},
      {"group", "kind", Type::text, "among those of the model"},
      {"group", "start", Type::table, "where and how these begin"},
      {"group", "arrive", Type::number, "when the first comes [s]"},
      {"group", "every", Type::number, "time from one to the next [s]", false, kNotNegative},
      {"group", "leave", Type::number, "when all are gone [s]"},

      {"temperature", "celsius", Type::number, "", true, {-50, 60}},
      {"temperature", "volume", Type::number, "of the habitat, in units of the density's; 1 if not given", false, kPositive},
      {"temperature", "follow", Type::text, "parameters that grow and shrink until the swarm is as dense, by name: \"r_rep, r_att\""},
      {"temperature", "unit_volume", Type::number, "of the density, with follow; 1 if not given", false, kPositive},
      {"temperature", "every", Type::number, "time between two looks at the density [s], with follow; 5 if not given", false, kPositive},

      {"expect", "measure", Type::text, "with arguments of its own", true},
      {"expect", "above", Type::number, "least value that is allowed"},
      {"expect", "below", Type::number, "greatest value that is allowed"},
      {"expect", "published", Type::text, "what the source says"},
  };
}
// clang-format on

const std::vector<ScenarioKey>& table() {
  static const std::vector<ScenarioKey> all = [] {
    std::vector<ScenarioKey> keys = of_the_file();
    for (const auto& more : {of_the_world(), of_agents()}) keys.insert(keys.end(), more.begin(), more.end());
    return keys;
  }();
  return all;
}

}  // namespace

std::span<const ScenarioKey> scenario_keys() { return table(); }

const ScenarioKey* find_scenario_key(std::string_view heading, std::string_view name) {
  std::string of(heading);
  std::erase_if(of, [](char c) { return c == '[' || c == ']'; });
  if (of.starts_with("expect."))
    of = "expect";
  else
    of.erase(0, of.rfind('.') == std::string::npos ? 0 : of.rfind('.') + 1);
  const auto found = std::find_if(table().begin(), table().end(), [&](const ScenarioKey& k) { return k.of == of && k.name == name; });
  return found == table().end() ? nullptr : &*found;
}

}  // namespace swarmfit
