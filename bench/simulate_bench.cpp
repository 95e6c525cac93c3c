// SPDX-License-Identifier: MIT
// Agent-steps per second of the simulator, and of its parts. "dispersed": agents all over the box and hardly moving, the state in which a
// scene starts; "settled": after 5 s, when Table 1 has drawn it together.
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
  state.counters["agent_steps"] = benchmark::Counter(steps, benchmark::Counter::kIsRate);
  state.counters["ns_per_agent_step"] = benchmark::Counter(steps * 1e-9, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(run, bswarm_dispersed, "bswarm", 0)->Arg(100)->Arg(1000)->Arg(10000);
BENCHMARK_CAPTURE(run, bswarm_settled, "bswarm", 5)->Arg(100)->Arg(1000);
BENCHMARK_CAPTURE(run, bswarm_without_avoidance, "bswarm[avoidance=none]", 0)->Arg(100)->Arg(1000)->Arg(10000);
BENCHMARK_CAPTURE(run, bswarm_noise_only, "bswarm[interaction=off,avoidance=none]", 0)->Arg(100)->Arg(1000)->Arg(10000);
BENCHMARK_CAPTURE(run, boids, "boids", 0)->Arg(100)->Arg(1000)->Arg(10000);

void curl(benchmark::State& state) {
  const NoiseField field(Rng{1});
  Array3d x(0.1, 0.2, 0.3), sum = Array3d::Zero();
  for (auto _ : state) {
    sum += field.curl(x);
    x += 0.137;
    benchmark::DoNotOptimize(sum);
  }
}
BENCHMARK(curl);

void normals(benchmark::State& state) {
  std::uint64_t tick = 0;
  for (auto _ : state) benchmark::DoNotOptimize(gaussian_noise(Rng{1}, ++tick, 7));
}
BENCHMARK(normals);

// Where all pairs stop being faster: a visit of everybody's neighbours in a box with about 30 of them each.
void neighbours(benchmark::State& state, Neighbours::Method method) {
  const Index n = state.range(0);
  Lane lane = scene(models()[0], n);
  const double radius = kBox * std::cbrt(30 / (4.19 * static_cast<double>(n)));
  Neighbours near;
  double sum = 0;
  for (auto _ : state) {
    near.build(lane.state.pos, lane.world.bounds, radius, method);
    for (Index i = 0; i < n; ++i) near.visit(i, [&](Index, const Array3d&, double distance) { sum += distance; });
    benchmark::DoNotOptimize(sum);
  }
  state.counters["ns_per_agent"] =
      benchmark::Counter(static_cast<double>(n) * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(neighbours, all_pairs, Neighbours::Method::all_pairs)->Arg(100)->Arg(200)->Arg(400)->Arg(800);
BENCHMARK_CAPTURE(neighbours, grid, Neighbours::Method::grid)->Arg(100)->Arg(200)->Arg(400)->Arg(800)->Arg(10000)->Arg(100000);

}  // namespace
}  // namespace swarmfit
