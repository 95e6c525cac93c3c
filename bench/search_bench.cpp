// SPDX-License-Identifier: MIT
// How good the search is, not how fast: the median true value of the recommended point over 20 seeds, with quartiles, as counters of
// one iteration. Arguments: dimensions, evaluations. The goals and what other methods reach: docs/search.md. The time is the search's own,
// the functions cost next to nothing.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "fit/genetic.h"
#include "tests/fit/test_functions.h"

namespace swarmfit::testing {
namespace {

constexpr int seeds = 20;

template <typename Make>
void quality(benchmark::State& state, const Make& make) {
  const auto dimensions = static_cast<int>(state.range(0));
  SearchOptions options;
  options.genetic.max_evaluations = state.range(1);
  options.genetic.generations = static_cast<int>(state.range(1)) / options.genetic.population + 1;  // the limit decides
  std::vector<double> truths;
  double evaluations = 0;
  for ([[maybe_unused]] auto _ : state) {
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const TestFunction f = make(dimensions, seed);
      const Found found = search(dimensions, f.batch(), options, Rng{seed});
      truths.push_back(f.truth(found.recommended.x));
      evaluations += static_cast<double>(found.evaluations) / seeds;
    }
  }
  std::sort(truths.begin(), truths.end());
  state.counters["q25"] = truths[seeds / 4];
  state.counters["median"] = (truths[seeds / 2 - 1] + truths[seeds / 2]) / 2;
  state.counters["q75"] = truths[3 * seeds / 4];
  state.counters["evaluations"] = evaluations;
}

void budgets(benchmark::internal::Benchmark* benchmark) {
  benchmark->Args({7, 5000})->Args({7, 2400})->Args({9, 600})->Args({7, 600})->Args({5, 600})->Args({5, 200});
  benchmark->Iterations(1)->Unit(benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(quality, rastrigin, rastrigin)->Apply(budgets);
BENCHMARK_CAPTURE(quality, rotated_rastrigin, rotated_rastrigin)->Apply(budgets);
BENCHMARK_CAPTURE(quality, rosenbrock, rosenbrock)->Apply(budgets);
BENCHMARK_CAPTURE(quality, noisy_sphere, [](int d, std::uint64_t seed) { return noisy(sphere(d, seed), 0.5, seed); })->Apply(budgets);
BENCHMARK_CAPTURE(quality, histograms, [](int d, std::uint64_t seed) { return noisy(histograms(d, seed), 0.01, seed); })->Apply(budgets);

}  // namespace
}  // namespace swarmfit::testing
