// SPDX-License-Identifier: MIT
#include "fit/experiment/plant.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "fit/experiment/observe.h"
#include "libswarm/centre.h"
#include "libswarm/scenario/scenario.h"
#include "libtrack/error.h"

namespace swarmfit {
namespace {

// Drops what the camera missed.
class Dropouts : public FrameSink {
 public:
  Dropouts(const Scenario& scene, const Camera& camera, FrameSink& out)
      : rng_{scene.seed}, camera_(camera), out_(out), hidden_until_(static_cast<std::size_t>(scene.agents()), 0) {}

  void frame(const Snapshot& now) override {
    id_.clear(), kind_.clear(), rows_.clear();
    for (std::size_t i = 0; i < now.id.size(); ++i) {
      if (missed(now.id[i], now.frame)) continue;
      id_.push_back(now.id[i]);
      kind_.push_back(now.kind[i]);
      rows_.push_back(static_cast<Index>(i));
    }
    const Rows pos = now.pos(rows_, Eigen::all), vel = now.vel(rows_, Eigen::all);
    out_.frame({now.frame, id_, kind_, pos, vel});
  }

 private:
  bool missed(std::uint32_t id, std::int64_t frame) {
    const auto u = rng_.uniform2(Stream::dropout, static_cast<std::uint64_t>(frame), id);
    if (id >= hidden_until_.size()) hidden_until_.resize(id + std::size_t{1}, 0);  // arrived on the way
    auto& until = hidden_until_[id];
    if (frame >= until && u[0] < camera_.dropout) until = frame + 1 + static_cast<std::int64_t>(u[1] * camera_.longest_gap);
    return frame < until;
  }

  Rng rng_;
  const Camera& camera_;
  FrameSink& out_;
  std::vector<std::int64_t> hidden_until_;
  std::vector<std::uint32_t> id_;
  std::vector<std::uint8_t> kind_;
  std::vector<Index> rows_;
};

}  // namespace

void refuse_idle(const char* flag, const Parameter& row, double value) {
  if (row.needs.empty() || value == 0) return;
  throw InputError(
      fmt::format("{0} {1}={2:g}: would do nothing, as there are no {3} here; expected 0, or no {1}", flag, row.name, value, row.needs));
}

std::vector<double> scene_parameters(const ModelChoice& model, const std::map<std::string, double>& set) {
  std::vector<double> values;
  std::vector<std::string_view> names;
  for (const auto& p : model.spec->parameters) values.push_back(p.scene.initial), names.push_back(p.name);
  for (const auto& [name, value] : set) {
    const int row = model.spec->find(name);
    if (row < 0)
      throw InputError(
          fmt::format("`set` {}: {} has no such parameter; expected one of {}", name, model.spec->name, fmt::join(names, ", ")));
    refuse_idle("`set`", model.spec->parameters[static_cast<std::size_t>(row)], value);
    values[static_cast<std::size_t>(row)] = value;
  }
  return values;
}

std::vector<ParameterResult> scene_table(const ModelChoice& model, const std::vector<double>& parameters, const std::string& unit) {
  std::vector<ParameterResult> table;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const Parameter& row = model.spec->parameters[p];
    if (!model.spec->uses(p, model.options)) continue;
    table.push_back({std::string(row.name), std::string(row.symbol), to_string(row.unit, unit), std::string(row.meaning), parameters[p],
                     row.scene.lower, row.scene.upper, false, row.log});
  }
  return table;
}

Film film(const Scenario& scene, const Camera& camera) {
  TrackCollector collector, stimuli;
  const double sigma = camera.sigma;
  Observer error(nullptr, scene.dims == 3 ? Eigen::Array3d::Constant(sigma) : Eigen::Array3d(sigma, sigma, 0), {scene.seed}, collector);
  Dropouts dropouts(scene, camera, error);
  Film made;
  made.count = play(scene, dropouts, &stimuli);
  made.tracks = collector.take(meta_of(scene));
  made.stimuli = stimuli.take(meta_of(scene));
  return made;
}

Tracks plant(const ModelChoice& model, const std::vector<double>& parameters, const PlantOptions& options) {
  Scenario scene;
  scene.name = options.path;
  scene.model = model;
  scene.parameters = parameters;
  scene.scales = options.scales;
  scene.reference = {std::shared_ptr<void>(), options.reference};  // the caller's
  scene.dims = options.dims;
  scene.frames = options.frames;
  scene.warm_up = options.warm_up;
  scene.dt = options.dt;
  scene.substeps = options.substeps;
  scene.seed = options.seed;
  scene.unit = options.unit;
  scene.bounds = options.arena;
  Group& group = scene.groups.front();
  group.agents = options.agents;
  group.start.centre = middle_of(options.arena);
  group.start.radius = options.start_radius;
  group.start.speed = options.start_speed;
  Tracks tracks = film(scene, {options.sigma, options.dropout, options.longest_gap}).tracks;
  if (options.notes.empty()) return tracks;
  TrackMeta meta = tracks.meta();
  meta.from.notes = options.notes;
  return Tracks(tracks.columns(), std::move(meta));
}

}  // namespace swarmfit
