// SPDX-License-Identifier: MIT
// Planted truth, as a table: swarms made by bswarm with curl noise, each compared with bswarm and boids. Is the planted model ranked first,
// and are the fitted parameters as good as the true ones on fresh seeds? Too long for the default test run; by hand:
//   planted_truth [SEEDS] [quick|default|thorough] [LOCALISATION_ERROR_MM] [FIRST_SEED]
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <functional>

#include "fit/compare/compare.h"
#include "fit/experiment/objective.h"
#include "tests/fit/planted.h"

namespace swarmfit {
namespace {

constexpr int kFreshSeeds = 20;

// What a candidate is judged by: the mean energy of the scored metrics, or the loss that the fit minimised, 1 - E.
using Loss = std::function<double(const Energies&)>;

Loss mean_energy(const PerColumn<bool>& used) {
  return [used](const Energies& raw) {
    double sum = 0, n = 0;
    for (std::size_t j = 0; j < kMetrics; ++j)
      if (used[j]) sum += raw[j], ++n;
    return sum / n;
  };
}

Loss fitted_loss(const Comparison& c) {
  return [&c](const Energies& raw) {
    double sum = 0;
    for (std::size_t j = 0; j < kMetrics; ++j)
      if (c.ranking.weights[j] > 0) sum += c.ranking.weights[j] * (raw[j] - c.ranking.p1[j]) / c.ranking.p2[j];
    return sum;
  };
}

// One candidate on the fresh seeds: its pooled distributions, whole and with each replicate left out.
struct Pooled {
  Energies whole{};
  std::vector<Energies> without;
};

Pooled pooled(const Objective& objective, const Target& target, const std::vector<double>& candidate, const std::vector<Rng>& seeds) {
  std::vector<PerColumn<Distribution>> parts;
  for (const Rng& seed : seeds) parts.push_back(objective.evaluate(candidate, {&seed, 1}).distributions);
  const auto energies_without = [&](std::size_t left_out) {
    PerColumn<Distribution> sum{};
    for (std::size_t r = 0; r < parts.size(); ++r)
      for (std::size_t m = 0; r != left_out && m < kMetrics; ++m) sum[m].histogram.add(parts[r][m].histogram);
    return target.energies(sum);
  };
  Pooled out{energies_without(parts.size()), {}};
  for (std::size_t r = 0; r < parts.size(); ++r) out.without.push_back(energies_without(r));
  return out;
}

// The difference fitted - true with its standard error by the jackknife over seeds, on which the two are paired.
struct Paired {
  double fitted, truth, se;
  double z() const { return (fitted - truth) / se; }
};

Paired paired(const Pooled& fitted, const Pooled& truth, const Loss& loss) {
  Moments difference;
  for (std::size_t r = 0; r < fitted.without.size(); ++r) difference.add(loss(fitted.without[r]) - loss(truth.without[r]));
  const auto n = static_cast<double>(fitted.without.size());
  return {loss(fitted.whole), loss(truth.whole), std::sqrt((n - 1) / n * difference.m2)};
}

// As long as the midge recording: ten animals, five seconds at 100 Hz.
Tracks film(std::uint64_t seed, double sigma) {
  const auto model = parse_model("bswarm");
  auto options = test::small_swarm(seed);
  options.frames = 500;
  options.sigma = sigma;
  options.dropout = 0.005;
  return plant(model, scene_parameters(model, test::midge_parameters()), options);
}

int run(int seeds, const std::string& budget, double sigma, int first_seed) {
  int first = 0, as_good = 0;
  fmt::print("localisation error {} mm, budget {}\n", sigma, budget);
  fmt::print("               score          mean energy     | {} fresh seeds, pooled: mean energy       loss that was fitted\n",
             kFreshSeeds);
  fmt::print("seed  winner  bswarm  boids   bswarm  boids  | fitted   true  difference/se   fitted   true  difference/se\n");
  for (int seed = first_seed; seed < first_seed + seeds; ++seed) {
    const Tracks recording = film(static_cast<std::uint64_t>(seed), sigma);
    CompareOptions options;
    options.models = {parse_model("bswarm"), parse_model("boids")};
    options.binning = Binning::standard(Normalisation::reference);
    options.budget = budget_named(budget);
    options.seed = static_cast<std::uint64_t>(seed);
    const Comparison result = compare(recording, options);
    const auto& winner = result.models[0];
    const auto& bswarm = result.models[winner.model == "bswarm" ? 0 : 1];
    const auto& boids = result.models[winner.model == "bswarm" ? 1 : 0];

    const Conditions conditions = make_conditions(recording, options.conditions);
    const Target target(metric_samples(conditions.recording), options.binning);
    const Objective objective(options.models.front(), conditions, target);
    const auto fresh = replicate_seeds({options.seed + 1000003}, Stream::final_seeds, kFreshSeeds);
    const Pooled fitted = pooled(objective, target, parameter_values(options.models.front(), bswarm), fresh);
    const Pooled truth = pooled(objective, target, scene_parameters(options.models.front(), test::midge_parameters()), fresh);
    const Loss mean = mean_energy(result.recording.observation.used), loss = fitted_loss(result);
    const Paired energy = paired(fitted, truth, mean), weighted = paired(fitted, truth, loss);
    first += winner.model == "bswarm";
    as_good += energy.z() <= 2 && weighted.z() <= 2;
    fmt::print("{:4}  {:7} {:6.3f} {:6.3f} {:8.3f} {:6.3f}  | {:6.3f} {:6.3f} {:14.1f} {:8.3f} {:6.3f} {:14.1f}\n", seed, winner.model,
               bswarm.standing.score, boids.standing.score, mean(bswarm.runs.raw_energies), mean(boids.runs.raw_energies), energy.fitted,
               energy.truth, energy.z(), weighted.fitted, weighted.truth, weighted.z());
    std::fflush(stdout);
  }
  fmt::print("bswarm first in {} of {}; fitted not worse than true by more than two standard errors in {} of {}\n", first, seeds, as_good,
             seeds);
  return first == seeds && as_good == seeds ? 0 : 1;
}

}  // namespace
}  // namespace swarmfit

int main(int argc, char** argv) {
  return swarmfit::run(argc > 1 ? std::atoi(argv[1]) : 10, argc > 2 ? argv[2] : "quick", argc > 3 ? std::atof(argv[3]) : 0,
                       argc > 4 ? std::atoi(argv[4]) : 1);
}
