// SPDX-License-Identifier: MIT
// Agent-steps of every model at one density: agents all over a box and hardly moving, the state in which a scene starts. Each has about 20
// others within the radius that its model looks around in, `bswarm` with Table 1 some 70. "settled": after 5 s, when Table 1 has drawn it
// together. Items are agent-steps. Names are model/whose/agents.
#include <benchmark/benchmark.h>

#include <map>

#include "libswarm/noise.h"
#include "libswarm/simulate.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

// Parameters that give about 20 neighbours at this density, where the scene's defaults do not.
constexpr double kDensity = 0.125;  // agents per cubic unit: 1000 in the arena of Table 1
const std::map<std::string_view, std::vector<std::pair<std::string_view, double>>> kLook{
    {"boids", {{"radius", 3.4}}},      {"rvo", {{"neighbour_distance", 3.4}}},
    {"brownian", {{"l_r", 3.4 / 30}}},  // forces reach 30 ranges
    {"vicsek", {{"radius", 3.4}}},     {"zonal", {{"r_rep", 0.5}, {"r_ori", 1}, {"r_att", 1.9}}},
};

Lane scene(const ModelSpec& spec, Index agents) {
  Lane lane;
  lane.rng = {1};
  for (const Parameter& p : spec.parameters) lane.p.push_back(p.scene.initial);
  if (const auto look = kLook.find(spec.name); look != kLook.end())
    for (const auto& [name, value] : look->second) lane.p.at(static_cast<std::size_t>(spec.find(name))) = value;
  const double box = std::cbrt(static_cast<double>(agents) / kDensity);
  lane.world.bounds.kind = Bounds::Kind::box;
  lane.world.bounds.upper.setConstant(box);
  lane.state.append(agents);
  for (Index i = 0; i < agents; ++i) {
    const auto id = static_cast<std::uint32_t>(i);
    const auto xy = lane.rng.uniform2(Stream::start, 0, id, 0), zu = lane.rng.uniform2(Stream::start, 0, id, 1);
    lane.state.pos.row(i) << box * xy[0], box * xy[1], box * zu[0];
    lane.state.vel.row(i) = 0.4 * random_direction(lane.rng, Stream::start, 1, id, 0, 3).transpose();
  }
  return lane;
}

// settle: simulated seconds before what is measured.
void run(benchmark::State& state, const char* name, double settle) {
  const ModelChoice choice = parse_model(name);
  const auto model = make_model(choice, {});
  Lane lane = scene(*choice.spec, state.range(0));
  Plan plan{.frame_dt = 0.01, .frames = 1 + static_cast<std::int64_t>(settle / 0.01)};
  cpu_backend().run(*model, plan, {&lane, 1});
  plan.frames = state.range(0) > 1000 ? 4 : 21;
  for (auto _ : state) {
    Lane again = lane;  // or groups that draw together would be measured ever denser
    cpu_backend().run(*model, plan, {&again, 1});
  }
  state.SetItemsProcessed(state.iterations() * (plan.frames - 1) * state.range(0));
}

const bool registered = [] {
  const auto add = [](const char* label, const char* model, double settle, std::initializer_list<Index> sizes) {
    for (const Index n : sizes)
      benchmark::RegisterBenchmark((std::string(label) + "/ours").c_str(), run, model, settle)
          ->Arg(n)
          ->MeasureProcessCPUTime()
          ->UseRealTime()
          ->Unit(benchmark::kMillisecond);
  };
  for (const ModelSpec& spec : models()) add(spec.name.data(), spec.name.data(), 0, {100, 1000, 10000, 100000});
  add("bswarm", "bswarm", 0, {200000});
  add("bswarm, settled", "bswarm", 5, {100, 1000});
  add("bswarm, no avoidance", "bswarm[avoidance=none]", 0, {100, 1000, 10000});
  add("bswarm, noise alone", "bswarm[interaction=off,avoidance=none]", 0, {100, 1000, 10000});
  return true;
}();

}  // namespace
}  // namespace swarmfit
