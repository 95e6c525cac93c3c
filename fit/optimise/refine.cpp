// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <nlopt.hpp>
#include <thread>

#include "fit/optimise/differential_evolution.h"

namespace swarmfit {
namespace {

// What nlopt is told of a failure: it compares costs, and takes NaN for a cheap one and infinity for a reason to stop.
constexpr double failed_cost = 1e300;

// Simplexes ask for one point at a time, each in a thread of its own, and wait. When all who are still there have asked, all are answered
// as one batch, in the thread that serves.
class Questions {
 public:
  explicit Questions(std::size_t seats) : seats_(seats) {}

  // Throws nlopt::forced_stop when there will be no more answers.
  double ask(std::size_t seat, const Point& x) {
    std::unique_lock lock(lock_);
    seats_[seat] = {State::asking, x, 0};
    changed_.notify_all();
    changed_.wait(lock, [&] { return closed_ || seats_[seat].state == State::answered; });
    if (closed_) throw nlopt::forced_stop();
    seats_[seat].state = State::busy;
    return seats_[seat].answer;
  }

  void leave(std::size_t seat) {
    const std::lock_guard guard(lock_);
    seats_[seat].state = State::left;
    changed_.notify_all();
  }

  // Returns when all have left. What `cost` throws is thrown on, and nobody is answered any more.
  void serve(const BatchCost& cost) {
    while (true) {
      std::vector<std::size_t> asking;
      std::vector<Point> points;
      {
        std::unique_lock lock(lock_);
        changed_.wait(lock, [&] {
          return std::all_of(seats_.begin(), seats_.end(),
                             [](const Seat& s) { return s.state == State::asking || s.state == State::left; });
        });
        for (std::size_t k = 0; k < seats_.size(); ++k)
          if (seats_[k].state == State::asking) asking.push_back(k), points.push_back(seats_[k].question);
      }
      if (asking.empty()) return;
      std::vector<double> costs;
      try {
        costs = cost(points);
      } catch (...) {
        close();
        throw;
      }
      const std::lock_guard guard(lock_);
      for (std::size_t i = 0; i < asking.size(); ++i) {
        seats_[asking[i]].answer = costs[i];
        seats_[asking[i]].state = State::answered;
      }
      changed_.notify_all();
    }
  }

 private:
  enum class State { busy, asking, answered, left };
  struct Seat {
    State state = State::busy;
    Point question{};
    double answer = 0;
  };

  void close() {
    const std::lock_guard guard(lock_);
    closed_ = true;
    changed_.notify_all();
  }

  std::vector<Seat> seats_;
  std::mutex lock_;
  std::condition_variable changed_;
  bool closed_ = false;
};

struct Simplex {
  std::size_t seat;
  int limit;
  Evaluated best;
  Questions* questions = nullptr;
  std::vector<Evaluated> visited{};
  int evaluations = 0;
  bool converged = false;
};

double evaluate(const std::vector<double>& x, std::vector<double>&, void* data) {
  Simplex& simplex = *static_cast<Simplex*>(data);
  if (simplex.evaluations == simplex.limit) throw nlopt::forced_stop();
  const Point point = Eigen::Map<const Point>(x.data(), static_cast<Eigen::Index>(x.size())).cwiseMax(0.0).cwiseMin(1.0);
  ++simplex.evaluations;
  const double cost = simplex.questions->ask(simplex.seat, point);
  simplex.visited.push_back({point, std::isfinite(cost) ? cost : std::numeric_limits<double>::infinity()});
  if (!std::isfinite(cost)) return failed_cost;
  if (cost < simplex.best.cost) simplex.best = {point, cost};
  return cost;
}

void minimise(Simplex& simplex, const RefineOptions& options) {
  std::vector<double> x(simplex.best.x.begin(), simplex.best.x.end());
  nlopt::opt method(nlopt::LN_NELDERMEAD, static_cast<unsigned>(x.size()));
  method.set_min_objective(evaluate, &simplex);
  method.set_lower_bounds(0.0);
  method.set_upper_bounds(1.0);
  method.set_initial_step(options.step);
  method.set_xtol_abs(options.tolerance);
  try {
    double cost = 0;
    method.optimize(x, cost);
    simplex.converged = true;
  } catch (const nlopt::forced_stop&) {
  } catch (const nlopt::roundoff_limited&) {
    simplex.converged = true;
  }
}

std::vector<Simplex> minimised(const std::vector<Evaluated>& starts, std::size_t count, const BatchCost& cost,
                               const RefineOptions& options) {
  Questions questions(count);
  std::vector<Simplex> simplexes;
  for (std::size_t k = 0; k < count; ++k) simplexes.push_back({k, options.evaluations, starts[k], &questions});
  std::vector<std::exception_ptr> errors(count);
  {
    std::vector<std::jthread> at_work;  // joined at the end of this block, whatever happens
    for (Simplex& simplex : simplexes)
      at_work.emplace_back([&] {
        try {
          minimise(simplex, options);
        } catch (...) {
          errors[simplex.seat] = std::current_exception();
        }
        questions.leave(simplex.seat);
      });
    questions.serve(cost);
  }
  for (const auto& error : errors)
    if (error) std::rethrow_exception(error);
  return simplexes;
}

}  // namespace

SearchResult refine(const std::vector<Evaluated>& starts, const BatchCost& cost, const RefineOptions& options) {
  const int refined = options.evaluations > 0 ? std::clamp(options.starts, 0, static_cast<int>(starts.size())) : 0;
  const auto simplexes = minimised(starts, static_cast<std::size_t>(refined), cost, options);

  SearchResult result;
  result.stop = Stop::converged;
  std::vector<Evaluated> all;
  for (const Simplex& simplex : simplexes) {
    if (!simplex.converged) result.stop = Stop::evaluations;
    result.evaluations += simplex.evaluations;
    result.visited.insert(result.visited.end(), simplex.visited.begin(), simplex.visited.end());
    all.push_back(simplex.best);
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
