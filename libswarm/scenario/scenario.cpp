// SPDX-License-Identifier: MIT
#include "libswarm/scenario/scenario.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "libswarm/scenario/start.h"
#include "libtrack/error.h"

namespace swarmfit {
namespace {

// The world has what the parameter acts on.
bool has(const Scenario& scene, const std::string& part) {
  return part.empty() || (part == "stimuli" && !scene.stimuli.empty()) || (part == "goals" && !scene.goals.empty()) ||
         (part == "curves" && scene.curve);
}

double warm_up_time(const Scenario& scene) { return static_cast<double>(scene.warm_up) * scene.dt; }

// The first frame of the plan that is not before this time.
std::int64_t frame_at(const Scenario& scene, double t) {
  if (t == -std::numeric_limits<double>::infinity()) return 0;
  return std::max<std::int64_t>(0, scene.warm_up + static_cast<std::int64_t>(std::ceil(t / scene.dt - 1e-9)));
}

bool comes_and_goes(const Group& g) { return std::isfinite(g.arrive) || std::isfinite(g.leave); }

std::int64_t last_frame(const Scenario& scene, const Group& g) {
  return std::isfinite(g.leave) ? frame_at(scene, g.leave) - 1 : std::numeric_limits<std::int64_t>::max();
}

// Calls visit(group, start, id, k) for every agent, ids ascending.
template <class Visit>
void for_each_agent_of(const Scenario& scene, Visit&& visit) {
  std::uint32_t id = 0;
  for (const Group& g : scene.groups) {
    if (g.start.shape == Start::Shape::recorded && static_cast<std::size_t>(g.agents) > g.start.points.size())
      throw InputError(
          fmt::format("`agents`: {} cannot begin where {} were recorded; expected as many at most", g.agents, g.start.points.size()));
    const Start start = settled(g.start, scene.bounds, scene.dims);
    for (Index k = 0; k < g.agents; ++k) visit(g, start, id++, k);
  }
}

// Drops the warm-up; frame numbers start at 0.
class FromNow : public FrameSink {
 public:
  FromNow(std::int64_t warm_up, FrameSink& agents, FrameSink* stimuli, const World& world)
      : warm_up_(warm_up), agents_(agents), stimuli_(stimuli), world_(world) {}

  void frame(const Snapshot& now) override {
    const std::int64_t number = now.frame - warm_up_;
    if (number < 0) return;
    agents_.frame({number, now.id, now.kind, now.pos, now.vel, now.own});
    if (stimuli_) show(number);
  }

 private:
  void show(std::int64_t number) const {
    std::vector<std::uint32_t> id;
    std::vector<std::uint8_t> kind;
    std::vector<Eigen::Array3d> places;
    std::uint32_t next = 0;
    const auto add = [&](bool present, std::uint8_t of_kind, const Eigen::Array3d& place) {
      if (present) id.push_back(next), kind.push_back(of_kind), places.push_back(place);
      ++next;
    };
    if (const auto* part = world_.part<Stimuli>())
      for (std::size_t k = 0; k < part->size(); ++k) add(part->present(k), static_cast<std::uint8_t>(part->kind(k)), part->place(k));
    if (const auto* part = world_.part<Paths>())
      for (std::size_t k = 0; k < part->size(); ++k) add(true, 0, part->place(k));
    Rows pos(static_cast<Index>(places.size()), 3);
    for (Index row = 0; row < pos.rows(); ++row) pos.row(row) = places[static_cast<std::size_t>(row)].transpose();
    const Rows vel = Rows::Zero(pos.rows(), 3);
    stimuli_->frame({number, id, kind, pos, vel});
  }

