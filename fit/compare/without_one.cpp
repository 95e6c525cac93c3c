// SPDX-License-Identifier: MIT
#include "fit/compare/without_one.h"

#include <algorithm>

#include "libeval/leave_one_out.h"

namespace swarmfit {

std::vector<LeftOut> without_each(const std::vector<ModelFit>& models, const RecordingFacts& recording) {
  const auto& scored = recording.observation.used;
  const auto& resolution = recording.resolution;
  Eigen::MatrixXd table(static_cast<Index>(models.size()), static_cast<Index>(scored.size()));
  for (std::size_t m = 0; m < models.size(); ++m)
    for (std::size_t j = 0; j < scored.size(); ++j) table(static_cast<Index>(m), static_cast<Index>(j)) = models[m].runs.raw_energies[j];
  std::vector<LeftOut> all;
  for (const WithoutOne& w : leave_one_out(table, {scored.begin(), scored.end()}, {resolution.begin(), resolution.end()})) {
    LeftOut out;
    out.model = models[static_cast<std::size_t>(w.dropped)].model;
    out.weights.assign(w.weighting.weights.begin(), w.weighting.weights.end());
    for (const Index row : w.order)
      out.ranking.emplace_back(models[static_cast<std::size_t>(row)].model, w.scores[static_cast<std::size_t>(row)]);
    // Rows stand in order of rank.
    out.reordered = !std::is_sorted(w.order.begin(), w.order.end());
    out.winner_changed = w.dropped != 0 && w.order.front() != 0;
    all.push_back(std::move(out));
  }
  return all;
}

}  // namespace swarmfit
