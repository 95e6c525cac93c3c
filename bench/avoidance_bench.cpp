// SPDX-License-Identifier: MIT
// Reciprocal collision avoidance in three dimensions, everything a step needs included. "sphere": 812 agents that change places across a
// sphere, the example that comes with RVO2-3D, its settings (range 15, 10 neighbours, horizon 10, radius 1.5), 800 steps. "crowd": agents
// uniform in a cube, 33 within the range of avoidance, each heading for the opposite place (range 10, 20 neighbours, horizon 5, radius 1).
// Preferred speed 1, highest speed 2, steps of 1/8. Items are agent-steps. Names are scene/whose/agents. RVO2-3D is not packaged; it was
// given the same scenes by hand (docs/performance.md).
#include <benchmark/benchmark.h>

#include "libswarm/avoider.h"
#include "libswarm/parallel.h"
#include "libswarm/simulate.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

struct Buffers : Workspace {
  Avoider avoider{3, Infeasible::min_penetration};
};

// Heads for a goal, kept in the private columns.
class Commuters : public Model {
 public:
  explicit Commuters(const Avoider::Limits& limits) : limits_(limits) {}
  Index columns() const override { return 3; }
  std::unique_ptr<Workspace> workspace(const World&, const Rng&) const override { return std::make_unique<Buffers>(); }
  void enter(State& state, Index first, const World&, const StepContext&) const override {
    for (Index i = first; i < state.size(); ++i) state.own.row(i) = -state.pos.row(i);
  }
  Step step(const State& now, State& next, const World& world, const StepContext& c) const override {
    Avoider& avoider = static_cast<Buffers*>(c.work)->avoider;
    avoider.begin(now, world.bounds, limits_);
    for_each_agent(now.size(), [&](Index i, std::size_t thread) {
      Array3d way = (now.own.row(i) - now.pos.row(i)).transpose();
      const double distance = std::sqrt(way.square().sum());
      if (distance > 1) way /= distance;
      const Array3d v = avoider.velocity(now, i, way, c, thread);
      next.vel.row(i) = v.transpose();
      next.pos.row(i) = now.pos.row(i) + v.transpose() * c.dt;
    });
    return avoider.end(c);
  }

 private:
  Avoider::Limits limits_;
};

State crowd(Index n) {
  State state;
  const double side = std::cbrt(static_cast<double>(n) / 0.008);
  for (std::uint32_t id = 0; id < n; ++id) {
    const auto xy = Rng{1}.uniform2(Stream::start, 0, id, 0);
    const Array3d p(xy[0], xy[1], Rng{1}.uniform(Stream::start, 0, id, 1));
    state.spawn(0, side * (p - 0.5), Array3d::Zero());
  }
  return state;
}

State sphere() {
  State state;
  for (int ring = 0; ring < 32; ++ring) {
    const double z = 100 * std::cos(ring / 10.0), r = 100 * std::sin(ring / 10.0);
    for (int k = 0; k < r / 2.5; ++k) {
      const double angle = 2 * std::numbers::pi * k / (r / 2.5);
      state.spawn(0, {r * std::cos(angle), r * std::sin(angle), z}, Array3d::Zero());
    }
  }
  return state;
}

void run(benchmark::State& state, const State& start, const Avoider::Limits& limits, std::int64_t steps) {
  const Commuters model(limits);
  Plan plan;
  plan.frame_dt = 0.125;
  plan.frames = steps + 1;
  for (auto _ : state) {
    Lane lane{{}, Rng{1}, start, World{}, nullptr, {}, false};
    cpu_backend().run(model, plan, {&lane, 1});
    benchmark::DoNotOptimize(lane.state.pos.data());
  }
  state.SetItemsProcessed(state.iterations() * steps * start.size());
}

void crowds(benchmark::State& state) {
  const Index n = state.range(0);
  run(state, crowd(n), {1, 2, 5, 10, 20}, 400000 / n + 4);
}
BENCHMARK(crowds)->Name("crowd/ours")->Arg(100)->Arg(1000)->Arg(10000)->Arg(50000)->Unit(benchmark::kMillisecond);

void spheres(benchmark::State& state) { run(state, sphere(), {1.5, 2, 10, 15, 10}, 800); }
BENCHMARK(spheres)->Name("sphere/ours/812")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace swarmfit
