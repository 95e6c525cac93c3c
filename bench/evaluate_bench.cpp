// SPDX-License-Identifier: MIT
// From tracks to numbers: the seven metrics and their distributions of a synthetic swarm, per row of the recording, and one histogram, per
// sample. Names are part/whose/rows.
#include <benchmark/benchmark.h>

#include <boost/histogram.hpp>

#include "fit/experiment/plant.h"
#include "libeval/energy.h"

namespace swarmfit {
namespace {

// 100 animals that wander.
Tracks recording(std::int64_t rows) {
  PlantOptions film;
  film.agents = 100;
  film.frames = rows / film.agents;
  film.start_radius = 1;
  film.start_speed = 1;
  const ModelChoice model = parse_model("langevin");
  return plant(model, scene_parameters(model, {}), film);
}

void metrics(benchmark::State& state) {
  const Tracks tracks = recording(state.range(0));
  const Target target(metric_samples(tracks), {});
  for (auto _ : state) benchmark::DoNotOptimize(target.distributions(metric_samples(tracks)));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(metrics)->Name("metrics and distributions/ours")->Arg(10000)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond);

// Ours is all columns of a recording, and finds mean and standard deviation too.
void distributions(benchmark::State& state) {
  const MetricSamples samples = metric_samples(recording(state.range(0)));
  const Target target(samples, {});
  double count = 0;
  for (const auto& values : samples.values) count += static_cast<double>(values.size());
  for (auto _ : state) benchmark::DoNotOptimize(target.distributions(samples));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
}
BENCHMARK(distributions)->Name("histogram/ours")->Arg(100000)->Unit(benchmark::kMillisecond);

void boost_histogram(benchmark::State& state) {
  const MetricSamples samples = metric_samples(recording(state.range(0)));
  const auto& values = samples.values[kSpeed];
  const double most = *std::max_element(values.begin(), values.end());
  for (auto _ : state) {
    auto h = boost::histogram::make_histogram(boost::histogram::axis::regular<>(100, 0, most));
    h.fill(values);
    benchmark::DoNotOptimize(h);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(values.size()));
}
BENCHMARK(boost_histogram)->Name("histogram/Boost.Histogram")->Arg(100000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace swarmfit
