// SPDX-License-Identifier: MIT
#include "fit/compare/sensitivity.h"

#include <algorithm>
#include <cmath>

namespace swarmfit {
namespace {

double score_with(const FitResult& fit, const PerColumn<double>& weights) {
  double total = 0, loss = 0;
  for (std::size_t j = 0; j < weights.size(); ++j) {
    if (!(weights[j] > 0)) continue;
    total += weights[j];
    loss += weights[j] * fit.energies[j];
  }
  return total > 0 ? 1 - loss / total : NAN;
}

// 1 is best, equal scores share a rank; 0 for an undefined score.
int rank_of(double score, const std::vector<double>& all) {
  if (!std::isfinite(score)) return 0;
  return 1 + static_cast<int>(std::count_if(all.begin(), all.end(), [score](double other) { return other > score; }));
}

}  // namespace

void fill_sensitivity(Comparison& c) {
  const std::size_t columns = c.weights.size();
  for (FitResult& fit : c.models) fit.sensitivity = {PerColumn<double>(columns), PerColumn<double>(columns), PerColumn<int>(columns)};
  for (std::size_t j = 0; j < columns; ++j) {
    PerColumn<double> without = c.weights, doubled = c.weights;
    without[j] = 0;
    doubled[j] *= 2;
    std::vector<double> scores;
    for (const FitResult& fit : c.models) scores.push_back(c.weights[j] > 0 ? score_with(fit, without) : NAN);
    for (std::size_t k = 0; k < c.models.size(); ++k) {
      Sensitivity& s = c.models[k].sensitivity;
      s.without[j] = scores[k];
      s.doubled[j] = c.weights[j] > 0 ? score_with(c.models[k], doubled) : NAN;
      s.rank_without[j] = rank_of(scores[k], scores);
    }
  }
}

}  // namespace swarmfit
