// SPDX-License-Identifier: MIT
#include "fit/calibration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>

namespace swarmfit {
namespace {

constexpr int kLeaders = 24;           // candidates judged again on fresh seeds
constexpr double kLeadersApart = 0.1;  // in the unit cube: far enough that they do not share their luck
constexpr int kLaterPassShare = 4;     // later passes start from the rescored archive, so they search and stall this many times sooner

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
      selection_seeds_(replicate_seeds({options.seed}, Stream::selection, options.budget.selection_replicates)),
      final_seeds_(replicate_seeds({options.seed}, Stream::final_seeds, options.budget.final_replicates)) {}

void ModelSearch::pass(int number, const Weighting& weighting, const OnGeneration& on_generation) {
  if (space_.dimensions() > 0) {
    search(number, weighting, on_generation);
  } else if (archive_.empty()) {
    keep(Point(), objective_.evaluate(space_.parameters(Point()), seeds_), number);
    stop_reason_ = "nothing to search";
  }
  judge(number, weighting);
  if (space_.dimensions() > 0) polish(number, weighting);
  conclude(number, weighting);
}

std::int64_t ModelSearch::planned(int number) const {
  const int generations = std::max(1, options_.budget.generations / (number == 1 ? 1 : kLaterPassShare));
  return std::int64_t{options_.budget.population} * generations;
}

std::int64_t ModelSearch::left() const {
  return options_.max_evaluations > 0 ? std::max<std::int64_t>(0, options_.max_evaluations - evaluations())
                                      : std::numeric_limits<std::int64_t>::max();
}

std::vector<Evaluated> ModelSearch::rescored(const std::vector<Archived>& archive, const Weighting& weighting, std::size_t most,
                                             double apart) {
  std::vector<Evaluated> all;
  for (const auto& a : archive) all.push_back({a.x, cost_of(a.raw, weighting)});
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
  ++evaluations_;
}

// Refinements run side by side and finish in any order; what was seen is kept in the order in which the search lists it.
void ModelSearch::search(int number, const Weighting& weighting, const OnGeneration& on_generation) {
  if (left() == 0) return;
  SearchOptions plan;
  plan.genetic.population = options_.budget.population;
  plan.genetic.generations = static_cast<int>(planned(number)) / options_.budget.population;
  plan.genetic.stall = std::max(1, plan.genetic.stall / (number == 1 ? 1 : kLaterPassShare));
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
  const auto start = rescored(archive_, weighting, static_cast<std::size_t>(plan.genetic.population), 0.0);
  const Found found = swarmfit::search(space_.dimensions(), cost, plan, rng_.derive(Stream::search, static_cast<std::uint64_t>(number)),
                                       start, [&](const GenerationReport& report) {
                                         convergence_.push_back({number, before + report.evaluations, -report.best});
                                         return !on_generation || on_generation(report);
                                       });
  if (found.stop == Stop::interrupted) throw Interrupted{};
  for (const auto& e : found.visited) keep(e.x, seen.at(e.x), number);
  stop_reason_ = to_string(found.stop);
  recommended_ = found.recommended.x;
  convergence_.push_back({number, evaluations(), -rescored(archive_, weighting, 1, 0.0).front().cost});
}

// The best of a search are partly lucky with its few seeds: the leaders are simulated again on more, and fresh, ones.
void ModelSearch::judge(int number, const Weighting& weighting) {
  auto leaders = rescored(archive_, weighting, kLeaders, kLeadersApart);
  if (recommended_.size() > 0) leaders.push_back({recommended_, 0});
  std::erase_if(leaders, [this](const Evaluated& e) {
    return std::any_of(judged_.begin(), judged_.end(), [&](const Archived& a) { return a.x.size() == 0 || same(a.x, e.x); });
  });
  std::vector<std::vector<double>> candidates;
  for (const auto& leader : leaders) candidates.push_back(space_.parameters(leader.x));
  const auto outcomes = objective_.evaluate(candidates, selection_seeds_);
  for (std::size_t k = 0; k < leaders.size(); ++k) {
    record(leaders[k].x, outcomes[k], number, "select");
    judged_.push_back({leaders[k].x, outcomes[k].raw});
  }
}

// Nelder-Mead from the best few of the judged, on the same seeds. Starts run side by side and finish in any order; what they saw is kept in
// an order of its own.
void ModelSearch::polish(int number, const Weighting& weighting) {
  RefineOptions plan;
  plan.starts = options_.budget.refinements;
  plan.evaluations = options_.budget.refine_evaluations / (number == 1 ? 1 : 2);
  plan.evaluations = static_cast<int>(std::min<std::int64_t>(plan.evaluations, left() / plan.starts));
  if (plan.evaluations == 0) return;
  std::mutex lock;
  std::map<Point, Outcome, Lexicographic> seen;
  refine(
      rescored(judged_, weighting, static_cast<std::size_t>(plan.starts), kLeadersApart),
      [&](const Point& x) {
        Outcome outcome = objective_.evaluate(space_.parameters(x), selection_seeds_);
        const double cost = cost_of(outcome.raw, weighting);
        outcome.distributions = {};
        const std::lock_guard guard(lock);
        seen.insert_or_assign(x, std::move(outcome));
        return cost;
      },
      plan);
  for (const auto& [x, outcome] : seen) {
    record(x, outcome, number, "refine");
    judged_.push_back({x, outcome.raw});
    ++evaluations_;
  }
}

// The winner has been chosen by its energies on the selection's seeds, so what is reported comes from seeds that had no part in that.
void ModelSearch::conclude(int number, const Weighting& weighting) {
  const Point best = rescored(judged_, weighting, 1, 0.0).front().x;
  if (!selected_.outcome.replicates.empty() && (best.size() == 0 || same(best, selected_.x))) return;
  selected_ = {best, objective_.evaluate(space_.parameters(best), final_seeds_)};
  record(best, selected_.outcome, number, "final");
}

}  // namespace swarmfit
