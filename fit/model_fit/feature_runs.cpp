// SPDX-License-Identifier: MIT
#include "fit/model_fit/feature_runs.h"

namespace swarmfit {

Simulator feature_runs(const SearchSpace& space, const Ensemble& ensemble, const std::string& name, const Features& features) {
  return [&space, &ensemble, name, &features](const std::vector<Draw>& draws) {
    std::vector<Job> jobs;
    for (const Draw& draw : draws) jobs.push_back({space.parameters(draw.x), draw.rng});
    using Values = std::optional<std::vector<double>>;
    const auto measured = ensemble.measured<Values>(jobs, name, [&](const Run& run, std::size_t) -> Values {
      if (run.blew_up || run.seen.rows() == 0) return {};
      const Eigen::VectorXd f = features(run.seen);
      return std::vector<double>(f.begin(), f.end());
    });
    std::vector<std::optional<Eigen::VectorXd>> out;
    for (const Values& values : measured) {
      out.emplace_back();
      if (values) out.back() = Eigen::Map<const Eigen::VectorXd>(values->data(), static_cast<Index>(values->size()));
    }
    return out;
  };
}

}  // namespace swarmfit
