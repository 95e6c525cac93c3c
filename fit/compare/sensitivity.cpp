// SPDX-License-Identifier: MIT
#include "fit/compare/sensitivity.h"

#include <algorithm>
#include <cmath>

#include "libtrack/nan.h"

namespace swarmfit {
namespace {

double score_with(const Energies& energies, const PerColumn<double>& weights) {
  double total = 0, loss = 0;
  for (std::size_t j = 0; j < weights.size(); ++j) {
    if (!(weights[j] > 0)) continue;
    total += weights[j];
    loss += weights[j] * energies[j];
  }
  return total > 0 ? 1 - loss / total : kNaN;
}

// 1 is best, equal scores share a rank; 0 for an undefined score.
int rank_of(double score, const std::vector<double>& all) {
  if (!std::isfinite(score)) return 0;
  return 1 + static_cast<int>(std::count_if(all.begin(), all.end(), [score](double other) { return other > score; }));
}

}  // namespace

std::vector<Sensitivity> sensitivities(const std::vector<Energies>& models, const PerColumn<double>& weights) {
  const std::size_t columns = weights.size();
  std::vector<Sensitivity> out(models.size(), {PerColumn<double>(columns), PerColumn<double>(columns), PerColumn<int>(columns)});
  for (std::size_t j = 0; j < columns; ++j) {
    PerColumn<double> without = weights, doubled = weights;
    without[j] = 0;
    doubled[j] *= 2;
    std::vector<double> scores;
    for (const Energies& energies : models) scores.push_back(weights[j] > 0 ? score_with(energies, without) : kNaN);
    for (std::size_t k = 0; k < models.size(); ++k) {
      out[k].without[j] = scores[k];
      out[k].doubled[j] = weights[j] > 0 ? score_with(models[k], doubled) : kNaN;
      out[k].rank_without[j] = rank_of(scores[k], scores);
    }
  }
  return out;
}

}  // namespace swarmfit
