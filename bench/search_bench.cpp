// SPDX-License-Identifier: MIT
// How good a search is, not how fast: the median true value, over 20 seeds, of the point it recommends after so many evaluations, as a
// counter of one iteration, with quartiles. The functions cost next to nothing. Names are function/whose/dimensions/evaluations.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <nlopt.hpp>

#include "fit/optimise/differential_evolution.h"
#include "tests/fit/test_functions.h"
#ifdef BENCH_PAGMO
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/algorithms/de1220.hpp>
#include <pagmo/algorithms/sade.hpp>
#include <pagmo/algorithms/sga.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#endif

namespace swarmfit::testing {
namespace {

constexpr int kSeeds = 20;

// The point that a method recommends after `evaluations`.
using Method = std::function<Point(const TestFunction&, int evaluations, std::uint64_t seed)>;

Point ours(const TestFunction& f, int evaluations, std::uint64_t seed) {
  SearchOptions options;
  options.evolution.max_evaluations = evaluations;
  options.evolution.generations = evaluations / options.evolution.population + 1;  // the limit decides
  return search(static_cast<int>(f.optimum.size()), f.batch(), options, Rng{seed}).recommended.x;
}

// nlopt's methods count their evaluations; a local one starts again, at random, until they are used up.
Method nlopt_method(nlopt::algorithm algorithm, bool local) {
  return [=](const TestFunction& f, int evaluations, std::uint64_t seed) {
    const auto d = static_cast<unsigned>(f.optimum.size());
    int used = 0;
    std::vector<double> best;
    double least = HUGE_VAL;
    const auto cost = [&](const std::vector<double>& x) {
      ++used;
      const double c = f.cost(Eigen::Map<const Point>(x.data(), d));
      if (c < least) least = c, best = x;
      return c;
    };
    nlopt::srand(seed);
    std::uint32_t start = 0;
    while (used < evaluations) {
      nlopt::opt opt(algorithm, d);
      opt.set_lower_bounds(0.0);
      opt.set_upper_bounds(1.0);
      opt.set_maxeval(evaluations - used);
      if (local) opt.set_xtol_abs(1e-9);
      using Cost = decltype(cost);
      opt.set_min_objective(
          [](const std::vector<double>& x, std::vector<double>&, void* data) { return (*static_cast<Cost*>(data))(x); },  // NOLINT
          const_cast<void*>(static_cast<const void*>(&cost)));
      std::vector<double> x(d);
      for (unsigned k = 0; k < d; ++k) x[k] = Rng{seed}.uniform(Stream::search, start, k);
      ++start;
      double value = 0;
      opt.optimize(x, value);
    }
    return Point(Eigen::Map<const Point>(best.data(), d));
  };
}

#ifdef BENCH_PAGMO
constexpr int kPopulation = 20;

struct Problem {
  const TestFunction* f = nullptr;
  pagmo::vector_double fitness(const pagmo::vector_double& x) const {
    return {f->cost(Eigen::Map<const Point>(x.data(), static_cast<Eigen::Index>(x.size())))};
  }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    const auto d = static_cast<std::size_t>(f->optimum.size());
    return {pagmo::vector_double(d, 0.0), pagmo::vector_double(d, 1.0)};
  }
};

template <class Algorithm, class... More>
Method pagmo_method(More... more) {
  return [=](const TestFunction& f, int evaluations, std::uint64_t seed) {
    const auto random = static_cast<unsigned>(seed);
    pagmo::algorithm algorithm{Algorithm(static_cast<unsigned>(evaluations / kPopulation - 1), more...)};
    algorithm.set_seed(random);
    const auto evolved = algorithm.evolve(pagmo::population{pagmo::problem{Problem{&f}}, kPopulation, random});
    const auto x = evolved.champion_x();
    return Point(Eigen::Map<const Point>(x.data(), static_cast<Eigen::Index>(x.size())));
  };
}
#endif

struct Function {
  std::string name;
  std::function<TestFunction(int, std::uint64_t)> make;
};

void quality(benchmark::State& state, const Function& function, const Method& method) {
  const auto dimensions = static_cast<int>(state.range(0)), evaluations = static_cast<int>(state.range(1));
  std::vector<double> truths;
  for ([[maybe_unused]] auto _ : state) {
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const TestFunction f = function.make(dimensions, seed);
      truths.push_back(f.truth(method(f, evaluations, seed)));
    }
  }
  std::sort(truths.begin(), truths.end());
  state.counters["q25"] = truths[kSeeds / 4];
  state.counters["median"] = (truths[kSeeds / 2 - 1] + truths[kSeeds / 2]) / 2;
  state.counters["q75"] = truths[3 * kSeeds / 4];
}

const bool registered = [] {
  const std::vector<Function> functions{
      {"Rastrigin", rastrigin},
      {"rotated Rastrigin", rotated_rastrigin},
      {"Rosenbrock", rosenbrock},
      {"noisy sphere", [](int d, std::uint64_t seed) { return noisy(sphere(d, seed), 0.5, seed); }},
      {"noisy histograms", [](int d, std::uint64_t seed) { return noisy(histograms(d, seed), 0.01, seed); }},
  };
  std::vector<std::pair<std::string, Method>> methods{
      {"nlopt ESCH", nlopt_method(nlopt::GN_ESCH, false)},
      {"nlopt CRS2", nlopt_method(nlopt::GN_CRS2_LM, false)},
      {"nlopt Nelder-Mead, many starts", nlopt_method(nlopt::LN_NELDERMEAD, true)},
#ifdef BENCH_PAGMO
      {"pagmo sade", pagmo_method<pagmo::sade>()},
      {"pagmo de1220", pagmo_method<pagmo::de1220>()},
      {"pagmo sga", pagmo_method<pagmo::sga>()},
      {"pagmo cmaes", pagmo_method<pagmo::cmaes>(-1.0, -1.0, -1.0, -1.0, 0.5, 1e-6, 1e-6, false, true)},  // force_bounds
#endif
  };
  for (const Function& f : functions) {
    auto* own = benchmark::RegisterBenchmark((f.name + "/ours").c_str(), quality, f, ours);
    own->Args({7, 5000})->Args({7, 600})->Args({9, 600})->Iterations(1)->Unit(benchmark::kMillisecond);
    for (const auto& [name, method] : methods)
      benchmark::RegisterBenchmark((f.name + "/" + name).c_str(), quality, f, method)
          ->Args({7, 5000})
          ->Iterations(1)
          ->Unit(benchmark::kMillisecond);
  }
  return true;
}();

}  // namespace
}  // namespace swarmfit::testing
