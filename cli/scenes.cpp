// SPDX-License-Identifier: MIT
#include "cli/scenes.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "cli/parse.h"
#include "cli/recordings.h"
#include "fit/experiment/plant.h"

namespace swarmfit::cli {
namespace {

Bounds box(double side, int dims) {
  Bounds bounds;
  if (side <= 0) return bounds;
  bounds.kind = Bounds::Kind::box;
  bounds.lower.head(dims).setConstant(-0.5 * side);
  bounds.upper.head(dims).setConstant(0.5 * side);
  return bounds;
}

struct Motif {
  const char* model;
  int agents;
  std::int64_t frames, warm_up;
  double fps, box, start_radius;
  int dims;
  std::vector<std::string> set;
};

// The last one is for all others.
const std::vector<Motif>& motifs() {
  static const std::vector<Motif> all = {
      {"boids", 80, 40, 100, 60, 20, 0, 3, {"radius=3", "speed=4"}},
      {"noise_aware", 70, 150, 300, 60, 0, 5, 3, {"cage=6", "scale=3"}},
      {"vicsek", 90, 24, 12, 1, 0, 3.5, 2, {"radius=0.7"}},
      {"rvo", 60, 50, 100, 20, 0, 3, 3, {"max_speed=0.8", "radius=0.15"}},
      {"brownian", 60, 60, 300, 60, 0, 2, 3, {}},
      {"langevin", 60, 80, 300, 60, 0, 2, 3, {}},
      {"fastswarm", 60, 80, 100, 50, 0, 120, 3, {"d_rep=25", "inner=45", "outer=120", "scale=60", "w_cos=0.5"}},
      {"zonal", 80, 18, 1500, 10, 0, 4, 3, {"blind=1.5708"}},
      {"", 60, 60, 300, 60, 20, 0, 3, {}},
  };
  return all;
}

const Motif& motif_of(const std::string& model) {
  for (const Motif& m : motifs())
    if (model == m.model) return m;
  return motifs().back();
}

}  // namespace

Scene simulated(const SceneArguments& a) {
  Scene scene{parse_model(a.model), {}, {}};
  if (!a.curve.empty()) return along_curve(a);
  PlantOptions o;
  o.dims = a.dims;
  o.agents = a.agents;
  o.frames = a.frames;
  o.dt = 1 / a.fps;
  o.substeps = scene.model.spec->fixed_step ? 1 : std::max(1, static_cast<int>(std::ceil(o.dt / scene.model.spec->native_dt - 1e-9)));
  o.warm_up = a.warm_up;
  o.arena = box(a.box, a.dims);
  o.start_radius = a.start_radius > 0 ? a.start_radius : a.box > 0 ? a.box / 4 : 1;
  o.start_speed = a.start_speed;
  o.sigma = a.noise;
  o.dropout = a.dropout;
  o.seed = a.seed;
  o.unit = a.unit;
  o.path = scene.model.name;
  scene.parameters = scene_parameters(scene.model, parse_assignments(a.set));
  const auto like = scene.model.spec->needs_reference ? std::optional(load({}, a.like, {})) : std::nullopt;
  o.reference = like ? &*like : nullptr;
  scene.tracks = plant(scene.model, scene.parameters, o);
  return scene;
}

ModelCard card_of(const Scene& scene) {
  return {scene.model.name, std::string(scene.model.spec->summary), std::string(scene.model.spec->citation),
          scene_table(scene.model, scene.parameters, scene.tracks.meta().unit)};
}

SceneArguments scene_of(const std::string& model) {
  const Motif& m = motif_of(model);
  SceneArguments a;
  a.model = model;
  a.agents = m.agents;
  a.frames = m.frames;
  a.warm_up = m.warm_up;
  a.fps = m.fps;
  a.box = m.box;
  a.start_radius = m.start_radius;
  a.dims = m.dims;
  a.set = m.set;
  return a;
}

std::string scene_flags(const std::string& model, std::int64_t frames) {
  const Motif& m = motif_of(model);
  std::string out =
      fmt::format("--agents {} --frames {} --warm-up {} --fps {:g}", m.agents, frames > 0 ? frames : m.frames, m.warm_up, m.fps);
  if (m.dims != 3) out += fmt::format(" --dims {}", m.dims);
  if (m.box != 20) out += fmt::format(" --box {:g}", m.box);
  if (m.start_radius > 0) out += fmt::format(" --start-radius {:g}", m.start_radius);
  for (const auto& set : m.set) out += " --set " + set;
  return out;
}

}  // namespace swarmfit::cli
