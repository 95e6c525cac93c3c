// SPDX-License-Identifier: MIT
#include "fit/genetic.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "libtrack/error.h"

namespace swarmfit {
namespace {

constexpr double failed = std::numeric_limits<double>::infinity();
constexpr double same_point = 1e-9;  // largest coordinate difference of points that count as one
constexpr int memory_size = 6;       // success history, jSO
constexpr double pbest_share = 0.15;
constexpr int redraws = 4;

// The draws of one individual in one generation, one after the other.
class Draws {
 public:
  Draws(const Rng& rng, int generation, int individual)
      : rng_(rng), tick_(static_cast<std::uint64_t>(generation)), id_(static_cast<std::uint32_t>(individual)) {}
  double uniform() { return rng_.uniform(Stream::search, tick_, id_, draw_++); }
  double normal() { return rng_.normal2(Stream::search, tick_, id_, draw_++)[0]; }
  double cauchy() { return std::tan(std::numbers::pi * (uniform() - 0.5)); }
  int index(int n) { return std::min(static_cast<int>(uniform() * n), n - 1); }

 private:
  const Rng& rng_;
  std::uint64_t tick_;
  std::uint32_t id_, draw_ = 0;
};

bool same(const Point& a, const Point& b) { return (a - b).lpNorm<Eigen::Infinity>() < same_point; }

bool cheaper(const Evaluated& a, const Evaluated& b) { return a.cost < b.cost; }

std::vector<Point> latin_hypercube(int points, int dimensions, const Rng& rng) {
  std::vector<Point> sample(points, Point(dimensions));
  std::vector<int> cell(points);
  for (int k = 0; k < dimensions; ++k) {
    Draws draws(rng, 0, k);
    std::iota(cell.begin(), cell.end(), 0);
    for (int i = points - 1; i > 0; --i) std::swap(cell[i], cell[draws.index(i + 1)]);
    for (int i = 0; i < points; ++i) sample[i][k] = (cell[i] + draws.uniform()) / points;
  }
  return sample;
}

struct Step {
  double scale, crossover;
};

class Search {
 public:
  Search(int dimensions, const BatchCost& cost, const GeneticOptions& options, const Rng& rng)
      : dimensions_(dimensions), cost_(cost), options_(options), rng_(rng), memory_(memory_size, Step{0.5, 0.8}) {}

  SearchResult run(const std::vector<Evaluated>& start, const OnGeneration& on_generation);

 private:
  std::vector<Evaluated> evaluate(std::vector<Point> points);
  void first_generation(const std::vector<Evaluated>& start);
  void next_generation();
  Step draw_step(Draws& draws) const;
  Point offspring(int parent, const Step& step, Draws& draws) const;
  const Point& other(int parent, int first, Draws& draws) const;
  void learn(const std::vector<Step>& steps, const std::vector<double>& gains);
  bool exhausted() const { return options_.max_evaluations > 0 && evaluations_ >= options_.max_evaluations; }
  double best() const { return population_.empty() ? failed : std::min_element(population_.begin(), population_.end(), cheaper)->cost; }

