// SPDX-License-Identifier: MIT
#include "libswarm/scenario/read.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

#include "libswarm/centre.h"
#include "libswarm/scenario/read_start.h"
#include "libswarm/scenario/surroundings.h"
#include "libswarm/scenario/table.h"
#include "libswarm/temperature.h"
#include "libtrack/error.h"
#include "libtrack/read/read_curve.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;
using Words = std::vector<std::string_view>;

constexpr double kMostCells = 1e8;  // of the grid in which ways are looked for

// Puts the place in front of what a room lower down refuses.
template <class Do>
void placed(const std::string& place, Do&& what) {
  try {
    what();
  } catch (const InputError& e) {
    throw InputError(place + e.what());
  }
}

// Rows of time and place.
std::vector<Stimulus::Key> keys_of(Table& table, int dims) {
  std::vector<Stimulus::Key> keys;
  for (const auto& row : table.rows("path", static_cast<std::size_t>(dims) + 1))
    keys.push_back({row[0], Array3d(row[1], row[2], dims == 3 ? row[3] : 0)});
  return keys;
}

Goal goal_of(Table table, int dims) {
  Goal g;
  g.radius = table.number("radius", std::nullopt);
  if (table.has("path"))
    g.path = keys_of(table, dims);
  else
    g.centre = table.place("at", std::nullopt, dims);
  table.finish();
  return g;
}

// A grid over the bounds, which have to be a box.
void read_paths(Table& root, Scenario& scene) {
  for (const Table& table : root.tables("goal")) scene.goals.push_back(goal_of(table, scene.dims));
  auto table = root.table("paths");
  if (scene.goals.empty() && table) table->refuse("[paths] lead nowhere; expected [[goal]]");
  if (scene.goals.empty()) return;
  if (scene.bounds.kind != Bounds::Kind::box)
    root.refuse("goal", "is looked for in a grid over the bounds; expected [bounds] shape = \"box\"");
  FieldGrid& grid = scene.paths.grid;
  const Eigen::Array3d sides = scene.bounds.upper - scene.bounds.lower;
  const double shortest = sides.head(scene.dims).minCoeff();
  grid.lower = scene.bounds.lower;
  grid.cell = table ? table->number("cell", shortest / 20, {1e-9, shortest}) : shortest / 20;
  double cells = 1;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(scene.dims); ++axis) {
    const double count = std::ceil(sides[static_cast<Index>(axis)] / grid.cell - 1e-9);
    cells *= count;
    if (cells > kMostCells)
      table->refuse("cell", fmt::format("= {:g} makes more than {:g} cells; expected larger ones", grid.cell, kMostCells));
    grid.count[axis] = static_cast<Index>(count);
  }
  if (!table) return;
  scene.paths.length_weight = table->number("length_weight", scene.paths.length_weight);
  scene.paths.repulsion_weight = table->number("repulsion_weight", scene.paths.repulsion_weight);
  scene.paths.reach = table->number("reach", 0);
  table->finish();
}

BridgeShape bridge_of(Table table) {
  BridgeShape bridge;
  bridge.length = table.number("length", bridge.length);
  bridge.width = table.number("width", bridge.width);
  bridge.mean_interval = table.number("mean_interval", bridge.mean_interval);
  bridge.laden = table.number("laden", bridge.laden);
  bridge.entry_y = table.number("entry_y", bridge.width / 2);
  bridge.entry_y_spread = table.number("entry_y_spread", bridge.entry_y_spread);
  bridge.speed = table.number("speed", bridge.speed);
  table.finish();
  return bridge;
}

CurveToFollow curve_of(Table table, int dims) {
  const std::string file = table.text("file", std::nullopt);
  const DrawnCurve drawn = read_curve(file == "heart" || file == "star" ? file : table.beside(file));
  CurveToFollow way{drawn.curve, 0};
  if (drawn.in_units && (table.has("spacing") || table.has("at")))
    table.refuse("file", fmt::format("= '{}' has lengths of its own; expected neither spacing nor at beside it", file));
  if (!drawn.in_units) {
    const double factor = table.number("spacing", std::nullopt) / drawn.curve.spacing();
    way.curve = placed(drawn.curve, factor, table.place("at", Array3d::Zero(), dims), dims == 3);
  }
  way.reach = table.number("reach", usual_reach(way.curve));
  table.finish();
  return way;
}

// How it moves is told by the one of these keys that is there.
void motion_of(Table& table, Stimulus& s, int dims) {
  using enum Stimulus::Motion;
  if (table.has("path")) {
    s.motion = path;
    s.path = keys_of(table, dims);
  } else if (table.has("lead")) {
    s.motion = lead;
    s.offset = table.place("lead", std::nullopt, dims);
  } else if (auto round = table.table("ring")) {
    s.motion = ring;
    s.start = round->place("centre", Array3d::Zero(), dims);
    s.radius = round->number("radius", std::nullopt);
    s.ahead = round->number("ahead", std::nullopt) * std::numbers::pi / 180;
    round->finish();
  } else if (auto way = table.table("wander")) {
    s.motion = wander;
    s.start = way->place("centre", Array3d::Zero(), dims);
    s.radius = way->number("radius", std::nullopt);
    s.scale = way->number("scale", std::nullopt);
    s.speed = way->number("speed", std::nullopt);
    way->finish();
  } else if (table.has("at")) {
    s.start = table.place("at", std::nullopt, dims);
    s.velocity = table.place("velocity", Array3d::Zero(), dims);
  } else {
    table.refuse("[[stimulus]] is nowhere; expected one of at, path, lead, ring, wander");
  }
}

