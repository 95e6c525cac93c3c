// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <nlopt.hpp>

#include "fit/optimise/genetic.h"
#include "libtrack/parallel_for.h"

namespace swarmfit {
namespace {

// What nlopt is told of a failure: it compares costs, and takes NaN for a cheap one and infinity for a reason to stop.
constexpr double failed_cost = 1e300;

struct Run {
  const PointCost& cost;
  int limit;
  Evaluated best;
  std::vector<Evaluated> visited{};
  int evaluations = 0;
  bool converged = false;
  std::exception_ptr error{};
};

double evaluate(const std::vector<double>& x, std::vector<double>&, void* data) {
  Run& run = *static_cast<Run*>(data);
  if (run.evaluations == run.limit) throw nlopt::forced_stop();
  const Point point = Eigen::Map<const Point>(x.data(), static_cast<Eigen::Index>(x.size())).cwiseMax(0.0).cwiseMin(1.0);
  double cost = 0;
  try {
    ++run.evaluations;
    cost = run.cost(point);
  } catch (...) {  // must cross neither nlopt's C code nor the parallel region
    run.error = std::current_exception();
    throw nlopt::forced_stop();
  }
  run.visited.push_back({point, std::isfinite(cost) ? cost : std::numeric_limits<double>::infinity()});
  if (!std::isfinite(cost)) return failed_cost;
  if (cost < run.best.cost) run.best = {point, cost};
  return cost;
}

void minimise(Run& run, const RefineOptions& options) {
  std::vector<double> x(run.best.x.begin(), run.best.x.end());
  nlopt::opt simplex(nlopt::LN_NELDERMEAD, static_cast<unsigned>(x.size()));
  simplex.set_min_objective(evaluate, &run);
  simplex.set_lower_bounds(0.0);
  simplex.set_upper_bounds(1.0);
  simplex.set_initial_step(options.step);
  simplex.set_xtol_abs(options.tolerance);
  try {
    double cost = 0;
    simplex.optimize(x, cost);
    run.converged = true;
  } catch (const nlopt::forced_stop&) {
  } catch (const nlopt::roundoff_limited&) {
    run.converged = true;
  }
}

}  // namespace

SearchResult refine(const std::vector<Evaluated>& starts, const PointCost& cost, const RefineOptions& options) {
  const int refined = options.evaluations > 0 ? std::clamp(options.starts, 0, static_cast<int>(starts.size())) : 0;
  std::vector<Run> runs;
  for (int i = 0; i < refined; ++i) runs.push_back({cost, options.evaluations, starts[i]});
  parallel_for(runs.size(), [&](std::size_t i) { minimise(runs[i], options); });

  SearchResult result;
  result.stop = Stop::converged;
  std::vector<Evaluated> all;
  for (Run& run : runs) {
    if (run.error) std::rethrow_exception(run.error);
    if (!run.converged) result.stop = Stop::evaluations;
    result.evaluations += run.evaluations;
    result.visited.insert(result.visited.end(), run.visited.begin(), run.visited.end());
    all.push_back(run.best);
  }
  all.insert(all.end(), starts.begin() + refined, starts.end());
  std::stable_sort(all.begin(), all.end(), [](const Evaluated& a, const Evaluated& b) { return a.cost < b.cost; });
  for (const Evaluated& e : all) {
    const auto is_same = [&](const Evaluated& other) { return same(other.x, e.x); };
    if (std::none_of(result.best.begin(), result.best.end(), is_same)) result.best.push_back(e);
  }
  return result;
}

}  // namespace swarmfit
