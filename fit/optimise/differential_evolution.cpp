// SPDX-License-Identifier: MIT
#include "fit/optimise/differential_evolution.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>

#include "fit/optimise/quadratic_model.h"
#include "libtrack/error.h"

namespace swarmfit {
namespace {

constexpr double failed = std::numeric_limits<double>::infinity();

// Settings of the operators. The measurements behind them: docs/search.md.
constexpr double leader_share = 0.15;  // of the population, among which the p-best is drawn
constexpr int memory_size = 6;         // remembered successful settings
constexpr double first_scale = 0.5;
constexpr double first_crossover[] = {0.2, 0.9};  // alternating: coordinates one by one, and all together
constexpr double setting_spread = 0.1;            // of the settings drawn about a remembered one
constexpr int smallest_share = 5;                 // the population shrinks to one in so many
constexpr int least_population = 4;               // parent, p-best and two others
constexpr int redraws = 4;                        // of a candidate that was tried before; then uniform in the cube
constexpr int model_points = 3;                   // fitted points per coefficient of the quadratic
constexpr int step_points = 3;                    // and of the linear model of a least-squares step

// The random numbers of one candidate in one generation, one after the other.
class Draws {
 public:
  Draws(const Rng& rng, int generation, int candidate)
      : rng_(rng), tick_(static_cast<std::uint64_t>(generation)), id_(static_cast<std::uint32_t>(candidate)) {}
  double uniform() { return rng_.uniform(Stream::search, tick_, id_, draw_++); }
  double normal() { return rng_.normal2(Stream::search, tick_, id_, draw_++)[0]; }
  double cauchy() { return std::tan(std::numbers::pi * (uniform() - 0.5)); }
  int index(int n) { return std::min(static_cast<int>(uniform() * n), n - 1); }

 private:
  const Rng& rng_;
  std::uint64_t tick_;
  std::uint32_t id_, draw_ = 0;
};

bool cheaper(const Evaluated& a, const Evaluated& b) { return a.cost < b.cost; }

}  // namespace

std::vector<Point> latin_hypercube(int count, int dimensions, const Rng& rng) {
  std::vector<Point> sample(count, Point(dimensions));
  std::vector<int> interval(count);
  for (int k = 0; k < dimensions; ++k) {
    Draws draws(rng, 0, k);
    std::iota(interval.begin(), interval.end(), 0);
    for (int i = count - 1; i > 0; --i) std::swap(interval[i], interval[draws.index(i + 1)]);
    for (int i = 0; i < count; ++i) sample[i][k] = (interval[i] + draws.uniform()) / count;
  }
  return sample;
}

namespace {

// Scale and crossover rate of a differential step.
struct Setting {
  double scale, crossover;
};

// The settings that made children cheaper than their parents (SHADE).
class Memory {
 public:
  Memory() {
    for (int i = 0; i < memory_size; ++i) slots_[i] = {first_scale, first_crossover[i % std::size(first_crossover)]};
  }

  Setting draw(Draws& draws) const {
    const Setting& about = slots_[draws.index(memory_size)];
    const double crossover = std::clamp(about.crossover + setting_spread * draws.normal(), 0.0, 1.0);
    double scale = 0;
    do scale = about.scale + setting_spread * draws.cauchy();
    while (scale <= 0);
    return {std::min(scale, 1.0), crossover};
  }

  struct Success {
    Setting setting;
    double gain;  // > 0
  };

  // The oldest slot becomes the Lehmer mean of the successful settings, weighted by gain.
  void learn(const std::vector<Success>& successes) {
    if (successes.empty()) return;
    Setting first{0, 0}, second{0, 0};  // moments
    for (const auto& [setting, gain] : successes) {
      first.scale += gain * setting.scale;
      first.crossover += gain * setting.crossover;
      second.scale += gain * setting.scale * setting.scale;
      second.crossover += gain * setting.crossover * setting.crossover;
    }
    slots_[oldest_] = {second.scale / first.scale, first.crossover > 0 ? second.crossover / first.crossover : 0};
    oldest_ = (oldest_ + 1) % memory_size;
  }

 private:
  Setting slots_[memory_size];
  int oldest_ = 0;
};

// The cost from which the next gain is counted.
struct Record {
  double cost = failed;
  std::int64_t at = 0;  // evaluations

  void update(double now, double gain, std::int64_t evaluations) {
    if (!std::isfinite(now) || (std::isfinite(cost) && !(cost - now > gain * std::abs(cost)))) return;
    cost = now;
    at = evaluations;
  }
};

struct Child {
  Point x;
  Setting setting{};
  bool modelled = false;  // from a model: teaches nothing about settings
};

class Evolution {
 public:
  Evolution(int dimensions, const BatchCost& cost, const EvolutionOptions& options, const Rng& rng)
      : dimensions_(dimensions), cost_(cost), options_(options), rng_(rng) {
    const std::int64_t planned = std::int64_t{options.population} * options.generations;
    budget_ = options.max_evaluations > 0 ? std::min(options.max_evaluations, planned) : planned;
  }

  SearchResult run(const std::vector<Evaluated>& start, const OnGeneration& on_generation);

