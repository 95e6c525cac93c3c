// SPDX-License-Identifier: MIT
#include "fit/experiment/plant.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>

#include "fit/experiment/observe.h"
#include "libswarm/centre.h"
#include "libswarm/simulate.h"
#include "libtrack/error.h"

namespace swarmfit {
namespace {

// A random unit vector: uniform on the sphere, or on the circle in two dimensions (Archimedes' hat-box theorem).
Eigen::Array3d direction(const std::array<double, 2>& u, int dims) {
  const double angle = 2 * std::numbers::pi * u[0];
  const double z = dims == 3 ? 2 * u[1] - 1 : 0;
  const double radius = std::sqrt(1 - z * z);
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

State start(const PlantOptions& o) {
  const Rng rng{o.seed};
  State state;
  const Eigen::Array3d centre = middle_of(o.arena);
  state.append(o.agents);
  for (Index i = 0; i < state.size(); ++i) {
    const std::uint32_t id = state.id[static_cast<std::size_t>(i)];
    const double r = o.start_radius * std::pow(rng.uniform(Stream::start, 0, id, 0), 1.0 / o.dims);
    state.pos.row(i) = (centre + r * direction(rng.uniform2(Stream::start, 0, id, 1), o.dims)).transpose();
    state.vel.row(i) = (o.start_speed * direction(rng.uniform2(Stream::start, 0, id, 2), o.dims)).transpose();
  }
  return state;
}

// Drops the warm-up and what the camera missed; frame numbers start at 0.
class Camera : public FrameSink {
 public:
  Camera(const PlantOptions& options, FrameSink& out)
      : options_(options), out_(out), hidden_until_(static_cast<std::size_t>(options.agents), 0) {}

  void frame(const Snapshot& now) override {
    const std::int64_t number = now.frame - options_.warm_up;
    if (number < 0) return;
    std::vector<std::uint32_t> id;
    std::vector<std::uint8_t> kind;
    std::vector<Index> rows;
    for (std::size_t i = 0; i < now.id.size(); ++i) {
      if (missed(now.id[i], number)) continue;
      id.push_back(now.id[i]);
      kind.push_back(now.kind[i]);
      rows.push_back(static_cast<Index>(i));
    }
    const Rows pos = now.pos(rows, Eigen::all), vel = now.vel(rows, Eigen::all);
    out_.frame({number, id, kind, pos, vel});
  }

 private:
  bool missed(std::uint32_t id, std::int64_t number) {
    const auto u = Rng{options_.seed}.uniform2(Stream::dropout, static_cast<std::uint64_t>(number), id);
    auto& until = hidden_until_[id];
    if (number >= until && u[0] < options_.dropout) until = number + 1 + static_cast<std::int64_t>(u[1] * options_.longest_gap);
    return number < until;
  }

  const PlantOptions& options_;
  FrameSink& out_;
  std::vector<std::int64_t> hidden_until_;
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

Tracks plant(const ModelChoice& model, const std::vector<double>& parameters, const PlantOptions& options) {
  TrackCollector collector;
  Observer error(nullptr, options.dims == 3 ? Eigen::Array3d::Constant(options.sigma) : Eigen::Array3d(options.sigma, options.sigma, 0),
                 {options.seed}, collector);
  Camera camera(options, error);
  Plan plan;
  plan.frame_dt = options.dt;
  plan.substeps = options.substeps;
  plan.frames = options.warm_up + options.frames;
  const auto rule = make_model(
      model, {.dims = options.dims, .scales = options.scales, .reference = options.reference, .step = plan.frame_dt / plan.substeps});
  World world;
  world.dims = options.dims;
  world.bounds = options.arena;
  Lane lane{parameters, {options.seed}, start(options), world, &camera, {}, false};
  cpu_backend().run(*rule, plan, {&lane, 1});
  if (lane.blew_up) throw InputError(model.name + ": the simulation blew up; expected parameters and a time step that keep motion finite");
  TrackMeta meta;
  meta.dims = options.dims;
  meta.dt = options.dt;
  meta.unit = options.unit;
  meta.from.path = options.path;
  meta.from.notes = options.notes;
  meta.from.format = "simulated";
  meta.from.synthetic = true;
  return collector.take(meta);
}

}  // namespace swarmfit
