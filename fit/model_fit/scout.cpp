// SPDX-License-Identifier: MIT
#include "fit/model_fit/scout.h"

#include <mutex>

#include "fit/experiment/run_features.h"
#include "fit/infer/posterior.h"

namespace swarmfit {
namespace {

constexpr std::size_t kFromSample = 11;

}  // namespace

std::vector<Point> scout(const SearchSpace& space, const Objective& objective, const Conditions& conditions, const Target& target,
                         const Rng& rng, const ScoutSize& size, const OnScout& on_scout) {
  const RunFeatures features(conditions, target);
  std::mutex lock;
  std::int64_t done = 0;
  bool stopped = false;
  const auto run = [&](const Point& x, const Rng& seed) -> std::optional<Eigen::VectorXd> {
    {
      const std::lock_guard guard(lock);
      stopped = stopped || !on_scout(done++);
      if (stopped) return std::nullopt;
    }
    const auto seen = objective.finished(space.parameters(x), seed);
    return seen && seen->rows() > 0 ? std::optional(features(*seen)) : std::nullopt;
  };
  const PosteriorOptions plan{size.rounds, size.simulations};
  const Posterior found = posterior(features(conditions.recording), space.dimensions(), run, rng, plan);
  if (stopped || found.sample.empty()) return {};
  std::vector<Point> out(1, Point(space.dimensions()));
  for (std::size_t a = 0; a < found.marginals.size(); ++a) out.front()[static_cast<Index>(a)] = found.marginals[a].median;
  const std::size_t some = std::min(found.sample.size(), kFromSample);
  for (std::size_t k = 0; k < some; ++k) out.push_back(found.sample[k * found.sample.size() / some]);
  return out;
}

}  // namespace swarmfit
