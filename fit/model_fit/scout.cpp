// SPDX-License-Identifier: MIT
#include "fit/model_fit/scout.h"

#include "fit/experiment/run_features.h"
#include "fit/model_fit/feature_runs.h"

namespace swarmfit {
namespace {

constexpr std::size_t kFromSample = 11;

}  // namespace

std::vector<Point> scout(const SearchSpace& space, const Objective& objective, const Rng& rng, const ScoutSize& size,
                         const OnScout& on_scout) {
  const Conditions& conditions = objective.ensemble().conditions();
  const RunFeatures of(conditions, objective.target());
  const Features features = [&of](const Tracks& tracks) { return of(tracks); };
  const Simulator runs = feature_runs(space, objective.ensemble(), "scout", features);
  std::int64_t done = 0;
  const Simulator watched = [&](const std::vector<Draw>& draws) {
    auto out = runs(draws);
    done += static_cast<std::int64_t>(draws.size());
    if (on_scout) on_scout(done);
    return out;
  };
  const PosteriorOptions plan{size.rounds, size.simulations};
  const Posterior found = posterior(features(conditions.recording), space.dimensions(), watched, rng, plan);
  if (found.sample.empty()) return {};
  std::vector<Point> out(1, Point(space.dimensions()));
  for (std::size_t a = 0; a < found.marginals.size(); ++a) out.front()[static_cast<Index>(a)] = found.marginals[a].median;
  const std::size_t some = std::min(found.sample.size(), kFromSample);
  for (std::size_t k = 0; k < some; ++k) out.push_back(found.sample[k * found.sample.size() / some]);
  return out;
}

}  // namespace swarmfit
