// SPDX-License-Identifier: MIT
#include "fit/model_fit/race.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swarmfit {

double cost_of(const Energies& energies, const Weighting& weighting) {
  const double value = score(Eigen::Map<const Eigen::VectorXd>(energies.data(), static_cast<Index>(energies.size())), weighting);
  return std::isfinite(value) ? -value : std::numeric_limits<double>::infinity();
}

Eigen::VectorXd parts_of(const Differences& differences, const Weighting& weighting) {
  Eigen::VectorXd parts(static_cast<Index>(differences.size()));
  for (std::size_t k = 0; k < differences.size(); ++k) {
    const std::size_t column = k / kDifferences;
    const double p2 = weighting.p2[column];
    parts[static_cast<Index>(k)] = p2 > 0 ? std::sqrt(weighting.weights[column] / p2) * differences[k] : 0;
  }
  return parts;
}

std::vector<Outcome> simulate(const Round& round, const std::vector<Point>& points, const SearchSpace& space, const Objective& objective,
                              const Objective::Worth& worth) {
  std::vector<std::vector<double>> candidates;
  for (const auto& x : points) candidates.push_back(space.parameters(x));
  const auto all = [](const std::vector<Outcome>& first) { return std::vector<bool>(first.size(), true); };
  return objective.race(candidates, round.seeds, screening_replicates(round.seeds.size()), worth ? worth : all);
}

bool Race::Lexicographic::operator()(const Point& a, const Point& b) const {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

Race::Race(const Round& round, const SearchSpace& space, const Objective& objective, const Weighting& weighting)
    : round_(round), space_(space), objective_(objective), weighting_(weighting) {
  for (const auto& a : round.archive) archived_.insert_or_assign(a.x, costs(a.first, a.guided));
}

std::vector<double> Race::cost(const std::vector<Point>& points) {
  auto outcomes = simulate(round_, points, space_, objective_);
  return remember(points, outcomes);
}

std::vector<double> Race::against(const std::vector<Point>& children, const std::vector<Point>& parents) {
  std::vector<Costs> rivals;
  for (const Point& x : parents) rivals.push_back(known(x));
  auto outcomes = simulate(round_, children, space_, objective_, [&](const std::vector<Outcome>& heat) {
    std::vector<bool> worth;
    for (std::size_t k = 0; k < heat.size(); ++k) worth.push_back(screening_.worth(cost_of(heat[k].first, weighting_) - rivals[k].first));
    return worth;
  });
  for (std::size_t k = 0; k < children.size(); ++k) {
    if (!round_.complete(outcomes[k])) continue;
    const Costs child = costs(outcomes[k].first, outcomes[k].guided);
    screening_.learn(child.first - rivals[k].first, child.all - rivals[k].all);
  }
  return remember(children, outcomes);
}

Race::Costs Race::known(const Point& x) const {
  const auto old = archived_.find(x);
  return old != archived_.end() ? old->second : costs(seen(x).first, seen(x).guided);
}

std::vector<double> Race::remember(const std::vector<Point>& points, std::vector<Outcome>& outcomes) {
  std::vector<double> costs;
  for (std::size_t k = 0; k < points.size(); ++k) {
    costs.push_back(round_.complete(outcomes[k]) ? cost_of(outcomes[k].guided, weighting_) : std::numeric_limits<double>::infinity());
    seen_.insert_or_assign(points[k], std::move(outcomes[k]));
  }
  return costs;
}

}  // namespace swarmfit
