// SPDX-License-Identifier: MIT
#include "libeval/energy_score.h"

#include <gmock/gmock.h>

#include <cmath>

#include "libtrack/rng.h"

namespace swarmfit {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

constexpr double kWorst = 2;

Densities one(std::vector<double> density) { return Densities(1, std::move(density)); }
Energies energy(double value) { return Energies(1, value); }

// Three runs, distances 2, 1 and 1 between them.
TEST(EnergyScore, ByHand) {
  const std::vector<Densities> runs = {one({1, 0}), one({0, 1}), one({0.5, 0.5})};
  const Spread own = spread(runs, kWorst);
  EXPECT_NEAR(own.mean[0], 4.0 / 3, 1e-15);
  EXPECT_THAT((std::vector{own.of[0][0], own.of[1][0], own.of[2][0]}), ElementsAre(1.5, 1.5, 1));
  const EnergyScore score = energy_score({energy(0.3), energy(1.7), energy(0.7)}, own);
  EXPECT_NEAR(score.value[0], 0.9 - 2.0 / 3, 1e-15);
  double mean = 0;
  for (const Energies& run : score.runs) mean += run[0] / 3;
  EXPECT_NEAR(mean, score.value[0], 1e-15);
}

TEST(EnergyScore, OneRunHasNoSpread) {
  const Spread own = spread({one({1, 0})}, kWorst);
  EXPECT_EQ(energy_score({energy(0.4)}, own).value[0], 0.4);
}

TEST(EnergyScore, ARunWithoutSamplesIsAsFarAsCanBeFromOneWithSome) {
  const Spread own = spread({one({1, 0}), one({}), one({})}, kWorst);
  EXPECT_THAT((std::vector{own.of[0][0], own.of[1][0], own.of[2][0]}), ElementsAre(2, 1, 1));
}

// A law of recordings: each is a coin's share of heads, the coin being fair or loaded from recording to recording by +- `load`.
std::vector<double> recording(double load, std::uint64_t number) {
  const Rng rng{number};
  const double p = 0.5 + (rng.uniform(Stream::probe, 0, 0) < 0.5 ? load : -load);
  int heads = 0;
  for (std::uint32_t k = 1; k <= 20; ++k) heads += rng.uniform(Stream::probe, 0, k) < p;
  return {heads / 20.0, 1 - heads / 20.0};
}

double mean_score(double truth, double model, bool pooled) {
  constexpr int kRecordings = 400, kRuns = 40;
  std::vector<Densities> runs;
  std::vector<double> pool(2, 0.0);
  for (int r = 0; r < kRuns; ++r) {
    runs.push_back(one(recording(model, static_cast<std::uint64_t>(10000 + r))));
    for (int i = 0; i < 2; ++i) pool[static_cast<std::size_t>(i)] += runs.back()[0][static_cast<std::size_t>(i)] / kRuns;
  }
  const Spread own = spread(runs, kWorst);
  double sum = 0;
  for (int k = 0; k < kRecordings; ++k) {
    const auto seen = recording(truth, static_cast<std::uint64_t>(k));
    const auto distance = [&](const std::vector<double>& q) { return std::abs(seen[0] - q[0]) + std::abs(seen[1] - q[1]); };
    std::vector<Energies> away;
    for (const Densities& run : runs) away.push_back(energy(distance(run[0])));
    sum += pooled ? distance(pool) : energy_score(away, own).value[0];
  }
  return sum / kRecordings;
}

// Recordings differ among themselves by more than their samples do, as those of a swarm in a slow noise field. Pooled, a law that has none
// of that looks as good as the truth; the score knows better, and is least at the truth among all.
TEST(EnergyScore, IsLeastForTheLawThatMadeTheRecordings) {
  const double truth = mean_score(0.3, 0.3, false);
  for (const double model : {0.0, 0.1, 0.2, 0.4}) EXPECT_LT(truth + 0.002, mean_score(0.3, model, false)) << model;
  EXPECT_NEAR(mean_score(0.3, 0.3, true), mean_score(0.3, 0.0, true), 0.02);
}

// The standard error from the runs' parts is the scatter of the score over laws of other seeds: 200 estimates from 12 runs each, whose
// standard deviation is known to 5 %.
TEST(EnergyScore, PartsOfRunsTellItsError) {
  const auto seen = recording(0.3, 1);
  double mean = 0, square = 0, variance = 0;
  constexpr int kLaws = 200, kRuns = 12;
  for (int law = 0; law < kLaws; ++law) {
    std::vector<Densities> runs;
    std::vector<Energies> away;
    for (int r = 0; r < kRuns; ++r) {
      runs.push_back(one(recording(0.3, static_cast<std::uint64_t>(100 * (law + 1) + r))));
      away.push_back(energy(2 * std::abs(seen[0] - runs.back()[0][0])));
    }
    const EnergyScore score = energy_score(away, spread(runs, kWorst));
    mean += score.value[0] / kLaws;
    square += score.value[0] * score.value[0] / kLaws;
    double own = 0;
    for (const Energies& run : score.runs) own += (run[0] - score.value[0]) * (run[0] - score.value[0]);
    variance += own / (kRuns - 1) / kRuns / kLaws;
  }
  EXPECT_NEAR(std::sqrt(variance / (square - mean * mean)), 1, 0.15);
}

}  // namespace
}  // namespace swarmfit
