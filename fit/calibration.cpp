// SPDX-License-Identifier: MIT
#include "fit/calibration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>

#include "fit/screening.h"

namespace swarmfit {
namespace {

constexpr double kLeadersApart = 0.1;     // in the unit cube: far enough that they do not share their luck
constexpr double kFinalistsApart = 0.02;  // near ones are all but the same model
constexpr std::size_t kFinalists = 12;

// Later passes start from what is known, rescored, so they search so many times less. Least of all the whole space on few replicates:
// there all that is left to find is luck.
int share(Stream round, int pass) { return pass == 1 ? 1 : round == Stream::replicate ? 12 : 4; }

int generations(const SearchSize& size, Stream round, int pass) { return std::max(1, size.generations / share(round, pass)); }

std::int64_t candidates(const SearchSize& size, Stream round, int pass) {
  return std::int64_t{size.population} * generations(size, round, pass);
}

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
      search_(on_seeds(options, Stream::replicate, options.budget.search.replicates)),
      selection_(on_seeds(options, Stream::selection, options.budget.selection.replicates)),
      confirmation_(on_seeds(options, Stream::confirmation, options.budget.confirmation_replicates)),
      final_seeds_(replicate_seeds({options.seed}, Stream::final_seeds, options.budget.final_replicates)) {}

ModelSearch::Round ModelSearch::on_seeds(const CompareOptions& options, Stream stream, int replicates) {
  return {stream, replicate_seeds({options.seed}, stream, replicates), {}, {}};
}

void ModelSearch::pass(int number, const Weighting& weighting, const OnSearch& on_search) {
  if (space_.dimensions() > 0) {
    if (number == 1) {  // the table's defaults are in the recording's scales: the one candidate that is not a guess
      keep(search_, space_.start(), simulate(search_, {space_.start()}).front(), number, "search");
      ++evaluations_;
    }
    const auto &wide = options_.budget.search, &narrow = options_.budget.selection;
    const auto before = evaluations_;
    const Found found = explore(search_, wide, number, "search", weighting, [&](const GenerationReport& report) {
      convergence_.push_back({number, before + report.evaluations, -report.best});
      return on_search(report.evaluations * wide.replicates, -report.best);
    });
    stop_reason_ = to_string(found.stop);
    convergence_.push_back({number, evaluations_, -leaders(search_, weighting, 1, 0.0).front().cost});
    promote(search_, selection_, static_cast<std::size_t>(narrow.population), kLeadersApart, number, "select", weighting);
    const auto searched = candidates(wide, search_.stream, number) * wide.replicates;
    explore(selection_, narrow, number, "refine", weighting,
            [&](const GenerationReport& report) { return on_search(searched + report.evaluations * narrow.replicates, -report.best); });
    promote(selection_, confirmation_, kFinalists, kFinalistsApart, number, "confirm", weighting);
  } else if (confirmation_.archive.empty()) {
    keep(confirmation_, Point(), objective_.evaluate(space_.parameters(Point()), confirmation_.seeds), number, "confirm");
    evaluations_ = 1;
    stop_reason_ = "nothing to search";
  }
  conclude(number, weighting);
}

std::int64_t ModelSearch::planned(int number) const {
  const auto& budget = options_.budget;
  return candidates(budget.search, search_.stream, number) * budget.search.replicates +
         candidates(budget.selection, selection_.stream, number) * budget.selection.replicates;
}

std::vector<Evaluated> ModelSearch::leaders(const Round& round, const Weighting& weighting, std::size_t most, double apart,
                                            Energies Archived::*by) {
  std::vector<Evaluated> all;
  for (const auto& a : round.archive) all.push_back({a.x, cost_of(a.*by, weighting)});
  std::stable_sort(all.begin(), all.end(), [](const Evaluated& a, const Evaluated& b) { return a.cost < b.cost; });
  std::vector<Evaluated> chosen;
  for (const auto& candidate : all) {
    if (chosen.size() == most) break;
    if (chosen.empty() || !near_any(candidate.x, chosen, apart)) chosen.push_back(candidate);
  }
  return chosen;
}

std::vector<Outcome> ModelSearch::simulate(const Round& round, const std::vector<Point>& points, const Objective::Worth& worth) const {
  std::vector<std::vector<double>> candidates;
  for (const auto& x : points) candidates.push_back(space_.parameters(x));
  const auto all = [](const std::vector<Outcome>& first) { return std::vector<bool>(first.size(), true); };
  return objective_.race(candidates, round.seeds, screening_replicates(round.seeds.size()), worth ? worth : all);
}

void ModelSearch::keep(Round& round, const Point& x, const Outcome& outcome, int pass, const char* phase) {
  const auto values = space_.parameters(x);
  const auto replicates = static_cast<int>(outcome.replicates.size());
  HistoryRow row{index_, pass, phase, {}, outcome.raw, replicates, outcome.failed};
  for (const auto p : space_.searched()) row.x.push_back(values[p]);
  history_.push_back(std::move(row));
  if (outcome.replicates.size() == round.seeds.size()) round.archive.push_back({x, outcome.raw, outcome.guided, outcome.first});
  simulations_ += replicates;
  failed_ += outcome.failed;
}

// Refinements run side by side and finish in any order; what was seen is kept in the order in which the search lists it.
Found ModelSearch::explore(Round& round, const SearchSize& size, int pass, const char* phase, const Weighting& weighting,
                           const OnGeneration& on_generation) {
  SearchOptions plan;
  plan.genetic.population = size.population;
  plan.genetic.generations = generations(size, round.stream, pass);
  plan.genetic.stall = std::max(1, plan.genetic.stall / share(round.stream, pass));
  if (options_.max_evaluations > 0) {
    plan.genetic.max_evaluations = options_.max_evaluations - evaluations_;
    if (plan.genetic.max_evaluations <= 0) return {{{}, {}, 0, 0, Stop::evaluations}, {}, 0};
  }
  std::mutex lock;
  std::map<Point, Outcome, Lexicographic> seen;
  const auto remember = [&](const std::vector<Point>& points, std::vector<Outcome>& outcomes) {
    std::vector<double> costs;
    const std::lock_guard guard(lock);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const bool given_up = outcomes[k].replicates.size() < round.seeds.size();
      costs.push_back(given_up ? std::numeric_limits<double>::infinity() : cost_of(outcomes[k].guided, weighting));
      outcomes[k].distributions = {};  // large, and not needed again
      seen.insert_or_assign(points[k], std::move(outcomes[k]));
    }
    return costs;
  };
  const auto cost = [&](const std::vector<Point>& points) {
    auto outcomes = simulate(round, points);
    return remember(points, outcomes);
  };
  // Costs after the first replicates and after all.
  struct Known {
    double first, all;
  };
  std::map<Point, Known, Lexicographic> archived;
  for (const auto& a : round.archive) archived.insert_or_assign(a.x, Known{cost_of(a.first, weighting), cost_of(a.guided, weighting)});
  const auto known = [&](const Point& x) {
    const auto old = archived.find(x);
    return old != archived.end() ? old->second : Known{cost_of(seen.at(x).first, weighting), cost_of(seen.at(x).guided, weighting)};
  };
  Screening screening;
  plan.genetic.race = [&](const std::vector<Point>& children, const std::vector<Point>& parents) {
    std::vector<Known> rivals;
    for (const Point& x : parents) rivals.push_back(known(x));
    auto outcomes = simulate(round, children, [&](const std::vector<Outcome>& first) {
      std::vector<bool> worth;
      for (std::size_t k = 0; k < first.size(); ++k) worth.push_back(screening.worth(cost_of(first[k].first, weighting) - rivals[k].first));
      return worth;
    });
    for (std::size_t k = 0; k < children.size(); ++k)
      if (outcomes[k].replicates.size() == round.seeds.size())
        screening.learn(cost_of(outcomes[k].first, weighting) - rivals[k].first, cost_of(outcomes[k].guided, weighting) - rivals[k].all);
    return remember(children, outcomes);
  };
  const auto start = leaders(round, weighting, round.archive.size(), 0.0);
  Found found =
      swarmfit::search(space_.dimensions(), cost, plan, rng_.derive(round.stream, static_cast<std::uint64_t>(pass)), start, on_generation);
  if (found.stop == Stop::interrupted) throw Interrupted{};
  for (const auto& e : found.visited) keep(round, e.x, seen.at(e.x), pass, phase);
  evaluations_ += found.evaluations;
  round.recommended = found.recommended.x;
  return found;
}

// The best on some seeds are partly lucky with them: they are simulated again on those of the next round.
void ModelSearch::promote(const Round& from, Round& to, std::size_t most, double apart, int pass, const char* phase,
                          const Weighting& weighting) {
  auto chosen = leaders(from, weighting, most, apart);
  if (from.recommended.size() > 0) chosen.push_back({from.recommended, 0});
  std::erase_if(chosen, [&](const Evaluated& e) {
    return std::any_of(to.archive.begin(), to.archive.end(), [&](const Archived& a) { return same(a.x, e.x); });
  });
  std::vector<Point> points;
  for (const auto& leader : chosen) points.push_back(leader.x);
  const auto outcomes = simulate(to, points);
  for (std::size_t k = 0; k < chosen.size(); ++k) keep(to, chosen[k].x, outcomes[k], pass, phase);
}

void ModelSearch::conclude(int number, const Weighting& weighting) {
  const Point best = leaders(confirmation_, weighting, 1, 0.0, &Archived::raw).front().x;
  if (!selected_.outcome.replicates.empty() && (best.size() == 0 || same(best, selected_.x))) return;
  Round report = {Stream::final_seeds, final_seeds_, {}, {}};
  selected_ = {best, objective_.evaluate(space_.parameters(best), final_seeds_)};
  keep(report, best, selected_.outcome, number, "final");
}

}  // namespace swarmfit