  std::int64_t warm_up_;
  FrameSink& agents_;
  FrameSink* stimuli_;
  const World& world_;
};

}  // namespace

int Scenario::agents() const {
  int sum = 0;
  for (const Group& g : groups) sum += g.agents;
  return sum;
}

int Scenario::steps_per_frame() const {
  if (substeps > 0) return substeps;
  if (model.spec->fixed_step && reference) return 1;
  return std::max(1, static_cast<int>(std::ceil(dt / model.spec->native_dt - 1e-9)));
}

Bounds box_of(double side, int dims) {
  Bounds bounds;
  if (side <= 0) return bounds;
  bounds.kind = Bounds::Kind::box;
  bounds.lower.head(dims).setConstant(-0.5 * side);
  bounds.upper.head(dims).setConstant(0.5 * side);
  return bounds;
}

Scenario plain_scenario(const ModelChoice& model, int dims) {
  constexpr double kBox = 20;
  Scenario scene;
  scene.name = model.name;
  scene.title = model.spec->summary;
  scene.source = model.spec->citation;
  scene.model = model;
  for (const Parameter& p : model.spec->parameters) scene.parameters.push_back(p.scene.initial);
  scene.dims = dims;
  scene.bounds = box_of(kBox, dims);
  return scene;
}

std::size_t parameter_row(const ModelSpec& spec, std::string_view name) {
  const int row = spec.find(name);
  if (row >= 0) return static_cast<std::size_t>(row);
  std::vector<std::string_view> names;
  for (const Parameter& p : spec.parameters) names.push_back(p.name);
  throw InputError(fmt::format("{}: {} has no such parameter; expected one of {}", name, spec.name, fmt::join(names, ", ")));
}

void set_parameter(Scenario& scene, std::string_view name, double value) {
  const std::size_t row = parameter_row(*scene.model.spec, name);
  const Parameter& p = scene.model.spec->parameters[row];
  if (value != 0 && !has(scene, p.needs))
    throw InputError(fmt::format("{0}={1:g}: would do nothing, as there are no {2} here; expected 0, or no {0}", p.name, value, p.needs));
  p.check(value);
  scene.parameters[row] = value;
}

World world_of(const Scenario& scene) {
  World world;
  world.dims = scene.dims;
  world.bounds = scene.bounds;
  if (!scene.stimuli.empty()) world.add(std::make_unique<Stimuli>(scene.stimuli, -warm_up_time(scene)));
  if (!scene.goals.empty()) world.add(std::make_unique<Paths>(scene.paths, scene.goals, scene.obstacles, -warm_up_time(scene)));
  std::vector<Presence::Visit> visits;
  const Rng rng{scene.seed};
  for_each_agent_of(scene, [&](const Group& g, const Start& start, std::uint32_t id, Index k) {
    if (!comes_and_goes(g)) return;
    const Beginning b = beginning(start, rng, id, k, g.agents, scene.dims);
    const auto wait = g.every * static_cast<double>(k);
    const std::int64_t enter = frame_at(scene, std::isfinite(g.arrive) ? g.arrive + wait : g.arrive);
    visits.push_back({.id = id, .kind = g.kind, .enter = enter, .leave = last_frame(scene, g), .pos = b.pos, .vel = b.vel});
  });
  if (!visits.empty()) world.add(std::make_unique<Presence>(std::move(visits)));
  if (!scene.obstacles.empty()) world.add(std::make_unique<Walls>(scene.obstacles));
  if (scene.bridge) world.add(std::make_unique<Bridge>(*scene.bridge));
  if (scene.curve) world.add(std::make_unique<CurveGuide>(*scene.curve));
  return world;
}

State start_of(const Scenario& scene) {
  const Rng rng{scene.seed};
  State state;
  Index present = 0;
  for (const Group& g : scene.groups) present += comes_and_goes(g) ? 0 : g.agents;
  state.append(present);
  Index row = 0;
  for_each_agent_of(scene, [&](const Group& g, const Start& start, std::uint32_t id, Index k) {
    if (comes_and_goes(g)) return;
    const Beginning b = beginning(start, rng, id, k, g.agents, scene.dims);
    state.pos.row(row) = b.pos.transpose();
    state.vel.row(row) = b.vel.transpose();
    state.id[static_cast<std::size_t>(row)] = id;
    state.kind[static_cast<std::size_t>(row)] = g.kind;
    ++row;
  });
  state.next_id = static_cast<std::uint32_t>(scene.agents());
  return state;
}

Plan plan_of(const Scenario& scene) {
  Plan plan;
  plan.frame_dt = scene.dt;
  plan.substeps = scene.steps_per_frame();
  plan.frames = scene.warm_up + scene.frames;
  plan.schedules = scene.schedules;
  plan.feedback = scene.feedback;
  for (Schedule& schedule : plan.schedules)
    for (auto& key : schedule.keys) key.first += warm_up_time(scene);
  return plan;
}

std::unique_ptr<Model> model_of(const Scenario& scene) {
  int kinds = 1;
  for (const Group& g : scene.groups) kinds = std::max(kinds, g.kind + 1);
  return make_model(scene.model, {.dims = scene.dims,
                                  .scales = scene.scales,
                                  .reference = scene.reference.get(),
                                  .step = scene.dt / scene.steps_per_frame(),
                                  .kinds = kinds});
}

Counters play(const Scenario& scene, FrameSink& agents, FrameSink* stimuli) {
  const Plan plan = plan_of(scene);
  const auto rule = model_of(scene);
  Lane lane{scene.parameters, {scene.seed}, start_of(scene), world_of(scene), nullptr, {}, false};
  FromNow from_now(scene.warm_up, agents, stimuli, lane.world);
  lane.out = &from_now;
  cpu_backend().run(*rule, plan, {&lane, 1});
  if (lane.blew_up)
    throw InputError(scene.model.name + ": the simulation diverged; expected parameters and a time step that keep motion finite");
  return lane.count;
}

TrackMeta meta_of(const Scenario& scene) {
  TrackMeta meta;
  meta.dims = scene.dims;
  meta.dt = scene.dt;
  meta.unit = scene.unit;
  meta.kinds = scene.model.spec->kinds;
  meta.from.path = scene.name;
  meta.from.format = "simulated";
  meta.from.synthetic = true;
  return meta;
}

}  // namespace swarmfit
