// SPDX-License-Identifier: MIT
// Agent-steps of every model: agents all over a box and hardly moving, the state in which a scene starts; "settled": after 5 s, when Table
// 1 has drawn it together. Items are agent-steps. Names are model/whose/agents.
#include <benchmark/benchmark.h>

#include "libswarm/noise.h"
#include "libswarm/simulate.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

constexpr double kBox = 20;  // edge of the arena of Table 1 [simulation units]

Lane scene(const ModelSpec& spec, Index agents) {
  Lane lane;
  lane.rng = {1};
  for (const Parameter& p : spec.parameters) lane.p.push_back(p.scene.initial);
  lane.world.bounds.kind = Bounds::Kind::box;
  lane.world.bounds.upper.setConstant(kBox);
  for (std::uint32_t i = 0; i < agents; ++i) {
    const auto xy = lane.rng.uniform2(Stream::start, 0, i, 0), zu = lane.rng.uniform2(Stream::start, 0, i, 1);
    lane.state.spawn(0, kBox * Array3d(xy[0], xy[1], zu[0]), 0.4 * random_direction(lane.rng, Stream::start, 1, i, 0, 3));
  }
  return lane;
}

// settle: simulated seconds before the measured second.
void run(benchmark::State& state, const char* name, double settle) {
  const ModelChoice choice = parse_model(name);
  Setup setup;
  setup.options = choice.options;
  const auto model = choice.spec->make(setup);
  Lane lane = scene(*choice.spec, state.range(0));
  Plan plan{.frame_dt = 0.01, .frames = 1 + static_cast<std::int64_t>(settle / 0.01)};
  cpu_backend().run(*model, plan, {&lane, 1});
  plan.frames = state.range(0) > 1000 ? 3 : 101;
  double steps = 0;
  for (auto _ : state) {
    cpu_backend().run(*model, plan, {&lane, 1});
    steps += static_cast<double>(plan.frames - 1) * static_cast<double>(state.range(0));
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(steps));
}

const bool registered = [] {
  const auto add = [](const char* label, const char* model, double settle, std::initializer_list<Index> sizes) {
    for (const Index n : sizes)
      benchmark::RegisterBenchmark((std::string(label) + "/ours").c_str(), run, model, settle)->Arg(n)->Unit(benchmark::kMillisecond);
  };
  for (const ModelSpec& spec : models()) add(spec.name.data(), spec.name.data(), 0, {100, 1000, 10000, 100000});
  add("bswarm, settled", "bswarm", 5, {100, 1000});
  add("bswarm, no avoidance", "bswarm[avoidance=none]", 0, {100, 1000, 10000});
  add("bswarm, noise alone", "bswarm[interaction=off,avoidance=none]", 0, {100, 1000, 10000});
  return true;
}();

}  // namespace
}  // namespace swarmfit
