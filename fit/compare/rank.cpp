// SPDX-License-Identifier: MIT
#include "fit/compare/rank.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fit/model_fit/race.h"

namespace swarmfit {

Standing standing_of(const FinalRuns& runs, const Weighting& weighting) {
  Standing out;
  InSample& in = out.in_sample;
  out.score = in.score = -cost_of(runs.raw_energies, weighting);
  Moments scores;
  for (const Energies& replicate : runs.replicate_energies) scores.add(-cost_of(replicate, weighting));
  in.score_se = scores.standard_error();
  out.energies = Energies(runs.raw_energies.size());
  for (std::size_t j = 0; j < out.energies.size(); ++j)
    out.energies[j] = weighting.p2[j] > 0 ? (runs.raw_energies[j] - weighting.p1[j]) / weighting.p2[j] : 0;
  return out;
}

Order order_by_score(const std::vector<ModelFit>& models) {
  Order order(models.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto score = [&](std::size_t k) { return std::isnan(models[k].standing.score) ? -INFINITY : models[k].standing.score; };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return score(a) > score(b); });
  return order;
}

Trial in_order(Trial trial, const Order& order) {
  trial.models = in_order(std::move(trial.models), order);
  trial.bootstraps.of = in_order(std::move(trial.bootstraps.of), order);
  trial.bootstraps.scatter = in_order(std::move(trial.bootstraps.scatter), order);
  trial.bootstraps.recordings = trial.bootstraps.of.front();
  return trial;
}

void number(std::vector<ModelFit>& models) {
  const auto better = [&](double score) {
    return std::count_if(models.begin(), models.end(), [&](const ModelFit& other) { return other.standing.in_sample.score > score; });
  };
  for (std::size_t k = 0; k < models.size(); ++k) {
    Standing& s = models[k].standing;
    s.rank = std::isfinite(s.score) ? static_cast<int>(k) + 1 : 0;
    s.in_sample.rank = std::isfinite(s.in_sample.score) ? static_cast<int>(better(s.in_sample.score)) + 1 : 0;
  }
}

}  // namespace swarmfit
