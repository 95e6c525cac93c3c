// SPDX-License-Identifier: MIT
// The search for a minimum on the unit cube when a cost is expensive and its landscape rough: a real-coded genetic algorithm,
// refinement by nlopt, and both in one budget. How the methods were chosen: docs/search.md.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "libtrack/rng.h"

namespace swarmfit {

using Point = Eigen::VectorXd;  // in [0, 1]^d

// Points that differ by less than this in every coordinate count as one: no candidate is tried twice, no leader listed twice.
inline constexpr double same_point = 1e-6;
inline bool same(const Point& a, const Point& b) { return (a - b).lpNorm<Eigen::Infinity>() < same_point; }

// Costs of a whole batch, lower is better; infinite or NaN: failed, and never wins. Called with a whole generation so that the caller
// can run it in parallel. Must be a function of the points alone.
using BatchCost = std::function<std::vector<double>(const std::vector<Point>&)>;

// The same for children that are of use only if they are cheaper than their parents: +inf also for one that was given up as too dear.
using RaceCost = std::function<std::vector<double>(const std::vector<Point>& children, const std::vector<Point>& parents)>;

struct Evaluated {
  Point x;
  double cost = 0;
  Eigen::VectorXd parts{};  // what the cost is made of, if that is known: see EvolutionOptions::parts
};

// Why a search ended.
enum class Stop {
  generations,  // the plan of population × generations evaluations is used up
  stalled,      // no gain for long enough
  evaluations,  // max_evaluations is used up
  interrupted,  // the callback said so
  converged     // all candidates, or all corners of every simplex, are one point
};
std::string to_string(Stop);

struct SearchResult {
  std::vector<Evaluated> best;     // distinct, ascending in cost, none failed
  std::vector<Evaluated> visited;  // every point evaluated, in order; cost +inf: failed or given up
  std::int64_t evaluations = 0;    // = visited.size()
  int generations = 0;
  Stop stop = Stop::generations;
};

struct EvolutionOptions {
  // At the start, at least 4; shrinks linearly to a fifth over the planned evaluations.
  int population = 40;
  // population × generations evaluations are planned: as the population shrinks, generations become smaller and more.
  int generations = 60;
  // Stop after stall × population evaluations in which neither the best nor the worst of the best fifth gained `gain` of its cost.
  int stall = 15;
  double gain = 1e-3;
  // Hard limit where it is less than planned; 0: none.
  std::int64_t max_evaluations = 0;
  // In place of BatchCost for all but the first population; none: BatchCost.
  RaceCost race = {};
  // Signed numbers, equally many for every point, that are small where the cost is: of a point that has just been evaluated. With them
  // a least-squares step can be tried; none: no such steps.
  std::function<Eigen::VectorXd(const Point&)> parts = {};
};

// Told after every generation, the initial sample being the first; returning false interrupts the search.
struct GenerationReport {
  int generation;
  std::int64_t evaluations;
  double best;  // cost; infinite while every candidate has failed
};
using OnGeneration = std::function<bool(const GenerationReport&)>;

// Differential evolution, current-to-pbest/1/bin with an archive of replaced parents, step and crossover adapted by success (SHADE,
// Tanabe and Fukunaga 2013, doi:10.1109/CEC.2013.6557555), shrinking population (L-SHADE, 2014, doi:10.1109/CEC.2014.6900380). One
// candidate per generation is the minimum of a quadratic fitted to the evaluated points around the leaders. A parent is replaced only
// by a cheaper child, so the best is never lost. A child outside the cube is put halfway between its parent and the bound.
// The first population is `start` (known costs, trusted and not evaluated again; the best of them if there are more than `population`)
// filled up by a Latin hypercube; all of them inform the quadratic. The result's best are the last population. Throws InputError for
// options out of range.
SearchResult differential_evolution(int dimensions, const BatchCost& cost, const EvolutionOptions& options, const Rng& rng,
                                    const std::vector<Evaluated>& start = {}, const OnGeneration& on_generation = {});

struct RefineOptions {
  int starts = 2;           // how many of the best are refined, side by side
  int evaluations = 100;    // per start, hard limit
  double step = 0.05;       // size of the first simplex
  double tolerance = 1e-6;  // on x
};

// Nelder–Mead inside the cube (nlopt LN_NELDERMEAD: Box 1965 at the bounds). `starts` ascending in cost; the result holds the refined and
// the others, and is never worse than the starts. Every batch holds the next point of each simplex that has not ended. An exception of
// `cost` is passed on.
SearchResult refine(const std::vector<Evaluated>& starts, const BatchCost& cost, const RefineOptions& options);

struct SearchOptions {
  // The genetic algorithm begins so often anew, with a share of the budget each, and at last goes on from the best of what all of them
  // found: where a landscape has several valleys, a population settles in one of them by chance. Fewer, if the budget is small.
  int beginnings = 1;
  EvolutionOptions evolution;   // its planned evaluations or max_evaluations, whichever is less, is the budget of everything
  RefineOptions refine;         // its evaluations follow from the budget
  double refine_share = 0.05;   // of the budget that the genetic algorithm leaves to the refinement, in [0, 1)
  bool evolution_only = false;  // neither refinement nor response surface
};

// What a whole search found; `generations` are the genetic algorithm's, `stop` its last one's. On a rough landscape the cheapest point is
// mostly a lucky one; `recommended` is then the minimum of a quadratic through all points of the valley (a response surface), which
// averages the roughness out.
struct Found : SearchResult {
  Evaluated recommended;  // best.front() on a smooth landscape; NaN cost and no coordinates when every evaluation failed
  double roughness = 0;   // standard deviation of the costs about a smooth surface near the best; 0: smooth, or too few points to tell
};

// differential_evolution, once or more, then refine, then one evaluation of the response surface's minimum; never more evaluations than the
// budget. Candidates of final comparisons on fresh random numbers: `recommended` and the first of `best`.
Found search(int dimensions, const BatchCost& cost, const SearchOptions& options, const Rng& rng, const std::vector<Evaluated>& start = {},
             const OnGeneration& on_generation = {});

// Points of the unit cube, of which every coordinate takes each of the `count` equal intervals exactly once (McKay, Beckman and Conover
// 1979).
std::vector<Point> latin_hypercube(int count, int dimensions, const Rng& rng);

}  // namespace swarmfit
