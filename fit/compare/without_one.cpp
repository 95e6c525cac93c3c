// SPDX-License-Identifier: MIT
#include "fit/compare/without_one.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "libeval/leave_one_out.h"

namespace swarmfit {

namespace {

// The models, numbered as they stand, by their scores in sample; undefined ones come last.
std::vector<Index> in_sample_order(const std::vector<ModelFit>& models) {
  std::vector<Index> order(models.size());
  std::iota(order.begin(), order.end(), Index{0});
  const auto score = [&](Index k) {
    const double s = models[static_cast<std::size_t>(k)].standing.in_sample.score;
    return std::isnan(s) ? -INFINITY : s;
  };
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return score(a) > score(b); });
  return order;
}

}  // namespace

std::vector<LeftOut> without_each(const std::vector<ModelFit>& models, const RecordingFacts& recording) {
  const auto& scored = recording.observation.used;
  const auto& resolution = recording.resolution;
  Eigen::MatrixXd table(static_cast<Index>(models.size()), static_cast<Index>(scored.size()));
  for (std::size_t m = 0; m < models.size(); ++m)
    for (std::size_t j = 0; j < scored.size(); ++j) table(static_cast<Index>(m), static_cast<Index>(j)) = models[m].runs.raw_energies[j];
  const std::vector<Index> full = in_sample_order(models);
  std::vector<LeftOut> all;
  for (const WithoutOne& w : leave_one_out(table, {scored.begin(), scored.end()}, {resolution.begin(), resolution.end()})) {
    LeftOut out;
    out.model = models[static_cast<std::size_t>(w.dropped)].model;
    out.weights.assign(w.weighting.weights.begin(), w.weighting.weights.end());
    for (const Index row : w.order)
      out.ranking.emplace_back(models[static_cast<std::size_t>(row)].model, w.scores[static_cast<std::size_t>(row)]);
    std::vector<Index> kept = full;
    std::erase(kept, w.dropped);
    out.reordered = w.order != kept;
    out.winner_changed = w.dropped != full.front() && w.order.front() != full.front();
    all.push_back(std::move(out));
  }
  return all;
}

}  // namespace swarmfit
