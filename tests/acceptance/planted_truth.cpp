// SPDX-License-Identifier: MIT
// Planted truth, as a table: swarms made by bswarm with curl noise, each compared with bswarm and boids. Is the planted model ranked first,
// and are the fitted parameters as good as the true ones on fresh seeds? Too long for the default test run; by hand:
//   planted_truth [SEEDS] [quick|default|thorough] [LOCALISATION_ERROR_MM]
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "fit/compare.h"
#include "fit/objective.h"
#include "tests/fit/planted.h"

namespace swarmfit {
namespace {

constexpr int kFreshSeeds = 20;

// Mean energy over the scored metrics, of one replicate.
double total(const Energies& raw, const PerMetric<bool>& used) {
  double sum = 0, n = 0;
  for (std::size_t j = 0; j < kMetrics; ++j)
    if (used[j]) sum += raw[j], ++n;
  return sum / n;
}

struct Paired {
  double fitted, truth, difference_se;
};

Paired on_fresh_seeds(const Tracks& recording, const CompareOptions& options, const Comparison& result, const FitResult& fit) {
  const auto& model = options.models.front();
  const Conditions conditions = make_conditions(recording, options.conditions);
  const Target target(metric_samples(conditions.recording), options.binning);
  const Objective objective(model, conditions, target);
  const auto seeds = replicate_seeds({options.seed + 1000003}, Stream::final_seeds, kFreshSeeds);
  const auto outcomes = objective.evaluate({parameter_values(model, fit), scene_parameters(model, test::midge_parameters())}, seeds);
  Moments fitted, truth, difference;
  for (std::size_t r = 0; r < seeds.size(); ++r) {
    const double a = total(outcomes[0].replicates[r], result.observation.used),
                 b = total(outcomes[1].replicates[r], result.observation.used);
    fitted.add(a), truth.add(b), difference.add(a - b);
  }
  return {fitted.mean, truth.mean, difference.sd() / std::sqrt(kFreshSeeds - 1.0)};
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

int run(int seeds, const std::string& budget, double sigma) {
  int first = 0, as_good = 0;
  fmt::print("localisation error {} mm, budget {}\n", sigma, budget);
  fmt::print("seed  winner  score bswarm  score boids  raw energy bswarm  boids | fresh seeds: fitted  true  (fitted - true)/se\n");
  for (int seed = 1; seed <= seeds; ++seed) {
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
    const Paired p = on_fresh_seeds(recording, options, result, bswarm);
    const double z = (p.fitted - p.truth) / p.difference_se;
    first += winner.model == "bswarm";
    as_good += z <= 2;
    fmt::print("{:4}  {:7} {:12.3f} {:12.3f} {:18.3f} {:6.3f} | {:20.3f} {:5.3f} {:19.1f}\n", seed, winner.model, bswarm.score, boids.score,
               total(bswarm.raw_energies, result.observation.used), total(boids.raw_energies, result.observation.used), p.fitted, p.truth,
               z);
    std::fflush(stdout);
  }
  fmt::print("bswarm first in {} of {}; fitted not worse than true by more than two standard errors in {} of {}\n", first, seeds, as_good,
             seeds);
  return first == seeds && as_good == seeds ? 0 : 1;
}

}  // namespace
}  // namespace swarmfit

int main(int argc, char** argv) {
  return swarmfit::run(argc > 1 ? std::atoi(argv[1]) : 10, argc > 2 ? argv[2] : "quick", argc > 3 ? std::atof(argv[3]) : 0);
}
