// SPDX-License-Identifier: MIT
#include "fit/model_fit/model_search.h"

#include <algorithm>
#include <cmath>

namespace swarmfit {
namespace {

constexpr double kLeadersApart = 0.1;     // in the unit cube: far enough that they do not share their luck
constexpr double kFinalistsApart = 0.02;  // near ones are all but the same model
constexpr std::size_t kFinalists = 12;
constexpr int kBeginnings = 3;       // of the first search of the whole space
constexpr std::size_t kSettled = 2;  // leaders at which the time step is chosen

// Later passes start from what is known, rescored, so they search so many times less. Least of all the whole space on few replicates:
// there all that is left to find is luck.
int share(Stream round, int pass) { return pass == 1 ? 1 : round == Stream::replicate ? 12 : 4; }

int generations(const SearchSize& size, Stream round, int pass) { return std::max(1, size.generations / share(round, pass)); }

std::int64_t candidates(const SearchSize& size, Stream round, int pass) {
  return std::int64_t{size.population} * generations(size, round, pass);
}

struct FinalRun {
  ScoredRun scored;
  std::string view;
};
auto fields(FinalRun& r) { return std::tie(r.scored, r.view); }

bool near_any(const Point& x, const std::vector<Evaluated>& chosen, double apart) {
  return std::any_of(chosen.begin(), chosen.end(), [&](const Evaluated& e) { return (e.x - x).cwiseAbs().maxCoeff() < apart; });
}

}  // namespace

ModelSearch::ModelSearch(std::size_t index, const ModelChoice& model, const Conditions& conditions, const Target& target,
                         const SearchPlan& plan, std::vector<HistoryRow>& history, const Runtime& runtime, FinalView view)
    : index_(index),
      target_(target),
      plan_(plan),
      space_(model, conditions.scales, plan.requests),
      objective_(model, conditions, target, runtime),
      history_(history),
      view_(std::move(view)),
      rng_(Rng{plan.seed}.derive(Stream::search, index)),
      search_(on_seeds(plan, Stream::replicate, plan.budget.search.replicates)),
      selection_(on_seeds(plan, Stream::selection, plan.budget.selection.replicates)),
      confirmation_(on_seeds(plan, Stream::confirmation, plan.budget.confirmation_replicates)),
      final_seeds_(replicate_seeds({plan.seed}, Stream::final_seeds, plan.budget.final_replicates)) {}

Round ModelSearch::on_seeds(const SearchPlan& plan, Stream stream, int replicates) {
  return {stream, replicate_seeds({plan.seed}, stream, replicates), {}, {}};
}

void ModelSearch::pass(int number, const Weighting& weighting, const OnSearch& on_search) {
  if (space_.dimensions() > 0) {
    if (number == 1) {
      // The table's defaults are in the recording's scales: the one candidate that is not a guess.
      try_out({space_.start()}, search_, "search");
      ++evaluations_;
      // To find the valleys, rough steps will do; how rough they may be, far from the recording, says little of those it takes near it.
      settle(search_, plan_.budget.search.population, weighting, objective_.ensemble().stable_steps(), kFarSteps);
    }
    const auto &wide = plan_.budget.search, &narrow = plan_.budget.selection;
    const auto before = evaluations_;
    const Found found = explore(search_, wide, number, "search", weighting, [&](const GenerationReport& report) {
      convergence_.push_back({number, before + report.evaluations, -report.best});
      on_search(report.evaluations * wide.replicates, -report.best);
    });
    stop_reason_ = to_string(found.stop);
    if (number == 1) settle(search_, wide.population, weighting, objective_.ensemble().stable_steps());
    convergence_.push_back({number, evaluations_, -leaders(search_, weighting, 1, 0.0).front().cost});
    promote(search_, selection_, static_cast<std::size_t>(narrow.population), kLeadersApart, number, "select", weighting);
    search_.suggested.clear();
    const std::int64_t done = candidates(wide, search_.stream, number) * wide.replicates;  // simulations of the round before
    const auto refine = [&](const SearchSize& size) {
      explore(selection_, size, number, "refine", weighting,
              [&](const GenerationReport& report) { on_search(done + report.evaluations * narrow.replicates, -report.best); });
    };
    refine(narrow);
    // The nearer to the recording, the smaller the differences that count: finer steps may be needed at the end, and then a little more.
    const SearchSize again{narrow.population, std::max(1, narrow.generations / share(selection_.stream, 2)), narrow.replicates};
    while (number == 1 && settle(selection_, narrow.population, weighting, objective_.ensemble().steps())) refine(again);
    promote(selection_, confirmation_, kFinalists, kFinalistsApart, number, "confirm", weighting);
  } else if (confirmation_.archive.empty()) {
    if (chooses_steps())
      settle_steps(objective_, target_, {space_.parameters(Point())}, step_seeds(), objective_.ensemble().stable_steps());
    keep(confirmation_, Point(), objective_.energies(space_.parameters(Point()), confirmation_.seeds), number, "confirm");
    evaluations_ = 1;
    stop_reason_ = "nothing to search";
  }
  conclude(number, weighting);
}

void ModelSearch::try_out(const std::vector<Point>& points, Round& round, const char* phase) {
  const auto outcomes = simulate(round, points, space_, objective_);
  for (std::size_t k = 0; k < points.size(); ++k) keep(round, points[k], outcomes[k], 1, phase);
}

bool ModelSearch::chooses_steps() const { return plan_.conditions.steps == 0 && !space_.model().spec->is_map(space_.model().options); }

StepSeeds ModelSearch::step_seeds() const { return {selection_.seeds, confirmation_.seeds}; }

// Chooses the time step where the recording is, as far as is known. If it is another now, the best `most` are simulated again, and the rest
// of what was simulated in other steps is forgotten; candidates count once.
bool ModelSearch::settle(Round& round, int most, const Weighting& weighting, int first, int finest) {
  if (!chooses_steps()) return false;
  const int before = objective_.ensemble().steps();
  std::vector<std::vector<double>> candidates;
  for (const auto& leader : leaders(round, weighting, kSettled, kFinalistsApart)) candidates.push_back(space_.parameters(leader.x));
  settle_steps(objective_, target_, candidates, step_seeds(), first, finest);
  if (objective_.ensemble().steps() == before) return false;
  std::vector<Point> points;
  for (const auto& leader : leaders(round, weighting, static_cast<std::size_t>(most), 0.0)) points.push_back(leader.x);
  round.archive.clear();
  try_out(points, round, "steps");
  return true;
}

void ModelSearch::suggest(const ModelSearch& other) {
  if (space_.dimensions() == 0) return;
  for (const Point& rest : {selected_.x, Point(Point::Zero(space_.dimensions()))})
    search_.suggested.push_back(space_.adopt(rest, other.space_, other.selected_.x));
}

std::int64_t ModelSearch::planned(int number) const {
  const auto& budget = plan_.budget;
  return candidates(budget.search, search_.stream, number) * budget.search.replicates +
         candidates(budget.selection, selection_.stream, number) * budget.selection.replicates;
}

std::vector<Evaluated> ModelSearch::leaders(const Round& round, const Weighting& weighting, std::size_t most, double apart,
                                            Energies Archived::*by) {
  std::vector<Evaluated> all;
  for (const auto& a : round.archive) all.push_back({a.x, cost_of(a.*by, weighting), parts_of(a.differences, weighting)});
  std::stable_sort(all.begin(), all.end(), [](const Evaluated& a, const Evaluated& b) { return a.cost < b.cost; });
  std::vector<Evaluated> chosen;
  for (const auto& candidate : all) {
    if (chosen.size() == most) break;
    if (chosen.empty() || !near_any(candidate.x, chosen, apart)) chosen.push_back(candidate);
  }
  return chosen;
}

void ModelSearch::keep(Round& round, const Point& x, const Outcome& outcome, int pass, const char* phase) {
  const auto values = space_.parameters(x);
  const auto replicates = static_cast<int>(outcome.replicates.size());
  HistoryRow row{index_, pass, phase, {}, outcome.raw, replicates, outcome.failed};
  for (const auto p : space_.searched()) row.x.push_back(values[p]);
  history_.push_back(std::move(row));
  if (round.complete(outcome)) round.archive.push_back({x, outcome.raw, outcome.guided, outcome.first, outcome.differences});
  simulations_ += replicates;
  failed_ += outcome.failed;
}

// Refinements run side by side and finish in any order; what was seen is kept in the order in which the search lists it.
Found ModelSearch::explore(Round& round, const SearchSize& size, int pass, const char* phase, const Weighting& weighting,
                           const std::function<void(const GenerationReport&)>& report) {
  SearchOptions options;
  options.evolution.population = size.population;
  options.evolution_only = plan_.evolution_only;
  if (pass == 1 && round.stream == Stream::replicate && !plan_.evolution_only) options.beginnings = kBeginnings;
  options.evolution.generations = generations(size, round.stream, pass);
  options.evolution.stall = std::max(1, options.evolution.stall / share(round.stream, pass));
  if (plan_.max_evaluations > 0) {
    options.evolution.max_evaluations = plan_.max_evaluations - evaluations_;
    if (options.evolution.max_evaluations <= 0) return {{{}, {}, 0, 0, Stop::evaluations}, {}, 0};
  }
  Race race(round, space_, objective_, weighting);
  const auto cost = [&](const std::vector<Point>& points) { return race.cost(points); };
  if (!plan_.evolution_only) options.evolution.parts = [&](const Point& x) { return parts_of(race.seen(x).differences, weighting); };
  options.evolution.race = [&](const auto& children, const auto& parents) { return race.against(children, parents); };
  const auto start = leaders(round, weighting, round.archive.size(), 0.0);
  Found found = swarmfit::search(space_.dimensions(), cost, options, rng_.derive(round.stream, static_cast<std::uint64_t>(pass)), start,
                                 [&](const GenerationReport& now) { return report(now), true; });
  for (const auto& e : found.visited) keep(round, e.x, race.seen(e.x), pass, phase);
  evaluations_ += found.evaluations;
  round.recommended = found.recommended.x;
  return found;
}

// The best on some seeds are partly lucky with them: they are simulated again on those of the next round.
void ModelSearch::promote(const Round& from, Round& to, std::size_t most, double apart, int pass, const char* phase,
                          const Weighting& weighting) {
  std::vector<Point> points;
  const auto add = [&](const Point& x) {
    const auto known = [&](const Archived& a) { return same(a.x, x); };
    const auto chosen = [&](const Point& other) { return same(other, x); };
    if (std::none_of(to.archive.begin(), to.archive.end(), known) && std::none_of(points.begin(), points.end(), chosen))
      points.push_back(x);
  };
  for (const auto& leader : leaders(from, weighting, most, apart)) add(leader.x);
  if (from.recommended.size() > 0) add(from.recommended);
  for (const Point& x : from.suggested) add(x);
  const auto outcomes = simulate(to, points, space_, objective_);
  for (std::size_t k = 0; k < points.size(); ++k) keep(to, points[k], outcomes[k], pass, phase);
}

Selected ModelSearch::on_final_seeds(const Point& x) const {
  const auto jobs = jobs_on(space_.parameters(x), final_seeds_);
  auto runs = objective_.ensemble().measured<FinalRun>(jobs, "final", [&](const Run& run, std::size_t k) {
    return FinalRun{objective_.scored(run), view_ ? view_(run, k) : ""};
  });
  Selected out{x, {}, {}};
  std::vector<ScoredRun> scored;
  for (FinalRun& run : runs) {
    scored.push_back(std::move(run.scored));
    out.views.push_back(std::move(run.view));
  }
  out.outcome = objective_.outcome(scored);
  return out;
}

void ModelSearch::conclude(int number, const Weighting& weighting) {
  const Point best = leaders(confirmation_, weighting, 1, 0.0, &Archived::raw).front().x;
  if (selected_.outcome.replicates.empty() || (best.size() > 0 && !same(best, selected_.x))) {
    selected_ = on_final_seeds(best);
    Round report = {Stream::final_seeds, final_seeds_, {}, {}};
    keep(report, best, selected_.outcome, number, "final");
  }
  selections_.push_back(selected_.outcome.raw);
}

}  // namespace swarmfit
