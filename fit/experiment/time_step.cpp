// SPDX-License-Identifier: MIT
#include "fit/experiment/time_step.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace swarmfit {
namespace {

constexpr double kCertain = 4;    // standard errors of a difference between many runs
constexpr double kSlight = 0.1;   // of an energy: a model that is far from the recording does not come nearer by that
constexpr double kFar = 1.0 / 3;  // of the worst energy

double squared_error(const Outcome& outcome, std::size_t column) {
  Moments single;
  for (const Energies& replicate : outcome.replicates) single.add(replicate[column]);
  const auto n = static_cast<double>(single.count);
  return n > 1 ? single.m2 / (n - 1) / n : 0;
}

}  // namespace

bool same_energies(const Outcome& one, const Outcome& other, const Target& target, double standard_errors) {
  for (std::size_t j = 0; j < target.columns().size(); ++j) {
    if (!target.defined(j) || std::min(one.raw[j], other.raw[j]) > kFar * target.worst()) continue;
    const double scatter = std::sqrt(squared_error(one, j) + squared_error(other, j));
    const double slight = std::max(kUnseen * target.worst(), kSlight * std::max(one.raw[j], other.raw[j]));
    if (std::abs(one.raw[j] - other.raw[j]) > std::max(standard_errors * scatter, slight)) return false;
  }
  return true;
}

bool far_off(const Outcome& outcome, const Target& target) {
  Moments energies;
  for (std::size_t j = 0; j < target.columns().size(); ++j)
    if (target.defined(j)) energies.add(outcome.raw[j]);
  return energies.mean > kFar * target.worst();
}

void settle_steps(Objective& objective, const Target& target, const std::vector<std::vector<double>>& candidates, const StepSeeds& seeds,
                  int first, int most) {
  const auto all = [](const std::vector<Outcome>& heat) { return std::vector<bool>(heat.size(), true); };
  const auto outcomes = [&](int steps, std::span<const Rng> on) {
    objective.use_steps(steps);
    return objective.race(candidates, on, on.size(), all);
  };
  const auto same = [&](const std::vector<Outcome>& coarse, const std::vector<Outcome>& fine, double standard_errors) {
    for (std::size_t c = 0; c < candidates.size(); ++c)
      if (!same_energies(coarse[c], fine[c], target, standard_errors)) return false;
    return true;
  };
  const auto limit = [&](const std::vector<Outcome>& found) {
    const bool far = std::all_of(found.begin(), found.end(), [&](const Outcome& o) { return far_off(o, target); });
    return (far ? std::min(kFarSteps, most) : most) * objective.ensemble().stable_steps();
  };
  std::map<int, std::vector<Outcome>> sure;  // the finer of one comparison is the coarser of the next
  const auto surely = [&](int steps) -> const std::vector<Outcome>& {
    const auto found = sure.find(steps);
    return found != sure.end() ? found->second : sure.emplace(steps, outcomes(steps, seeds.more)).first->second;
  };
  int steps = first;
  auto coarse = outcomes(steps, seeds.few);
  while (2 * steps <= limit(coarse)) {
    auto fine = outcomes(2 * steps, seeds.few);
    if (same(coarse, fine, kDifferent) || same(surely(steps), surely(2 * steps), kCertain)) break;
    steps *= 2;
    coarse = std::move(fine);
  }
  objective.use_steps(steps);
}

}  // namespace swarmfit
