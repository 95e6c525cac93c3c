// SPDX-License-Identifier: MIT
// What a fit spends its time on: one evaluation of the objective, one replicate, averaged over points scattered over the search space as
// the candidates of a first generation are. Items are agent-steps. Names are part/whose/agents/frames of the recording.
#include <benchmark/benchmark.h>

#include "fit/experiment/objective.h"
#include "fit/experiment/plant.h"
#include "fit/model_fit/search_space.h"

namespace swarmfit {
namespace {

constexpr std::uint64_t kCandidates = 8;

Tracks recording(int agents, std::int64_t frames) {
  PlantOptions options;
  options.agents = agents;
  options.frames = frames;
  options.warm_up = 100;
  options.start_radius = 120;
  options.start_speed = 200;
  options.sigma = 0.1;
  options.unit = "mm";
  const ModelChoice model = parse_model("bswarm");
  const auto parameters = scene_parameters(model, {{"gamma", 0.01},
                                                   {"noise", 1600},
                                                   {"scale", 60},
                                                   {"chi_rep", 400},
                                                   {"r_rep", 60},
                                                   {"chi_att", 900},
                                                   {"r_att", 400},
                                                   {"chi_ali", 0},
                                                   {"r_ali", 0},
                                                   {"radius", 4},
                                                   {"max_speed", 5000},
                                                   {"neighbour_distance", 80},
                                                   {"time_horizon", 0.2}});
  return plant(model, parameters, options);
}

std::vector<std::vector<double>> scattered(const ModelChoice& model, const Scales& scales) {
  const SearchSpace space(model, scales, {});
  std::vector<std::vector<double>> candidates;
  for (std::uint64_t k = 0; k < kCandidates; ++k) {
    Point x(space.dimensions());
    for (Index i = 0; i < x.size(); ++i) x[i] = Rng{1}.uniform(Stream::probe, k, static_cast<std::uint32_t>(i));
    candidates.push_back(space.parameters(x));
  }
  return candidates;
}

void evaluate(benchmark::State& state, const char* name) {
  const ModelChoice model = parse_model(name);
  const Conditions conditions = make_conditions(recording(static_cast<int>(state.range(0)), state.range(1)), {});
  const Target target(metric_samples(conditions.recording), {});
  const Objective objective(model, conditions, target);
  const auto candidates = scattered(model, conditions.scales);
  const std::vector<Rng> seeds = replicate_seeds({1}, Stream::replicate, 1);
  std::size_t next = 0;
  double failed = 0;
  for (auto _ : state) failed += objective.evaluate(candidates[next++ % kCandidates], seeds).failed;
  const auto evaluations = static_cast<double>(state.iterations());
  state.SetItemsProcessed(
      static_cast<std::int64_t>(evaluations * static_cast<double>(state.range(0) * (state.range(1) - 1) * objective.ensemble().steps())));
  state.counters["failed"] = failed / evaluations;
}

// A fixed number of iterations, so that every candidate is met equally often.
void recordings(benchmark::internal::Benchmark* benchmark) {
  benchmark->Args({10, 500})->Args({100, 500})->Iterations(3 * kCandidates)->Unit(benchmark::kMillisecond);
}

const bool registered = [] {
  for (const char* model : {"bswarm", "rvo", "noise_aware", "brownian", "langevin", "boids"})
    recordings(benchmark::RegisterBenchmark((std::string("one evaluation of ") + model + "/ours").c_str(), evaluate, model));
  return true;
}();

}  // namespace
}  // namespace swarmfit
