// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "fit/optimise/differential_evolution.h"
#include "fit/optimise/quadratic_model.h"
#include "libtrack/error.h"
#include "libtrack/nan.h"

namespace swarmfit {
namespace {

constexpr double kBeginnings = 0.9;     // of the genetic algorithm's budget, shared out equally; the rest goes on from the best
constexpr int kFewestGenerations = 10;  // a beginning of fewer tells nothing about its valley

double cost_of_one(const BatchCost& cost, const Point& x) { return cost({x}).front(); }

std::int64_t budget_of(const EvolutionOptions& options) {
  const std::int64_t planned = std::int64_t{options.population} * options.generations;
  return options.max_evaluations > 0 ? std::min(options.max_evaluations, planned) : planned;
}

void append_succeeded(std::vector<Evaluated>& to, const std::vector<Evaluated>& from) {
  std::copy_if(from.begin(), from.end(), std::back_inserter(to), [](const Evaluated& e) { return std::isfinite(e.cost); });
}

// How rough the landscape is about `best`. The simplexes zoomed in on it: if the landscape is smooth, the nearest of their points lie on a
// quadratic, otherwise its residuals are most of the variance. Without enough of their points nothing can be told: the many valleys of a
// smooth landscape, seen from afar, look just as rough.
double roughness_near(const Evaluated& best, const std::vector<Evaluated>& refinement) {
  std::vector<Evaluated> points;
  append_succeeded(points, refinement);
  const Eigen::Index d = best.x.size();
  const auto model = fit_quadratic(points, {best.x, Eigen::MatrixXd::Identity(d, d)}, 3 * quadratic_coefficients(static_cast<int>(d)));
  return model && model->explained < 0.5 ? model->residual_sd : 0;
}

// The surface's minimum is one more candidate. By how much may the best be cheaper out of luck? The least of n normal numbers lies
// about sqrt(2 ln n) standard deviations below the mean; two more for the candidate's own roughness.
void try_response_surface(Found& found, const BatchCost& cost, const std::vector<Evaluated>& start) {
  std::vector<Evaluated> known;
  append_succeeded(known, found.visited);
  append_succeeded(known, start);
  const auto surface = response_surface(known);
  if (!surface) return;
  Evaluated candidate{surface->minimum, cost_of_one(cost, surface->minimum)};
  if (!std::isfinite(candidate.cost)) candidate.cost = std::numeric_limits<double>::infinity();
  ++found.evaluations;
  found.visited.push_back(candidate);
  const double luck = found.roughness * (std::sqrt(2 * std::log(static_cast<double>(known.size()))) + 2);
  if (candidate.cost <= found.best.front().cost + luck) found.recommended = candidate;
  if (candidate.cost < found.best.front().cost) {
    std::erase_if(found.best, [&](const Evaluated& e) { return same(e.x, candidate.x); });
    found.best.insert(found.best.begin(), candidate);
  }
}

// The genetic algorithm, from as many beginnings as the budget is worth.
SearchResult evolve(int dimensions, const BatchCost& cost, const SearchOptions& options, const EvolutionOptions& whole, const Rng& rng,
                    const std::vector<Evaluated>& start, const OnGeneration& on_generation) {
  const std::int64_t budget = budget_of(whole), least = std::int64_t{kFewestGenerations} * whole.population;
  const std::int64_t beginnings = std::min<std::int64_t>(options.beginnings, budget / least);
  if (beginnings < 2) return differential_evolution(dimensions, cost, whole, rng, start, on_generation);

  SearchResult all;
  double best = std::numeric_limits<double>::infinity();
  const auto report = [&](const GenerationReport& now) {
    best = std::min(best, now.best);
    return !on_generation || on_generation({all.generations + now.generation, all.evaluations + now.evaluations, best});
  };
  const auto run = [&](std::int64_t evaluations, std::int64_t k, const std::vector<Evaluated>& from) {
    EvolutionOptions part = whole;
    part.max_evaluations = evaluations;
    const SearchResult found =
        differential_evolution(dimensions, cost, part, rng.derive(Stream::search, static_cast<std::uint64_t>(k)), from, report);
    all.evaluations += found.evaluations;
    all.generations += found.generations;
    all.visited.insert(all.visited.end(), found.visited.begin(), found.visited.end());
    all.best.insert(all.best.end(), found.best.begin(), found.best.end());
    std::stable_sort(all.best.begin(), all.best.end(), [](const Evaluated& a, const Evaluated& b) { return a.cost < b.cost; });
    all.stop = found.stop;
  };
  const auto each = static_cast<std::int64_t>(kBeginnings * static_cast<double>(budget)) / beginnings;
  for (std::int64_t k = 0; k < beginnings && all.stop != Stop::interrupted; ++k) run(each, k, k == 0 ? start : std::vector<Evaluated>{});
  if (all.stop == Stop::interrupted) return all;
  all.best.clear();  // they are the last population, as far as they are good enough
  std::vector<Evaluated> known = start;
  append_succeeded(known, all.visited);
  run(budget - all.evaluations, beginnings, known);
  return all;
}

}  // namespace

Found search(int dimensions, const BatchCost& cost, const SearchOptions& options, const Rng& rng, const std::vector<Evaluated>& start,
             const OnGeneration& on_generation) {
  if (!(options.refine_share >= 0 && options.refine_share < 1)) {
    throw InputError("search: refine share " + std::to_string(options.refine_share) + "; expected at least 0 and less than 1");
  }
  const std::int64_t budget = budget_of(options.evolution);
  EvolutionOptions evolution = options.evolution;
  const double refine_share = options.evolution_only ? 0 : options.refine_share;
  evolution.max_evaluations = std::max<std::int64_t>(1, budget - static_cast<std::int64_t>(refine_share * static_cast<double>(budget)));
  Found found{evolve(dimensions, cost, options, evolution, rng, start, on_generation), {{}, kNaN}, 0};
  if (found.best.empty()) return found;
  if (found.stop != Stop::interrupted && !options.evolution_only) {
    RefineOptions refinement = options.refine;
    refinement.starts = std::clamp(refinement.starts, 1, static_cast<int>(found.best.size()));
    refinement.evaluations = static_cast<int>((budget - found.evaluations - 1) / refinement.starts);
    if (refinement.evaluations > 0) {
      SearchResult refined = refine(found.best, cost, refinement);
      found.evaluations += refined.evaluations;
      found.visited.insert(found.visited.end(), refined.visited.begin(), refined.visited.end());
      found.best = std::move(refined.best);
      found.roughness = roughness_near(found.best.front(), refined.visited);
    }
  }
  found.recommended = found.best.front();
  if (found.stop != Stop::interrupted && !options.evolution_only && found.evaluations < budget) try_response_surface(found, cost, start);
  return found;
}

}  // namespace swarmfit
