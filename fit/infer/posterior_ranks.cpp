// SPDX-License-Identifier: MIT
#include "fit/infer/posterior_ranks.h"

#include <algorithm>
#include <cmath>

#include "libtrack/nan.h"

namespace swarmfit {
namespace {

template <class Counts>
double share(const WeightedSample& sample, const Counts& counts) {
  double some = 0, all = 0;
  for (std::size_t k = 0; k < sample.points.size(); ++k) {
    all += sample.weights[k];
    if (counts(sample.points[k])) some += sample.weights[k];
  }
  return all > 0 ? some / all : kNaN;
}

}  // namespace

double rank_of(const WeightedSample& sample, Eigen::Index coordinate, double truth) {
  return share(sample, [&](const Point& x) { return x[coordinate] < truth; });
}

double nearer_than(const WeightedSample& sample, const Point& reference, const Point& truth) {
  const double distance2 = (truth - reference).squaredNorm();
  return share(sample, [&](const Point& x) { return (x - reference).squaredNorm() < distance2; });
}

double distance_from_uniform(std::span<const double> values) {
  std::vector<double> sorted;
  std::copy_if(values.begin(), values.end(), std::back_inserter(sorted), [](double v) { return std::isfinite(v); });
  if (sorted.empty()) return kNaN;
  std::sort(sorted.begin(), sorted.end());
  const auto n = static_cast<double>(sorted.size());
  double most = 0;
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    const auto below = static_cast<double>(k);
    most = std::max({most, sorted[k] - below / n, (below + 1) / n - sorted[k]});
  }
  return most;
}

double uniform_band(std::size_t n, std::size_t samples) {
  return std::sqrt(std::log(2 * static_cast<double>(samples) / 0.05) / (2 * static_cast<double>(n)));
}

}  // namespace swarmfit