Stimulus stimulus_of(Table table, int dims) {
  Stimulus s;
  s.kind = table.choice("kind", std::nullopt) == "attract" ? Stimulus::Kind::attract : Stimulus::Kind::repel;
  motion_of(table, s, dims);
  s.from = table.number("from", -kForever);
  s.until = table.number("until", kForever);
  table.finish();
  return s;
}

std::uint8_t kind_of(Table& table, const ModelSpec& spec) {
  if (!table.has("kind")) return 0;
  if (spec.kinds.empty()) table.refuse("kind", fmt::format("is given, but {} has one kind of agents; expected no kind", spec.name));
  const Words names(spec.kinds.begin(), spec.kinds.end());
  const auto name = table.choice("kind", names, std::nullopt);
  return static_cast<std::uint8_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

// As many as were recorded, where they begin so and nothing else is said.
int agents_of(Table& table, const Start& start, std::optional<std::int64_t> otherwise) {
  if (start.shape != Start::Shape::recorded) return static_cast<int>(table.whole("agents", otherwise));
  const auto there = static_cast<std::int64_t>(start.points.size()), agents = table.whole("agents", there);
  if (agents > there) table.refuse("agents", fmt::format("= {}, but {} were recorded; expected as many at most", agents, there));
  return static_cast<int>(agents);
}

Group group_of(Table table, const Scenario& scene, const Start& otherwise) {
  Group g;
  g.kind = kind_of(table, *scene.model.spec);
  g.start = otherwise;
  if (auto start = table.table("start")) g.start = read_start(*start, scene);
  g.agents = agents_of(table, g.start, std::nullopt);
  g.arrive = table.number("arrive", g.arrive);
  g.every = table.number("every", 0);
  g.leave = table.number("leave", g.leave);
  if (table.has("every") && !table.has("arrive")) table.refuse("every", "is given without arrive; expected both");
  table.finish();
  return g;
}

// As many as live in the habitat at that temperature.
int agents_at(Table& table, double celsius, Table& root, std::size_t groups) {
  const double volume = table.number("volume", 1);
  if (root.has("agents") || groups > 1)
    table.refuse("[temperature] says how many agents there are; expected neither agents nor several [[group]]");
  const double count = std::round(insects_at(celsius) * volume);
  if (!(count >= 1 && count <= kMostCounted))
    table.refuse("celsius", fmt::format("= {:g} makes {:.0f} insects; expected 1 to {}", celsius, count, kMostCounted));
  return static_cast<int>(count);
}

// Parameters that grow and shrink until the swarm is as dense as at that temperature.
DensityFeedback feedback_of(Table& table, double celsius, const Scenario& scene) {
  DensityFeedback out;
  const ModelSpec& spec = *scene.model.spec;
  std::string names = table.text("follow", std::nullopt);
  std::replace(names.begin(), names.end(), ',', ' ');
  std::istringstream words(names);
  for (std::string name; words >> name;)
    placed(table.place_of("follow") + "[temperature] follow: ", [&] {
      out.parameters.push_back(parameter_row(spec, name));
      if (const Unit unit = spec.parameters[out.parameters.back()].unit; unit.length != 1 || unit.time != 0)
        throw InputError(fmt::format("{} is not a length; expected radii of {}", name, spec.name));
    });
  if (out.parameters.empty()) table.refuse("follow", "names no parameter; expected radii of the model");
  out.density = insects_at(celsius) / table.number("unit_volume", 1);
  if (!(out.density > 0)) table.refuse("celsius", fmt::format("= {:g} leaves no insects; expected 9 to 35", celsius));
  out.every = std::max<std::int64_t>(1, std::llround(table.number("every", 5) / scene.dt));
  return out;
}

void read_temperature(Table table, Table& root, Scenario& scene) {
  const double celsius = table.number("celsius", std::nullopt);
  if (table.has("follow"))
    scene.feedback = feedback_of(table, celsius, scene);
  else
    scene.groups.front().agents = agents_at(table, celsius, root, scene.groups.size());
  table.finish();
}

std::vector<Group> groups_of(Table& root, const Scenario& scene) {
  Start start;
  if (auto table = root.table("start")) start = read_start(*table, scene);
  std::vector<Group> groups;
  for (Table& table : root.tables("group")) groups.push_back(group_of(table, scene, start));
  if (groups.empty()) {
    groups.emplace_back();
    groups.front().agents = agents_of(root, start, 100);
    groups.front().start = start;
  } else if (root.has("agents")) {
    root.refuse("agents", "is given together with [[group]]; expected agents of each group");
  }
  std::int64_t all = 0;
  for (const Group& g : groups) all += g.agents;
  if (static_cast<double>(all) > kMostCounted) root.refuse(fmt::format("{} agents; expected at most {}", all, kMostCounted));
  return groups;
}

void read_parameters(Table& root, Scenario& scene) {
  auto table = root.table("parameters");
  if (!table) return;
  for (const auto& name : table->keys())
    placed(table->place_of(name) + "[parameters] ", [&] { set_parameter(scene, name, table->number(name, std::nullopt, {-1e12, 1e12})); });
}

void read_schedules(Table& root, Scenario& scene) {
  auto table = root.table("schedule");
  if (!table) return;
  for (const auto& name : table->keys()) {
    const auto rows = table->rows(name, 2);
    placed(table->place_of(name) + "[schedule] ", [&] { set_parameter(scene, name, rows.front()[1]); });
    Schedule schedule{.parameter = static_cast<std::size_t>(scene.model.spec->find(name)), .keys = {}};
    for (const auto& row : rows) schedule.keys.emplace_back(row[0], row[1]);
    scene.schedules.push_back(std::move(schedule));
  }
}

Expectation expectation_of(const std::string& name, Table table) {
  Expectation e;
  e.name = name;
  e.measure = table.text("measure", std::nullopt);
  e.above = table.number("above", e.above);
  e.below = table.number("below", e.below);
  e.published = table.text("published", "");
  e.place = table.place_of("measure");
  if (!table.has("above") && !table.has("below"))
    table.refuse(fmt::format("[expect.{}] bounds nothing; expected above, below or both", name));
  if (!(e.above <= e.below)) table.refuse("above", fmt::format("= {:g} is more than below = {:g}; expected less", e.above, e.below));
  for (const auto& key : table.keys())
    if (key != "measure" && key != "above" && key != "below" && key != "published") e.arguments.emplace_back(key, table.numbers(key));
  table.finish();
  return e;
}

void read_expectations(Table& root, Scenario& scene) {
  auto table = root.table("expect");
  if (!table) return;
  for (const auto& name : table->keys()) {
    auto one = table->table(name);
    scene.expectations.push_back(expectation_of(name, *one));
  }
}

Scenario about(Table& root) {
  Scenario scene;
  placed(root.place_of("model"), [&] { scene = plain_scenario(parse_model(root.text("model", std::nullopt))); });
  const ModelSpec& spec = *scene.model.spec;
  scene.title = root.text("title", std::nullopt);
  scene.source = root.text("source", scene.source);
  scene.shows = root.text("shows", "");
  if (!scene.shows.empty() && scene.shows != spec.name)
    root.refuse("shows", fmt::format("= '{}' is not the model; expected {}", scene.shows, spec.name));
  scene.dims = static_cast<int>(root.whole("dims", std::find(spec.dims.begin(), spec.dims.end(), 3) != spec.dims.end() ? 3 : 2));
  if (std::find(spec.dims.begin(), spec.dims.end(), scene.dims) == spec.dims.end())
    root.refuse("dims", fmt::format("= {}, in which {} does not move; expected {}", scene.dims, spec.name, fmt::join(spec.dims, " or ")));
  scene.frames = root.whole("frames", scene.frames);
  scene.warm_up = root.whole("warm_up", 0);
  scene.dt = 1 / root.number("fps", 100);
  scene.substeps = static_cast<int>(root.whole("steps", 0));
  scene.seed = static_cast<std::uint64_t>(root.whole("seed", 1));
  scene.unit = root.text("unit", scene.unit);
  return scene;
}

std::string stem(const std::string& path) {
  std::string name = path.substr(path.find_last_of('/') + 1);
  return name.ends_with(".toml") ? name.substr(0, name.size() - 5) : name;
}

}  // namespace

Scenario read_scenario(const std::string& path, const std::string& text) {
  const Node file = parse_toml(path, text);
  Table root(path, file, "");
  Scenario scene = about(root);
  scene.name = stem(path);
  scene.bounds = {};
  if (auto table = root.table("bounds")) scene.bounds = read_bounds(*table, scene.dims);
  for (const Table& table : root.tables("obstacle")) scene.obstacles.push_back(read_obstacle(table, scene.dims));
  for (const Table& table : root.tables("stimulus")) scene.stimuli.push_back(stimulus_of(table, scene.dims));
  read_paths(root, scene);
  if (auto table = root.table("bridge")) scene.bridge = bridge_of(*table);
  if (auto table = root.table("curve")) scene.curve = curve_of(*table, scene.dims);
  read_parameters(root, scene);
  read_schedules(root, scene);
  scene.groups = groups_of(root, scene);
  if (auto table = root.table("temperature")) read_temperature(*table, root, scene);
  read_expectations(root, scene);
  root.finish();
  return scene;
}

}  // namespace swarmfit
