// SPDX-License-Identifier: MIT
// The search: a real-coded genetic algorithm for expensive, noisy objectives on the unit cube, and local refinement by nlopt.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "libtrack/rng.h"

namespace swarmfit {

using Point = Eigen::VectorXd;  // in [0, 1]^d

// Costs of a whole batch, lower is better; +inf or NaN: failed. Called with a whole generation so that the caller can run it in parallel.
// Must be a function of the points alone.
using BatchCost = std::function<std::vector<double>(const std::vector<Point>&)>;

struct GeneticOptions {
  int population = 40;
  int generations = 60;
  int stall = 15;  // stop after so many generations without a relative gain of `gain`
  double gain = 1e-3;
  int elites = 2;
  std::int64_t max_evaluations = 0;  // hard limit; 0: none
};

// Why a search ended.
enum class Stop { generations, stalled, evaluations, interrupted, converged };
std::string to_string(Stop);

struct Evaluated {
  Point x;
  double cost;
};

struct SearchResult {
  std::vector<Evaluated> best;  // distinct, ascending in cost; at most the size of the population
  std::int64_t evaluations = 0;
  int generations = 0;
  Stop stop = Stop::generations;
};

// Told after every generation; returning false interrupts the search.
struct GenerationReport {
  int generation;
  std::int64_t evaluations;
  double best;
};
using OnGeneration = std::function<bool(const GenerationReport&)>;

// Starts from `start` (best first; may be empty), filled up by a scrambled low-discrepancy or random sample.
SearchResult genetic_search(int dimensions, const BatchCost& cost, const GeneticOptions& options, const Rng& rng,
                            const std::vector<Evaluated>& start = {}, const OnGeneration& on_generation = {});

struct RefineOptions {
  int starts = 2;           // refined in parallel from the best few
  int evaluations = 100;    // per start
  double tolerance = 1e-6;  // on x
};

// Nelder–Mead inside the cube (nlopt LN_NELDERMEAD). The cost of one point; may be called from several threads at once.
using PointCost = std::function<double(const Point&)>;
SearchResult refine(const std::vector<Evaluated>& starts, const PointCost& cost, const RefineOptions& options);

}  // namespace swarmfit
