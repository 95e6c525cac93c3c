// SPDX-License-Identifier: MIT
#include "fit/experiment/objective.h"

#include <cmath>

#include "fit/experiment/journal.h"
#include "libeval/energy_score.h"
#include "libtrack/nan.h"

namespace swarmfit {
namespace {

// Energies of distributions that do not overlap are all the worst; this share of it per unit of Target::misplacement shows a search the
// way, and is small beside the differences that remain once they do overlap (docs/search.md).
constexpr double kGuide = 0.02;

void add(Counters& sum, const Counters& part) {
  sum.agent_steps += part.agent_steps;
  sum.infeasible_avoidance += part.infeasible_avoidance;
  sum.enforced += part.enforced;
  sum.halved_steps += part.halved_steps;
}

void append(MetricSamples& all, const MetricSamples& part) {
  for (std::size_t m = 0; m < all.values.size(); ++m)
    all.values[m].insert(all.values[m].end(), part.values[m].begin(), part.values[m].end());
}

}  // namespace

Objective::Objective(const ModelChoice& model, const Conditions& conditions, const Target& target, const Runtime& runtime)
    : target_(target), ensemble_(model, conditions, runtime) {}

SingleRun Objective::single(const Run& run) const {
  SingleRun out;
  if (!run.blew_up) out.distributions = target_.distributions(metric_samples(run.seen, ensemble_.conditions().metrics));
  out.failed = run.blew_up;
  return out;
}

ScoredRun Objective::scored(const Run& run) const {
  const std::size_t columns = target_.columns().size();
  ScoredRun out;
  out.raw = Energies(columns);
  out.count = run.count;
  out.failed = run.blew_up;
  if (!run.blew_up) {
    out.samples = metric_samples(run.seen, ensemble_.conditions().metrics);
    out.distributions = target_.distributions(out.samples);
    out.raw = target_.energies(out.distributions);
    if (target_.binning().normalisation != Normalisation::separate) out.samples = {};
  }
  for (std::size_t m = 0; m < columns; ++m)
    if (target_.defined(m) && (run.blew_up || std::isnan(out.raw[m]))) out.raw[m] = target_.worst();
  return out;
}

// The energy score of the runs that ended well; their replicates become its parts.
Energies Objective::energy_scores(std::span<const ScoredRun> scored, std::vector<Energies>& replicates) const {
  std::vector<Densities> runs;
  std::vector<Energies> away;
  for (const ScoredRun& run : scored) {
    if (run.failed) continue;
    runs.push_back(target_.densities(run.distributions));
    away.push_back(run.raw);
  }
  EnergyScore score = energy_score(std::move(away), spread(runs, target_.worst()));
  for (std::size_t r = 0, k = 0; r < scored.size(); ++r)
    if (!scored[r].failed) replicates[r] = std::move(score.runs[k++]);
  return score.value;
}

Outcome Objective::outcome(std::span<const ScoredRun> scored) const {
  const std::size_t columns = target_.columns().size();
  Outcome out;
  out.raw = out.guided = Energies(columns);
  out.distributions = PerColumn<Distribution>(columns);
  MetricSamples samples(target_.columns());
  for (const ScoredRun& run : scored) {
    out.replicates.push_back(run.raw);
    out.failed += run.failed;
    add(out.count, run.count);
    if (run.failed) continue;
    if (target_.binning().normalisation == Normalisation::separate) append(samples, run.samples);
    for (std::size_t m = 0; m < columns; ++m) {
      out.distributions[m].histogram.add(run.distributions[m].histogram);
      out.distributions[m].moments.add(run.distributions[m].moments);
    }
  }
  if (target_.binning().normalisation == Normalisation::separate) out.distributions = target_.distributions(samples);
  const double failed = static_cast<double>(out.failed) / static_cast<double>(scored.size());
  const auto off = target_.misplacement(out.distributions);
  if (out.failed == 0) out.differences = target_.differences(out.distributions);
  Energies good;
  if (failed < 1) good = target_.binning().pooled ? target_.energies(out.distributions) : energy_scores(scored, out.replicates);
  for (std::size_t m = 0; m < columns; ++m) {
    const double energy = failed < 1 && std::isfinite(good[m]) ? good[m] : target_.worst();
    out.raw[m] = target_.defined(m) ? (1 - failed) * energy + failed * target_.worst() : kNaN;
    out.guided[m] = out.raw[m] + kGuide * target_.worst() * ((1 - failed) * off[m] + failed * kMostMisplaced);
  }
  return out;
}

void Objective::extend(Replicates& replicates, const Candidates& candidates, const std::vector<bool>& wanted, std::span<const Rng> seeds,
                       int finer) const {
  std::vector<Job> jobs;
  std::vector<std::size_t> of;  // whose
  for (std::size_t c = 0; c < candidates.size(); ++c)
    for (std::size_t r = replicates[c].size(); wanted[c] && r < seeds.size(); ++r)
      jobs.push_back({candidates[c], seeds[r], finer}), of.push_back(c);
  auto runs = ensemble_.measured<ScoredRun>(jobs, "", [&](const Run& run, std::size_t) { return scored(run); });
  for (std::size_t k = 0; k < runs.size(); ++k) replicates[of[k]].push_back(std::move(runs[k]));
}

std::vector<Outcome> Objective::evaluate(const Candidates& candidates, std::span<const Rng> seeds, int finer) const {
  Replicates replicates(candidates.size());
  extend(replicates, candidates, std::vector<bool>(candidates.size(), true), seeds, finer);
  std::vector<Outcome> out;
  for (const auto& runs : replicates) out.push_back(outcome(runs));
  return out;
}

std::vector<Outcome> Objective::outcomes(Replicates& replicates, const Candidates& candidates, const std::vector<bool>& wanted,
                                         std::span<const Rng> seeds, int finer, std::size_t known) const {
  std::optional<Journal> journal;
  if (ensemble_.runtime().checkpoint) journal.emplace(*ensemble_.runtime().checkpoint);
  std::vector<Outcome> out(candidates.size());
  std::vector<std::string> keys(candidates.size());
  std::vector<bool> missing = wanted;
  for (std::size_t c = 0; journal && c < candidates.size(); ++c) {
    if (!wanted[c]) continue;
    keys[c] = Journal::key(ensemble_.identity(finer), candidates[c], seeds);
    auto found = journal->find(keys[c]);
    if (!found) continue;
    out[c] = std::move(*found);
    missing[c] = false;
    if (Tally* tally = ensemble_.runtime().tally) tally->found += static_cast<std::int64_t>(seeds.size() - known);
  }
  extend(replicates, candidates, missing, seeds, finer);
  std::vector<std::pair<std::string, Outcome>> fresh;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    if (!missing[c]) continue;
    out[c] = outcome(replicates[c]);
    out[c].distributions = {};  // large, and of use for winners only
    if (journal) fresh.emplace_back(keys[c], out[c]);
  }
  if (journal) journal->add(fresh);
  return out;
}

std::vector<Outcome> Objective::race(const Candidates& candidates, std::span<const Rng> seeds, std::size_t first,
                                     const Worth& worth) const {
  Replicates replicates(candidates.size());
  auto out = outcomes(replicates, candidates, std::vector<bool>(candidates.size(), true), seeds.first(first), 1, 0);
  for (Outcome& heat : out) heat.first = heat.guided;
  const std::vector<bool> on = worth(out);
  auto whole = outcomes(replicates, candidates, on, seeds, 1, first);
  for (std::size_t c = 0; c < out.size(); ++c) {
    if (!on[c]) continue;
    whole[c].first = std::move(out[c].first);
    out[c] = std::move(whole[c]);
  }
  return out;
}

Outcome Objective::energies(const std::vector<double>& candidate, std::span<const Rng> seeds, int finer) const {
  Replicates none(1);
  return outcomes(none, {candidate}, {true}, seeds, finer, 0).front();
}

Outcome Objective::evaluate(const std::vector<double>& candidate, std::span<const Rng> seeds, int finer) const {
  return evaluate(std::vector<std::vector<double>>{candidate}, seeds, finer).front();
}

}  // namespace swarmfit
