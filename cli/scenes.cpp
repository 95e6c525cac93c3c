// SPDX-License-Identifier: MIT
#include "cli/scenes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "cli/parse.h"
#include "cli/recordings.h"
#include "fit/experiment/conditions.h"
#include "fit/experiment/plant.h"
#include "fit/synthesis/extend.h"
#include "libswarm/centre.h"
#include "libswarm/scenario/surroundings.h"
#include "libtrack/error.h"
#include "libtrack/file.h"

namespace swarmfit::cli {
namespace {

const ScenarioFile* find_scenario(std::string_view name) {
  const auto all = scenario_files();
  const auto found = std::find_if(all.begin(), all.end(), [&](const ScenarioFile& f) { return f.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::string scenario_names() {
  std::vector<std::string_view> names;
  for (const ScenarioFile& file : scenario_files()) names.push_back(file.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string learners() {
  std::vector<std::string_view> names;
  for (const ModelSpec& spec : models())
    if (spec.needs_reference) names.push_back(spec.name);
  return fmt::format("{}", fmt::join(names, " or "));
}

bool is_file(std::string_view text) { return text.ends_with(".toml") || text.find('/') != text.npos; }

const char* const kLearnedFrom = "demo";

// A model alone that learns from a recording: as fits begin, in the recording's units and in open space.
void settle_at_the_recording(Scenario& scene) {
  if (!scene.reference) return;
  const Tracks& recording = *scene.reference;
  scene.scales = natural_scales(recording);
  scene.parameters = pilot_parameters({scene.model, {}}, scene.scales);
  scene.dims = recording.dims();
  scene.dt = recording.dt();
  scene.unit = recording.meta().unit;
  scene.bounds = {};
  scene.groups.front().start.radius = scene.scales.extent;
  scene.groups.front().start.speed = scene.scales.speed;
}

// A scenario, or else a model.
Scenario found(const SceneArguments& a) {
  const std::string& text = a.scene;
  if (find_scenario(text)) return scenario_named(text);
  if (is_file(text)) return read_scenario(text, read_file(text));
  try {
    const ModelChoice model = parse_model(text);
    const auto& dims = model.spec->dims;
    return plain_scenario(model, a.dims.value_or(*std::max_element(dims.begin(), dims.end())));
  } catch (const InputError& e) {
    if (text.find('[') != text.npos) throw;
    throw InputError(fmt::format("{}; a scenario: {}; or a file that ends on .toml", e.what(), scenario_names()));
  }
}

// The same with the recording that it learns from, if it does.
Scenario found_with_recording(const SceneArguments& a) {
  Scenario scene = found(a);
  if (a.like && !scene.model.spec->needs_reference)
    throw InputError(fmt::format("`like`: {} learns from no recording; expected a model that does: {}", scene.model.name, learners()));
  learn_from(scene, a.like.value_or(kLearnedFrom));
  if (scene.name == scene.model.name) settle_at_the_recording(scene);
  return scene;
}

void resize(Scenario& scene, int agents) {
  if (scene.groups.size() > 1)
    throw InputError(fmt::format("--agents: {} has {} groups; expected a scenario with one, or a file with other numbers", scene.name,
                                 scene.groups.size()));
  scene.groups.front().agents = agents;
}

// Another box: who began where the old one decides begins where the new one does.
void rebox(Scenario& scene, const SceneArguments& a) {
  if (a.box) scene.bounds = box_of(*a.box, scene.dims);
  for (Group& g : scene.groups) {
    Start& s = g.start;
    if (a.start_radius || (a.box && s.shape == Start::Shape::ball)) {
      s.shape = Start::Shape::ball;
      s.radius = a.start_radius.value_or(0);
      if (s.radius == 0 && scene.bounds.kind == Bounds::Kind::box) s.radius = (scene.bounds.upper - scene.bounds.lower)[0] / 4;
      s.centre = middle_of(scene.bounds);
    }
    if (a.start_speed) s.speed = *a.start_speed;
  }
}

// Walls from a file instead of the scenario's own.
void surround(Scenario& scene, const SceneArguments& a) {
  if (a.world.path.empty()) return;
  if (!scene.goals.empty())
    throw InputError(fmt::format("`world`: ways to the goals of {} are found in its own; expected a scenario without goals", scene.name));
  if (a.box) throw InputError("`world`: is given together with box; expected one of the two");
  Surroundings around = read_surroundings(a.world.path, a.world.text, scene.dims);
  scene.bounds = around.bounds;
  scene.obstacles = std::move(around.obstacles);
}

}  // namespace

const ScenarioFile& scenario_file(std::string_view name) {
  if (const auto* file = find_scenario(name)) return *file;
  throw InputError(fmt::format("scenario '{}': unknown; expected one of {}", name, scenario_names()));
}

Scenario scenario_named(std::string_view name) {
  const ScenarioFile& file = scenario_file(name);
  return read_scenario(fmt::format("scenarios/{}.toml", file.name), std::string(file.text));
}

Scenario scenario_of(const SceneArguments& a) {
  Scenario scene = found_with_recording(a);
  if (a.dims && *a.dims != scene.dims)
    throw InputError(fmt::format("--dims: {} is a scene in {} dimensions; expected {}", scene.name, scene.dims, scene.dims));
  if (a.agents) resize(scene, *a.agents);
  surround(scene, a);
  rebox(scene, a);
  scene.seed = a.seed.value_or(scene.seed);
  scene.frames = a.frames.value_or(scene.frames);
  scene.warm_up = a.warm_up.value_or(scene.warm_up);
  scene.unit = a.unit.value_or(scene.unit);
  if (a.fps) scene.dt = 1 / *a.fps;
  if (!a.curve.empty()) lead_along(scene, a);
  for (const auto& [name, value] : parse_assignments(a.set)) {
    try {
      set_parameter(scene, name, value);
    } catch (const InputError& e) {
      throw InputError(fmt::format("--set {}", e.what()));
    }
  }
  return scene;
}

void learn_from(Scenario& scene, const std::string& recording) {
  if (scene.model.spec->needs_reference) scene.reference = std::make_shared<const Tracks>(load(Arguments(), recording));
}

ModelCard card_of(const Scenario& scene) {
  return {scene.name, scene.title, scene.source, scene_table(scene.model, scene.parameters, scene.unit)};
}

ListEntry scenario_entry(const Scenario& scene) {
  return {scene.name,
          scene.title,
          {{"model", scene.model.name},
           {"agents", fmt::format("{} for {} frames of {:.3g} s", scene.agents(), scene.frames, scene.dt)},
           {"source", scene.source}}};
}

std::string scene_showing(std::string_view model) {
  for (const ScenarioFile& file : scenario_files())
    if (scenario_named(file.name).shows == model) return std::string(file.name);
  return std::string(model);
}

}  // namespace swarmfit::cli
