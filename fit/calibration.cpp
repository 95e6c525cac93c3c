// SPDX-License-Identifier: MIT
#include "fit/calibration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>

namespace swarmfit {
namespace {

constexpr int kLeaders = 5;             // candidates judged again on fresh seeds
constexpr double kLeadersApart = 0.02;  // in the unit cube: closer candidates are the same answer
constexpr int kLaterPassShare = 4;      // later passes start from the rescored archive, so they search and stall this many times sooner

bool near_any(const Point& x, const std::vector<Evaluated>& chosen, double apart) {
  return std::any_of(chosen.begin(), chosen.end(), [&](const Evaluated& e) { return (e.x - x).cwiseAbs().maxCoeff() < apart; });
}

struct Lexicographic {
  bool operator()(const Point& a, const Point& b) const { return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end()); }
};

}  // namespace

double cost_of(const Energies& raw, const Weighting& weighting) {
  const double value = score(Eigen::Map<const Eigen::VectorXd>(raw.data(), static_cast<Index>(raw.size())), weighting);
  return std::isfinite(value) ? -value : std::numeric_limits<double>::infinity();
}

ModelSearch::ModelSearch(std::size_t index, const ModelChoice& model, const Conditions& conditions, const Target& target,
                         const CompareOptions& options, std::vector<HistoryRow>& history)
    : index_(index),
      options_(options),
      space_(model, conditions.scales, options.requests),
      objective_(model, conditions, target),
      history_(history),
      rng_(Rng{options.seed}.derive(Stream::search, index)),
      seeds_(replicate_seeds({options.seed}, Stream::replicate, options.budget.replicates)),
      final_seeds_(replicate_seeds({options.seed}, Stream::final_seeds, options.budget.final_replicates)) {}

void ModelSearch::pass(int number, const Weighting& weighting, const OnGeneration& on_generation) {
  if (space_.dimensions() > 0) {
    search(number, weighting, on_generation);
  } else if (archive_.empty()) {
    keep(Point(), objective_.evaluate(space_.parameters(Point()), seeds_), number);
    stop_reason_ = "nothing to search";
  }
  select(number, weighting);
}

std::int64_t ModelSearch::left() const {
  return options_.max_evaluations > 0 ? std::max<std::int64_t>(0, options_.max_evaluations - evaluations())
                                      : std::numeric_limits<std::int64_t>::max();
}

std::vector<Evaluated> ModelSearch::rescored(const Weighting& weighting, std::size_t most, double apart) const {
  std::vector<Evaluated> all;
  for (const auto& a : archive_) all.push_back({a.x, cost_of(a.raw, weighting)});
  std::stable_sort(all.begin(), all.end(), [](const Evaluated& a, const Evaluated& b) { return a.cost < b.cost; });
  std::vector<Evaluated> chosen;
  for (const auto& candidate : all) {
    if (chosen.size() == most) break;
    if (chosen.empty() || !near_any(candidate.x, chosen, apart)) chosen.push_back(candidate);
  }
  return chosen;
}

void ModelSearch::record(const Point& x, const Outcome& outcome, int pass, const char* phase) {
  const auto values = space_.parameters(x);
  HistoryRow row{index_, pass, phase, {}, outcome.raw, outcome.failed};
  for (const auto p : space_.searched()) row.x.push_back(values[p]);
  history_.push_back(std::move(row));
  simulations_ += static_cast<std::int64_t>(outcome.replicates.size());
  failed_ += outcome.failed;
}

void ModelSearch::keep(const Point& x, const Outcome& outcome, int pass) {
  record(x, outcome, pass, "search");
  archive_.push_back({x, outcome.raw});
}

// Refinements run side by side and finish in any order; what was seen is kept in the order in which the search lists it.
void ModelSearch::search(int number, const Weighting& weighting, const OnGeneration& on_generation) {
  if (left() == 0) return;
  SearchOptions plan;
  const int share = number == 1 ? 1 : kLaterPassShare;
  plan.genetic.population = options_.budget.population;
  plan.genetic.generations = std::max(1, options_.budget.generations / share);
  plan.genetic.stall = std::max(1, plan.genetic.stall / share);
  plan.genetic.max_evaluations = options_.max_evaluations > 0 ? left() : 0;
  plan.refine.starts = options_.budget.refinements;
  const auto before = evaluations();
  std::mutex lock;
  std::map<Point, Outcome, Lexicographic> seen;
  const auto cost = [&](const std::vector<Point>& points) {
    std::vector<std::vector<double>> candidates;
    for (const auto& x : points) candidates.push_back(space_.parameters(x));
    auto outcomes = objective_.evaluate(candidates, seeds_);
    std::vector<double> costs;
    const std::lock_guard guard(lock);
    for (std::size_t k = 0; k < points.size(); ++k) {
      costs.push_back(cost_of(outcomes[k].raw, weighting));
      outcomes[k].distributions = {};  // large, and not needed again
      seen.insert_or_assign(points[k], std::move(outcomes[k]));
    }
    return costs;
  };
  const auto start = rescored(weighting, static_cast<std::size_t>(plan.genetic.population), 0.0);
  const Found found =
      swarmfit::search(space_.dimensions(), cost, plan, rng_.derive(Stream::search, static_cast<std::uint64_t>(number)), start,
                       [&](const GenerationReport& report) {
                         convergence_.push_back({number, before + report.evaluations, -report.best});
                         return !on_generation || on_generation({report.generation, before + report.evaluations, report.best});
                       });
  if (found.stop == Stop::interrupted) throw Interrupted{};
  for (const auto& e : found.visited) keep(e.x, seen.at(e.x), number);
  stop_reason_ = to_string(found.stop);
  recommended_ = found.recommended.x;
  convergence_.push_back({number, evaluations(), -rescored(weighting, 1, 0.0).front().cost});
}

void ModelSearch::select(int number, const Weighting& weighting) {
  auto leaders = rescored(weighting, kLeaders, kLeadersApart);
  if (recommended_.size() > 0 && !same(leaders.front().x, recommended_)) leaders.push_back({recommended_, 0});
  std::vector<std::vector<double>> candidates;
  for (const auto& leader : leaders) candidates.push_back(space_.parameters(leader.x));
  const auto outcomes = objective_.evaluate(candidates, final_seeds_);
  std::size_t best = 0;
  for (std::size_t k = 0; k < leaders.size(); ++k) {
    record(leaders[k].x, outcomes[k], number, "final");
    if (cost_of(outcomes[k].raw, weighting) < cost_of(outcomes[best].raw, weighting)) best = k;
  }
  selected_ = {leaders[best].x, outcomes[best]};
}

}  // namespace swarmfit