  int dimensions_;
  const BatchCost& cost_;
  const GeneticOptions& options_;
  const Rng& rng_;
  std::vector<Evaluated> population_;
  std::vector<Point> archive_;  // replaced parents
  std::vector<Step> memory_;
  int oldest_ = 0, generation_ = 0;
  std::int64_t evaluations_ = 0;
};

std::vector<Evaluated> Search::evaluate(std::vector<Point> points) {
  if (options_.max_evaluations > 0) {
    const auto left = options_.max_evaluations - evaluations_;
    if (static_cast<std::int64_t>(points.size()) > left) points.resize(static_cast<std::size_t>(std::max<std::int64_t>(left, 0)));
  }
  if (points.empty()) return {};
  const std::vector<double> costs = cost_(points);
  assert(costs.size() == points.size());
  evaluations_ += static_cast<std::int64_t>(points.size());
  std::vector<Evaluated> evaluated;
  for (std::size_t i = 0; i < points.size(); ++i) evaluated.push_back({std::move(points[i]), std::isfinite(costs[i]) ? costs[i] : failed});
  return evaluated;
}

void Search::first_generation(const std::vector<Evaluated>& start) {
  for (const Evaluated& e : start) {
    if (static_cast<int>(population_.size()) == options_.population) break;
    const bool known = std::any_of(population_.begin(), population_.end(), [&](const Evaluated& p) { return same(p.x, e.x); });
    if (!known && std::isfinite(e.cost)) population_.push_back(e);
  }
  const int missing = options_.population - static_cast<int>(population_.size());
  for (Evaluated& e : evaluate(latin_hypercube(missing, dimensions_, rng_))) population_.push_back(std::move(e));
}

Step Search::draw_step(Draws& draws) const {
  const Step& mean = memory_[draws.index(memory_size)];
  Step step{};
  step.crossover = std::clamp(mean.crossover + 0.1 * draws.normal(), 0.0, 1.0);
  do step.scale = mean.scale + 0.1 * draws.cauchy();
  while (step.scale <= 0);
  step.scale = std::min(step.scale, 1.0);
  return step;
}

const Point& Search::other(int parent, int first, Draws& draws) const {
  const int n = static_cast<int>(population_.size());
  int k = 0;
  do k = draws.index(n + static_cast<int>(archive_.size()));
  while (k == parent || k == first);
  return k < n ? population_[k].x : archive_[k - n];
}

// Current-to-pbest/1 with archive and binomial crossover. The population is sorted.
Point Search::offspring(int parent, const Step& step, Draws& draws) const {
  const int n = static_cast<int>(population_.size());
  const Point& x = population_[parent].x;
  const Point& leader = population_[draws.index(std::max(2, static_cast<int>(std::lround(pbest_share * n))))].x;
  int first = 0;
  do first = draws.index(n);
  while (first == parent);
  const Point& second = other(parent, first, draws);
  const int certain = draws.index(dimensions_);
  Point child = x;
  for (int k = 0; k < dimensions_; ++k) {
    if (draws.uniform() >= step.crossover && k != certain) continue;
    const double v = x[k] + step.scale * (leader[k] - x[k] + population_[first].x[k] - second[k]);
    child[k] = v < 0 ? x[k] / 2 : v > 1 ? (1 + x[k]) / 2 : v;
  }
  return child;
}

void Search::next_generation() {
  std::stable_sort(population_.begin(), population_.end(), cheaper);
  const int n = static_cast<int>(population_.size());
  std::vector<Point> children;
  std::vector<Step> steps;
  const auto taken = [&](const Point& x) {
    return std::any_of(population_.begin(), population_.end(), [&](const Evaluated& p) { return same(p.x, x); }) ||
           std::any_of(children.begin(), children.end(), [&](const Point& c) { return same(c, x); });
  };
  for (int i = 0; i < n; ++i) {
    Draws draws(rng_, generation_, i);
    Step step = draw_step(draws);
    Point child = offspring(i, step, draws);
    for (int attempt = 0; attempt < redraws && taken(child); ++attempt) {
      step = draw_step(draws);
      child = offspring(i, step, draws);
    }
    while (taken(child)) {
      for (double& v : child) v = draws.uniform();
    }
    children.push_back(std::move(child));
    steps.push_back(step);
  }
  std::vector<Step> winners;
  std::vector<double> gains;
  auto evaluated = evaluate(std::move(children));
  for (std::size_t i = 0; i < evaluated.size(); ++i) {
    Evaluated& parent = population_[i];
    if (!(evaluated[i].cost < parent.cost)) continue;
    if (std::isfinite(parent.cost)) {
      winners.push_back(steps[i]);
      gains.push_back(parent.cost - evaluated[i].cost);
      if (static_cast<int>(archive_.size()) < options_.population) {
        archive_.push_back(parent.x);
      } else {
        archive_[Draws(rng_, generation_, n + static_cast<int>(i)).index(options_.population)] = parent.x;
      }
    }
    parent = std::move(evaluated[i]);
  }
  learn(winners, gains);
}

void Search::learn(const std::vector<Step>& steps, const std::vector<double>& gains) {
  if (steps.empty()) return;
  double f1 = 0, f2 = 0, c1 = 0, c2 = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    f1 += gains[i] * steps[i].scale;
    f2 += gains[i] * steps[i].scale * steps[i].scale;
    c1 += gains[i] * steps[i].crossover;
    c2 += gains[i] * steps[i].crossover * steps[i].crossover;
  }
  if (f1 > 0) memory_[oldest_].scale = f2 / f1;
  memory_[oldest_].crossover = c1 > 0 ? c2 / c1 : 0;
  oldest_ = (oldest_ + 1) % memory_size;
}

SearchResult Search::run(const std::vector<Evaluated>& start, const OnGeneration& on_generation) {
  SearchResult result;
  double record = failed;
  int since = 0;
  while (true) {
    ++generation_;
    if (generation_ == 1) {
      first_generation(start);
    } else {
      next_generation();
    }
    const double now = best();
    if (now < record - options_.gain * std::abs(record) || (std::isinf(record) && now < record)) {
      record = now;
      since = 0;
    } else {
      ++since;
    }
    if (on_generation && !on_generation({generation_, evaluations_, now})) {
      result.stop = Stop::interrupted;
    } else if (exhausted()) {
      result.stop = Stop::evaluations;
    } else if (since >= options_.stall) {
      result.stop = Stop::stalled;
    } else if (generation_ >= options_.generations) {
      result.stop = Stop::generations;
    } else {
      continue;
    }
    break;
  }
  std::stable_sort(population_.begin(), population_.end(), cheaper);
  result.best = population_;
  std::erase_if(result.best, [](const Evaluated& e) { return !std::isfinite(e.cost); });
  result.evaluations = evaluations_;
  result.generations = generation_;
  return result;
}

}  // namespace

std::string to_string(Stop stop) {
  switch (stop) {
    case Stop::generations:
      return "generations";
    case Stop::stalled:
      return "stalled";
    case Stop::evaluations:
      return "evaluations";
    case Stop::interrupted:
      return "interrupted";
    case Stop::converged:
      return "converged";
  }
  return "";
}

SearchResult genetic_search(int dimensions, const BatchCost& cost, const GeneticOptions& options, const Rng& rng,
                            const std::vector<Evaluated>& start, const OnGeneration& on_generation) {
  if (dimensions < 1) throw InputError("search: no parameter to search; expected at least one");
  if (options.population < 4) throw InputError("search: population " + std::to_string(options.population) + "; expected at least 4");
  return Search(dimensions, cost, options, rng).run(start, on_generation);
}

}  // namespace swarmfit
