// SPDX-License-Identifier: MIT
#include "fit/calibration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <tuple>

namespace swarmfit {
namespace {

constexpr int kLeaders = 5;           // candidates judged again on fresh seeds
constexpr double kLeadersApart = 0.02;  // in the unit cube: closer candidates are the same answer
constexpr int kLaterPassShare = 4;    // later passes start from the rescored archive, so they search and stall this many times sooner

bool near_any(const Point& x, const std::vector<Evaluated>& chosen, double apart) {
  return std::any_of(chosen.begin(), chosen.end(), [&](const Evaluated& e) { return (e.x - x).cwiseAbs().maxCoeff() < apart; });
}

bool lexicographic(const Point& a, const Point& b) { return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end()); }

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
    polish(number, weighting);
  } else if (archive_.empty()) {
    costs({Point()}, weighting, number, "genetic");
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

std::vector<double> ModelSearch::costs(const std::vector<Point>& points, const Weighting& weighting, int pass, const char* phase) {
  std::vector<std::vector<double>> candidates;
  for (const auto& x : points) candidates.push_back(space_.parameters(x));
  const auto outcomes = objective_.evaluate(candidates, seeds_);
  std::vector<double> out;
  for (std::size_t k = 0; k < points.size(); ++k) {
    record(points[k], outcomes[k], pass, phase);
    archive_.push_back({points[k], outcomes[k].raw});
    out.push_back(cost_of(outcomes[k].raw, weighting));
  }
  return out;
}

void ModelSearch::search(int number, const Weighting& weighting, const OnGeneration& on_generation) {
  if (left() == 0) return;
  GeneticOptions genetic;
  genetic.population = options_.budget.population;
  const int share = number == 1 ? 1 : kLaterPassShare;
  genetic.generations = std::max(1, options_.budget.generations / share);
  genetic.stall = std::max(1, genetic.stall / share);
  genetic.max_evaluations = options_.max_evaluations > 0 ? left() : 0;
  const auto start = rescored(weighting, static_cast<std::size_t>(genetic.population), 0.0);
  const auto before = evaluations();
  const auto result = genetic_search(
      space_.dimensions(), [&](const std::vector<Point>& x) { return costs(x, weighting, number, "genetic"); }, genetic,
      rng_.derive(Stream::search, static_cast<std::uint64_t>(number)), start, [&](const GenerationReport& report) {
        convergence_.push_back({number, before + report.evaluations, -report.best});
        return !on_generation || on_generation({report.generation, before + report.evaluations, report.best});
      });
  if (result.stop == Stop::interrupted) throw Interrupted{};
  stop_reason_ = to_string(result.stop);
}

// Starts run in parallel and finish in any order, so what they saw is put in an order of its own before it is kept.
void ModelSearch::polish(int number, const Weighting& weighting) {
  RefineOptions refinement;
  refinement.starts = options_.budget.refinements;
  refinement.evaluations = options_.budget.refine_evaluations / (number == 1 ? 1 : 2);
  if (options_.max_evaluations > 0 && refinement.starts > 0)
    refinement.evaluations = static_cast<int>(std::min<std::int64_t>(refinement.evaluations, left() / refinement.starts));
  if (refinement.starts == 0 || refinement.evaluations == 0) return;
  std::mutex lock;
  std::vector<std::pair<Point, Outcome>> seen;
  refine(
      rescored(weighting, static_cast<std::size_t>(refinement.starts), kLeadersApart),
      [&](const Point& x) {
        Outcome outcome = objective_.evaluate(space_.parameters(x), seeds_);
        const double cost = cost_of(outcome.raw, weighting);
        outcome.distributions = {};
        const std::lock_guard guard(lock);
        seen.emplace_back(x, std::move(outcome));
        return cost;
      },
      refinement);
  std::sort(seen.begin(), seen.end(), [](const auto& a, const auto& b) { return lexicographic(a.first, b.first); });
  for (auto& [x, outcome] : seen) {
    record(x, outcome, number, "refine");
    archive_.push_back({x, outcome.raw});
  }
  if (!seen.empty()) convergence_.push_back({number, evaluations(), -rescored(weighting, 1, 0.0).front().cost});
}

void ModelSearch::select(int number, const Weighting& weighting) {
  const auto leaders = rescored(weighting, kLeaders, kLeadersApart);
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
