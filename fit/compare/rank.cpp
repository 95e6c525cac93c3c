// SPDX-License-Identifier: MIT
#include "fit/compare/rank.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "fit/model_fit/race.h"

namespace swarmfit {
namespace {

template <class T>
std::vector<T> in_order(std::vector<T> values, const std::vector<std::size_t>& order) {
  std::vector<T> out;
  for (const std::size_t k : order) out.push_back(std::move(values[k]));
  return out;
}

}  // namespace

Standing standing_of(const FinalRuns& runs, const Weighting& weighting) {
  Standing out;
  out.score = -cost_of(runs.raw_energies, weighting);
  Moments scores;
  for (const Energies& replicate : runs.replicate_energies) scores.add(-cost_of(replicate, weighting));
  out.score_se = scores.standard_error();
  out.energies = Energies(runs.raw_energies.size());
  for (std::size_t j = 0; j < out.energies.size(); ++j)
    out.energies[j] = weighting.p2[j] > 0 ? (runs.raw_energies[j] - weighting.p1[j]) / weighting.p2[j] : 0;
  return out;
}

void rank(std::vector<ModelFit>& models, Laws& laws) {
  std::vector<std::size_t> order(models.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto score = [&](std::size_t k) { return std::isnan(models[k].standing.score) ? -INFINITY : models[k].standing.score; };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return score(a) > score(b); });
  models = in_order(std::move(models), order);
  laws.of = in_order(std::move(laws.of), order);
  laws.scatter = in_order(std::move(laws.scatter), order);
  laws.recordings = laws.of.front();
  for (std::size_t k = 0; k < models.size(); ++k) {
    Standing& standing = models[k].standing;
    standing.rank = std::isfinite(standing.score) ? static_cast<int>(k) + 1 : 0;
  }
}

std::vector<Scored> scored(const std::vector<ModelFit>& models) {
  std::vector<Scored> out;
  for (const ModelFit& fit : models) out.push_back({fit.standing.score, fit.runs.raw_energies});
  return out;
}

}  // namespace swarmfit
