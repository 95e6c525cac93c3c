// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlopt.hpp>

#include "fit/genetic.h"

namespace swarmfit {
namespace {

// What nlopt cannot be given: it treats NaN and infinity as numbers.
constexpr double failed_cost = 1e300;

struct Trace {
  const PointCost& cost;
  Evaluated best;
  std::int64_t evaluations = 0;
};

double evaluate(const std::vector<double>& x, std::vector<double>&, void* data) {
  Trace& trace = *static_cast<Trace*>(data);
  const Point point = Eigen::Map<const Point>(x.data(), static_cast<Eigen::Index>(x.size())).cwiseMax(0.0).cwiseMin(1.0);
  ++trace.evaluations;
  const double cost = trace.cost(point);
  if (!std::isfinite(cost)) return failed_cost;
  if (cost < trace.best.cost) trace.best = {point, cost};
  return cost;
}

struct Refined {
  Evaluated best;
  std::int64_t evaluations;
  bool converged;
};

Refined refine_one(const Evaluated& start, const PointCost& cost, const RefineOptions& options, double step) {
  Trace trace{cost, start};
  const auto n = static_cast<unsigned>(start.x.size());
  nlopt::opt simplex(nlopt::LN_NELDERMEAD, n);
  simplex.set_min_objective(evaluate, &trace);
  simplex.set_lower_bounds(0.0);
  simplex.set_upper_bounds(1.0);
  simplex.set_initial_step(step);
  simplex.set_xtol_abs(options.tolerance);
  simplex.set_maxeval(options.evaluations);
  std::vector<double> x(start.x.begin(), start.x.end());
  double value = 0;
  bool converged = false;
  try {
    converged = simplex.optimize(x, value) != nlopt::MAXEVAL_REACHED;
  } catch (const nlopt::roundoff_limited&) {
    converged = true;
  }
  return {trace.best, trace.evaluations, converged};
}

}  // namespace

SearchResult refine(const std::vector<Evaluated>& starts, const PointCost& cost, const RefineOptions& options) {
  const int n = std::min<int>(options.starts, static_cast<int>(starts.size()));
  SearchResult result;
  std::vector<Refined> refined(n);
#pragma omp parallel for schedule(dynamic, 1)
  for (int i = 0; i < n; ++i) refined[i] = refine_one(starts[i], cost, options, 0.05);
  bool converged = n > 0;
  for (const Refined& r : refined) {
    result.evaluations += r.evaluations;
    result.best.push_back(r.best);
    converged = converged && r.converged;
  }
  for (std::size_t i = n; i < starts.size(); ++i) result.best.push_back(starts[i]);
  std::stable_sort(result.best.begin(), result.best.end(), [](const Evaluated& a, const Evaluated& b) { return a.cost < b.cost; });
  result.stop = converged ? Stop::converged : Stop::evaluations;
  return result;
}

}  // namespace swarmfit