 private:
  std::vector<double> evaluate(const std::vector<Point>& points, const std::vector<Point>& parents = {});
  void found_population(const std::vector<Evaluated>& start);
  void shrink();
  std::vector<Child> breed() const;
  Child differential_child(int parent, Draws& draws) const;
  std::optional<Point> quadratic_child() const;
  std::optional<Point> least_squares_child() const;
  bool tried(const Point& x, const std::vector<Child>& children) const;
  void select(std::vector<Child> children);
  void keep_replaced(Point parent, Draws& draws);
  bool has_converged() const;
  std::optional<Stop> should_stop();
  SearchResult result(Stop stop) &&;

  int smallest() const { return std::max(least_population, options_.population / smallest_share); }
  int size() const { return static_cast<int>(population_.size()); }
  std::int64_t left() const { return budget_ - evaluations_; }
  double best() const { return population_.empty() ? failed : population_.front().cost; }

  int dimensions_;
  const BatchCost& cost_;
  const EvolutionOptions& options_;
  const Rng& rng_;
  std::int64_t budget_ = 0, evaluations_ = 0;
  int generation_ = 0;
  std::vector<Evaluated> population_;  // ascending in cost
  std::vector<Point> replaced_;        // parents that a child has replaced: where not to go
  std::vector<Evaluated> visited_;
  std::vector<Evaluated> known_;  // the starts and the visited, without failures
  Memory memory_;
  Record best_record_, elite_record_;
};

std::vector<double> Evolution::evaluate(const std::vector<Point>& points, const std::vector<Point>& parents) {
  if (points.empty()) return {};
  std::vector<double> costs = options_.race && !parents.empty() ? options_.race(points, parents) : cost_(points);
  assert(costs.size() == points.size());
  evaluations_ += static_cast<std::int64_t>(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(costs[i])) costs[i] = failed;
    visited_.push_back({points[i], costs[i]});
    if (!std::isfinite(costs[i])) continue;
    if (options_.parts) visited_.back().parts = options_.parts(points[i]);
    known_.push_back(visited_.back());
  }
  return costs;
}

void Evolution::found_population(const std::vector<Evaluated>& start) {
  std::copy_if(start.begin(), start.end(), std::back_inserter(known_), [](const Evaluated& e) { return std::isfinite(e.cost); });
  std::vector<Evaluated> sorted = known_;
  std::stable_sort(sorted.begin(), sorted.end(), cheaper);
  for (const Evaluated& e : sorted) {
    if (size() < options_.population && !tried(e.x, {})) population_.push_back(e);
  }
  const auto missing = static_cast<int>(std::min<std::int64_t>(options_.population - size(), left()));
  const std::vector<Point> sample = latin_hypercube(missing, dimensions_, rng_);
  const std::vector<double> costs = evaluate(sample);
  for (int i = 0; i < missing; ++i) population_.push_back({sample[i], costs[i]});
}

// Linearly from the full population to the smallest over the budget: broad first, thorough at the end.
void Evolution::shrink() {
  const double progress = static_cast<double>(evaluations_) / static_cast<double>(budget_);
  const int wanted = static_cast<int>(std::lround(options_.population + (smallest() - options_.population) * progress));
  if (wanted < size()) population_.resize(wanted);
  if (replaced_.size() > population_.size()) replaced_.resize(population_.size());
}

bool Evolution::tried(const Point& x, const std::vector<Child>& children) const {
  return std::any_of(population_.begin(), population_.end(), [&](const Evaluated& e) { return same(e.x, x); }) ||
         std::any_of(children.begin(), children.end(), [&](const Child& c) { return same(c.x, x); });
}

// Current-to-pbest/1 with binomial crossover.
Child Evolution::differential_child(int parent, Draws& draws) const {
  const int n = size();
  const Setting setting = memory_.draw(draws);
  const Point& leader = population_[draws.index(std::max(2, static_cast<int>(std::lround(leader_share * n))))].x;
  int towards = 0, from = 0;
  do towards = draws.index(n);
  while (towards == parent);
  do from = draws.index(n + static_cast<int>(replaced_.size()));
  while (from == parent || from == towards);
  const Point& x = population_[parent].x;
  const Point& a = population_[towards].x;
  const Point& b = from < n ? population_[from].x : replaced_[from - n];

  Child child{x, setting};
  const int always = draws.index(dimensions_);
  for (int k = 0; k < dimensions_; ++k) {
    if (draws.uniform() >= setting.crossover && k != always) continue;
    const double v = x[k] + setting.scale * (leader[k] - x[k] + a[k] - b[k]);
    child.x[k] = v < 0 ? x[k] / 2 : v > 1 ? (x[k] + 1) / 2 : v;
  }
  return child;
}

std::optional<Point> Evolution::least_squares_child() const {
  if (!options_.parts || known_.empty()) return {};
  const int few = dimensions_ + 1;
  const int nearest = std::min(static_cast<int>(known_.size()), step_points * few);
  return least_squares_minimum(known_, around_leaders(known_, std::min(nearest, 2 * few)), nearest);
}

std::optional<Point> Evolution::quadratic_child() const {
  const int coefficients = quadratic_coefficients(dimensions_);
  if (static_cast<int>(known_.size()) < model_points * coefficients) return {};
  const auto model = fit_quadratic(known_, around_leaders(known_, coefficients), model_points * coefficients);
  if (!model) return {};
  return model->minimum;
}

// One child per parent; those of models take the places of the worst parents'.
std::vector<Child> Evolution::breed() const {
  const auto count = static_cast<int>(std::min<std::int64_t>(size(), left()));
  std::vector<Child> children;
  for (int i = 0; i < count; ++i) {
    if (i >= size() - 2) {
      const auto minimum = i == size() - 1 ? quadratic_child() : least_squares_child();
      if (minimum && !tried(*minimum, children)) {
        children.push_back({*minimum, {}, true});
        continue;
      }
    }
    Draws draws(rng_, generation_, i);
    Child child = differential_child(i, draws);
    for (int attempt = 0; attempt < redraws && tried(child.x, children); ++attempt) child = differential_child(i, draws);
    while (tried(child.x, children)) {
      for (double& coordinate : child.x) coordinate = draws.uniform();
    }
    children.push_back(std::move(child));
  }
  return children;
}

void Evolution::keep_replaced(Point parent, Draws& draws) {
  if (static_cast<int>(replaced_.size()) < size()) {
    replaced_.push_back(std::move(parent));
  } else {
    replaced_[draws.index(size())] = std::move(parent);
  }
}

// A child replaces its own parent if it is cheaper.
void Evolution::select(std::vector<Child> children) {
  std::vector<Point> points, parents;
  for (std::size_t i = 0; i < children.size(); ++i) {
    points.push_back(children[i].x);
    parents.push_back(population_[i].x);
  }
  const std::vector<double> costs = evaluate(points, parents);
  std::vector<Memory::Success> successes;
  Draws draws(rng_, generation_, options_.population);  // a candidate number that no child has
  for (std::size_t i = 0; i < children.size(); ++i) {
    Evaluated& parent = population_[i];
    if (!(costs[i] < parent.cost)) continue;
    if (std::isfinite(parent.cost)) {
      if (!children[i].modelled) successes.push_back({children[i].setting, parent.cost - costs[i]});
      keep_replaced(std::move(parent.x), draws);
    }
    parent = {std::move(children[i].x), costs[i]};
  }
  memory_.learn(successes);
}

bool Evolution::has_converged() const {
  return std::all_of(population_.begin(), population_.end(), [&](const Evaluated& e) { return same(e.x, population_.front().x); });
}

std::optional<Stop> Evolution::should_stop() {
  const int elite = std::min(size(), smallest());
  best_record_.update(best(), options_.gain, evaluations_);
  if (elite > 0) elite_record_.update(population_[elite - 1].cost, options_.gain, evaluations_);
  if (left() <= 0) return budget_ == options_.max_evaluations ? Stop::evaluations : Stop::generations;
  if (has_converged()) return Stop::converged;
  if (evaluations_ - std::max(best_record_.at, elite_record_.at) >= std::int64_t{options_.stall} * options_.population)
    return Stop::stalled;
  return {};
}

SearchResult Evolution::run(const std::vector<Evaluated>& start, const OnGeneration& on_generation) {
  std::optional<Stop> stop;
  while (!stop) {
    ++generation_;
    if (generation_ == 1) {
      found_population(start);
    } else {
      shrink();
      select(breed());
    }
    std::stable_sort(population_.begin(), population_.end(), cheaper);
    stop = should_stop();
    if (on_generation && !on_generation({generation_, evaluations_, best()})) stop = Stop::interrupted;
  }
  return std::move(*this).result(*stop);
}

SearchResult Evolution::result(Stop stop) && {
  SearchResult out;
  out.evaluations = evaluations_;
  out.generations = generation_;
  out.stop = stop;
  for (Evaluated& e : population_) {
    const auto is_same = [&](const Evaluated& other) { return same(other.x, e.x); };
    if (std::isfinite(e.cost) && std::none_of(out.best.begin(), out.best.end(), is_same)) out.best.push_back(std::move(e));
  }
  out.visited = std::move(visited_);
  return out;
}

void require(bool valid, const char* option, std::int64_t value, const char* expected) {
  if (!valid) throw InputError(std::string("search: ") + option + ' ' + std::to_string(value) + "; expected " + expected);
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

SearchResult differential_evolution(int dimensions, const BatchCost& cost, const EvolutionOptions& options, const Rng& rng,
                                    const std::vector<Evaluated>& start, const OnGeneration& on_generation) {
  require(dimensions >= 1, "dimensions", dimensions, "at least 1");
  require(options.population >= least_population, "population", options.population, "at least 4");
  require(options.generations >= 1, "generations", options.generations, "at least 1");
  require(options.stall >= 1, "stall", options.stall, "at least 1");
  require(options.max_evaluations >= 0, "max_evaluations", options.max_evaluations, "0 (none) or more");
  return Evolution(dimensions, cost, options, rng).run(start, on_generation);
}

}  // namespace swarmfit
