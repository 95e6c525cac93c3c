// SPDX-License-Identifier: MIT
#include "fit/experiment/objective.h"

#include <cmath>

#include "fit/experiment/observe.h"
#include "libeval/energy_score.h"
#include "libtrack/kinematics.h"
#include "libtrack/parallel_for.h"

namespace swarmfit {
namespace {

// Energies of distributions that do not overlap are all the worst; this share of it per unit of Target::misplacement shows a search the
// way, and is small beside the differences that remain once they do overlap (docs/search.md).
constexpr double kGuide = 0.02;
constexpr double kEscapeSpeed = 1e3;  // in units of the recorded mean speed: nothing recorded moves like that

void add(Counters& sum, const Counters& part) {
  sum.agent_steps += part.agent_steps;
  sum.infeasible_avoidance += part.infeasible_avoidance;
  sum.halved_steps += part.halved_steps;
}

void append(MetricSamples& all, const MetricSamples& part) {
  for (std::size_t m = 0; m < all.values.size(); ++m)
    all.values[m].insert(all.values[m].end(), part.values[m].begin(), part.values[m].end());
}

}  // namespace

// One replicate. Samples are kept only where pooling needs them: z-scores of a pooled set are not those of its parts.
struct Objective::Trial {
  PerColumn<Distribution> distributions;
  MetricSamples samples;
  Energies raw;
  Counters count;
  bool failed = false;
};

Objective::Objective(const ModelChoice& model, const Conditions& conditions, const Target& target, Journal* journal)
    : conditions_(conditions), target_(target), journal_(journal), choice_(model) {
  const Tracks& recording = conditions.recording;
  const Tracks* reference = conditions.reference ? conditions.reference.get() : &recording;
  plan_.frame_dt = recording.dt();
  stable_steps_ = swarmfit::stable_steps(model, conditions.scales, recording.dt());
  use_steps(conditions.options.steps > 0 ? conditions.options.steps : stable_steps_);
  plan_.first_frame = conditions.first_frame;
  plan_.frames = conditions.frames;
  plan_.speed_limit = kEscapeSpeed * conditions.scales.speed;
  model_ = make_model(model, {.dims = recording.dims(),
                              .scales = conditions.scales,
                              .reference = reference,
                              .step = plan_.frame_dt / plan_.substeps,
                              .kinds = recording.kinds()});
}

void Objective::use_steps(int steps) { plan_.substeps = choice_.spec->is_map(choice_.options) ? 1 : steps; }

Tracks Objective::simulate(const std::vector<double>& candidate, const Rng& seed, int finer, Counters& count, bool& blew_up) const {
  const bool as_recorded = conditions_.options.presence == ConditionOptions::Presence::recorded;
  const bool keep_velocity = conditions_.options.velocity == VelocitySource::recorded;
  TrackCollector collector(conditions_.recording.names(), keep_velocity);
  Observer camera(as_recorded ? &conditions_.recording : nullptr, conditions_.sigma, seed, collector,
                  static_cast<std::uint32_t>(conditions_.recording.track_count()), conditions_.grid);
  Plan plan = plan_;
  if (!choice_.spec->fixed_step) plan.substeps *= finer;
  Lane lane{candidate, seed, State{}, conditions_.world, &camera, {}, false};
  cpu_backend().run(*model_, plan, {&lane, 1});
  count = lane.count;
  blew_up = lane.blew_up;
  TrackMeta meta = conditions_.recording.meta();
  meta.from = {};
  meta.from.synthetic = true;
  Tracks seen = collector.take(meta);
  return conditions_.options.smoothing > 0 ? smooth(seen, conditions_.options.smoothing) : seen;
}

Tracks Objective::simulate(const std::vector<double>& candidate, const Rng& seed, int finer) const {
  Counters count;
  bool blew_up = false;
  return simulate(candidate, seed, finer, count, blew_up);
}

std::optional<Tracks> Objective::finished(const std::vector<double>& candidate, const Rng& seed) const {
  Counters count;
  bool blew_up = false;
  Tracks seen = simulate(candidate, seed, 1, count, blew_up);
  return blew_up ? std::nullopt : std::optional(std::move(seen));
}

Objective::Trial Objective::run(const std::vector<double>& candidate, const Rng& seed, int finer) const {
  const std::size_t columns = target_.columns().size();
  Trial trial;
  trial.raw = Energies(columns);
  const Tracks seen = simulate(candidate, seed, finer, trial.count, trial.failed);
  if (!trial.failed) {
    trial.samples = metric_samples(seen, conditions_.metrics);
    trial.distributions = target_.distributions(trial.samples);
    trial.raw = target_.energies(trial.distributions);
    if (target_.binning().normalisation != Normalisation::separate) trial.samples = {};
  }
  for (std::size_t m = 0; m < columns; ++m)
    if (target_.defined(m) && (trial.failed || std::isnan(trial.raw[m]))) trial.raw[m] = target_.worst();
  return trial;
}

// The energy score of the runs that ended well; their replicates become its parts.
Energies Objective::scored(const std::vector<Trial>& trials, std::vector<Energies>& replicates) const {
  std::vector<Densities> runs;
  std::vector<Energies> away;
  for (const Trial& trial : trials) {
    if (trial.failed) continue;
    runs.push_back(target_.densities(trial.distributions));
    away.push_back(trial.raw);
  }
  EnergyScore score = energy_score(std::move(away), spread(runs, target_.worst()));
  for (std::size_t r = 0, k = 0; r < trials.size(); ++r)
    if (!trials[r].failed) replicates[r] = std::move(score.runs[k++]);
  return score.value;
}

Outcome Objective::pool(const std::vector<Trial>& trials) const {
  const std::size_t columns = target_.columns().size();
  Outcome out;
  out.raw = out.guided = Energies(columns);
  out.distributions = PerColumn<Distribution>(columns);
  MetricSamples samples(target_.columns());
  for (const Trial& trial : trials) {
    out.replicates.push_back(trial.raw);
    out.failed += trial.failed;
    add(out.count, trial.count);
    if (trial.failed) continue;
    if (target_.binning().normalisation == Normalisation::separate) append(samples, trial.samples);
    for (std::size_t m = 0; m < columns; ++m) {
      out.distributions[m].histogram.add(trial.distributions[m].histogram);
      out.distributions[m].moments.add(trial.distributions[m].moments);
    }
  }
  if (target_.binning().normalisation == Normalisation::separate) out.distributions = target_.distributions(samples);
  const double failed = static_cast<double>(out.failed) / static_cast<double>(trials.size());
  const auto off = target_.misplacement(out.distributions);
  Energies good;
  if (failed < 1) good = target_.binning().pooled ? target_.energies(out.distributions) : scored(trials, out.replicates);
  for (std::size_t m = 0; m < columns; ++m) {
    const double energy = failed < 1 && std::isfinite(good[m]) ? good[m] : target_.worst();
    out.raw[m] = target_.defined(m) ? (1 - failed) * energy + failed * target_.worst() : NAN;
    out.guided[m] = out.raw[m] + kGuide * target_.worst() * ((1 - failed) * off[m] + failed * kMostMisplaced);
  }
  return out;
}

void Objective::extend(std::vector<std::vector<Trial>>& trials, const Candidates& candidates, const std::vector<bool>& wanted,
                       std::span<const Rng> seeds, int finer) const {
  struct Job {
    std::size_t candidate, trial;
  };
  std::vector<Job> jobs;
  for (std::size_t c = 0; c < candidates.size(); ++c)
    while (wanted[c] && trials[c].size() < seeds.size()) jobs.push_back({c, trials[c].size()}), trials[c].emplace_back();
  parallel_for(jobs.size(), [&](std::size_t k) {
    trials[jobs[k].candidate][jobs[k].trial] = run(candidates[jobs[k].candidate], seeds[jobs[k].trial], finer);
  });
}

std::vector<SingleRun> Objective::singles(const std::vector<double>& candidate, std::span<const Rng> seeds) const {
  std::vector<std::vector<Trial>> trials(1);
  extend(trials, {candidate}, {true}, seeds, 1);
  std::vector<SingleRun> out;
  for (Trial& trial : trials.front()) out.push_back({std::move(trial.distributions), trial.failed});
  return out;
}

std::vector<Outcome> Objective::evaluate(const Candidates& candidates, std::span<const Rng> seeds, int finer) const {
  std::vector<std::vector<Trial>> trials(candidates.size());
  extend(trials, candidates, std::vector<bool>(candidates.size(), true), seeds, finer);
  std::vector<Outcome> out;
  for (const auto& runs : trials) out.push_back(pool(runs));
  return out;
}

std::vector<Outcome> Objective::outcomes(std::vector<std::vector<Trial>>& trials, const Candidates& candidates,
                                         const std::vector<bool>& wanted, std::span<const Rng> seeds) const {
  std::vector<Outcome> out(candidates.size());
  std::vector<std::string> keys(candidates.size());
  std::vector<bool> missing = wanted;
  for (std::size_t c = 0; journal_ && c < candidates.size(); ++c) {
    if (!wanted[c]) continue;
    keys[c] = Journal::key(choice_.name, steps(), candidates[c], seeds);
    auto known = journal_->find(keys[c]);
    if (!known) continue;
    out[c] = std::move(*known);
    missing[c] = false;
  }
  extend(trials, candidates, missing, seeds, 1);
  std::vector<std::pair<std::string, Outcome>> fresh;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    if (!missing[c]) continue;
    out[c] = pool(trials[c]);
    out[c].distributions = {};  // large, and of use for winners only
    if (journal_) fresh.emplace_back(keys[c], out[c]);
  }
  if (journal_) journal_->add(fresh);
  return out;
}

std::vector<Outcome> Objective::race(const Candidates& candidates, std::span<const Rng> seeds, std::size_t first,
                                     const Worth& worth) const {
  std::vector<std::vector<Trial>> trials(candidates.size());
  auto out = outcomes(trials, candidates, std::vector<bool>(candidates.size(), true), seeds.first(first));
  for (Outcome& heat : out) heat.first = heat.guided;
  const std::vector<bool> on = worth(out);
  auto whole = outcomes(trials, candidates, on, seeds);
  for (std::size_t c = 0; c < out.size(); ++c) {
    if (!on[c]) continue;
    whole[c].first = std::move(out[c].first);
    out[c] = std::move(whole[c]);
  }
  return out;
}

Outcome Objective::evaluate(const std::vector<double>& candidate, std::span<const Rng> seeds, int finer) const {
  return evaluate(std::vector<std::vector<double>>{candidate}, seeds, finer).front();
}

std::vector<Rng> replicate_seeds(const Rng& root, Stream stream, int replicates) {
  std::vector<Rng> seeds;
  for (int r = 0; r < replicates; ++r) seeds.push_back(root.derive(stream, static_cast<std::uint64_t>(r)));
  return seeds;
}

}  // namespace swarmfit
