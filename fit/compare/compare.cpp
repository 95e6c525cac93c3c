// SPDX-License-Identifier: MIT
#include "fit/compare/compare.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fit/compare/appearance.h"
#include "fit/compare/calibration.h"
#include "fit/compare/certainty.h"
#include "fit/compare/common_dynamics.h"
#include "fit/compare/facts.h"
#include "fit/compare/hold_out.h"
#include "fit/compare/rank.h"
#include "fit/compare/sensitivity.h"
#include "fit/compare/warnings.h"
#include "fit/compare/without_one.h"
#include "fit/model_fit/model_fit_of.h"
#include "libtrack/error.h"

namespace swarmfit {
namespace {

RunRecord run_record(const CompareOptions& options) {
  RunRecord out;
  out.command = options.models.size() > 1 ? "compare" : "fit";
  out.seed = options.seed;
  out.protocol = options.protocol;
  out.common = options.common;
  out.budget = options.budget;
  for (const ModelChoice& model : options.models) out.named.push_back(model.name);
  return out;
}

std::vector<std::string> searched_names(const SearchSpace& space) {
  std::vector<std::string> out;
  for (const std::size_t row : space.searched()) out.emplace_back(space.model().spec->parameters[row].name);
  return out;
}

// How sure the places of models are that stand in order, and what else is known of them once they do.
void add_standings(std::vector<ModelFit>& models, const Trial& trial, const PerColumn<double>& weights, int pooled) {
  std::vector<Energies> energies;
  for (const ModelFit& fit : models) energies.push_back(fit.standing.energies);
  const auto sure = certainties({&trial, 1}, pooled);
  const auto sensitive = sensitivities(energies, weights);
  for (std::size_t k = 0; k < models.size(); ++k) {
    Standing& s = models[k].standing;
    s.certainty = sure[k];
    s.in_sample.group = sure[k].group;
    s.in_sample.lower = sure[k].lower;
    s.in_sample.upper = sure[k].upper;
    s.sensitivity = sensitive[k];
  }
}

// The same of the halves that were not fitted: that is what decides.
void add_held_out(std::vector<ModelFit>& models, HoldOut& held, const Order& order, int pooled) {
  std::vector<Trial> trials;
  for (Trial& trial : held.trials) trials.push_back(in_order(std::move(trial), order));
  const auto sure = certainties(trials, pooled);
  for (std::size_t k = 0; k < models.size(); ++k) {
    Standing& s = models[k].standing;
    s.held_out = std::move(held.models[order[k]]);
    s.held_out.gof_p = sure[k].gof_p;
    Certainty& c = s.certainty;
    c.group = sure[k].group;
    c.set_p = sure[k].set_p;
    std::tie(c.lower, c.upper, c.lead_lower, c.lead_upper) = std::tie(sure[k].lower, sure[k].upper, sure[k].lead_lower, sure[k].lead_upper);
  }
}

// Between which values the parameters of the fits to halves lie.
void add_ranges(ModelFit& fit, const ModelSpec& spec, const std::vector<std::vector<double>>& fits) {
  for (ParameterResult& p : fit.parameters) {
    if (!p.fitted) continue;
    const auto row = static_cast<std::size_t>(spec.find(p.name));
    const auto less = [row](const auto& a, const auto& b) { return a[row] < b[row]; };
    const auto [low, high] = std::minmax_element(fits.begin(), fits.end(), less);
    p.halves_lower = (*low)[row];
    p.halves_upper = (*high)[row];
  }
}

void describe_ranking(Comparison& result, const Trial& trial) {
  Ranking& ranking = result.ranking;
  ranking.lags = lag_facts(result.recording, ranking.weights);
  ranking.bootstrap_recordings = static_cast<int>(trial.bootstraps.recordings.size());
  ranking.band = band_of(trial.bootstraps.recordings, *trial.target);
  ranking.without = without_each(result.models, result.recording);
  ranking.walk_suffices = walk_suffices(result.recording.skill, result.models);
}

void check_likelihood(const CompareOptions& options) {
  const auto has_one = [](const ModelChoice& m) { return m.spec->linear != nullptr; };
  if (options.likelihood && std::none_of(options.models.begin(), options.models.end(), has_one))
    throw InputError("`likelihood`: none of these models has one in closed form; expected langevin among them");
}

// Puts the models in order, and says how sure that is.
void rank_models(Comparison& result, Trial trial, std::optional<HoldOut>& held, int pooled) {
  const Order order = order_by_score(result.models);
  result.models = in_order(std::move(result.models), order);
  number(result.models);
  trial = in_order(std::move(trial), order);
  add_standings(result.models, trial, result.ranking.weights, pooled);
  if (held) {
    result.recording.hold_out = held->facts;
    add_held_out(result.models, *held, order, pooled);
  }
  describe_ranking(result, trial);
}

bool holds_out(const Tracks& recording, const CompareOptions& options) {
  using When = CompareOptions::HoldOutWhen;
  return options.hold_out == When::always || (options.hold_out == When::worth_it && options.models.size() > 1 && worth_halving(recording));
}

// Columns of the score that are not mostly localisation error: on those the skill rests.
PerColumn<bool> clear_columns(const ObservationFacts& o) {
  PerColumn<bool> out = o.used;
  for (std::size_t j = 0; j < out.size(); ++j) out[j] = out[j] && !o.error_dominated[j];
  return out;
}

// A model's search as the comparison shows it; all but its place among the others.
ModelFit fit_of(const ModelSearch& search, const ModelChoice& model, const CompareOptions& options, std::size_t m) {
  ModelFit fit = model_fit_of(search);
  fit.learns = model.spec->needs_reference;
  if (options.likelihood) fill_likelihood(fit, search, Rng{options.seed}.derive(Stream::probe, m));
  if (options.posterior) fill_posterior(fit, search, Rng{options.seed}.derive(Stream::posterior, m));
  return fit;
}

// Fits as they are ranked, and what says how sure that is.
Trial tried(Comparison& result, const Calibration& calibration, const Target& target, const Appearance& appearance,
            const std::optional<HoldOut>& held, const CompareOptions& options) {
  const Weighting& weighting = calibration.weighting();
  Trial trial{{}, {{}, {}, {}, {options.seed}}, &target, weighting};
  std::vector<std::vector<Energies>> selections;
  for (std::size_t m = 0; m < options.models.size(); ++m) {
    const ModelSearch& search = calibration.searches()[m];
    ModelFit fit = fit_of(search, options.models[m], options, m);
    fit.standing = standing_of(fit.runs, weighting);
    trial.models.push_back({fit.standing.score, fit.runs.raw_energies});
    if (held) fit.standing.score = held->scores[m];
    if (held) add_ranges(fit, *options.models[m].spec, held->values[m]);
    appearance.show(fit, search.selected().views);
    trial.bootstraps.of.push_back(
        bootstrap_of(search.objective(), search.space().parameters(search.selected().x), {options.seed}, options.bootstrap_recordings));
    selections.push_back(search.selections());
    result.run.searched.push_back(searched_names(search.space()));
    result.models.push_back(std::move(fit));
  }
  trial.bootstraps.scatter = search_scatter(selections, weighting);
  return trial;
}

}  // namespace

Comparison compare(const Tracks& recording, const CompareOptions& wanted, const OnCompareProgress& on_progress, const Runtime& runtime) {
  check_requests(wanted.requests, wanted.models);
  check_likelihood(wanted);
  const CompareOptions options = wanted.common_dynamics ? with_common_dynamics(recording, wanted, on_progress, runtime) : wanted;
  Conditions conditions = make_conditions(recording, options.conditions);
  conditions.metrics.lags = lags_for(conditions, options);
  const Target target(recorded_samples(conditions.recording, conditions.metrics), options.binning);
  Appearance appearance(conditions, options.models.size());

  Comparison result;
  result.run = run_record(options);
  result.film = appearance.film();
  result.around = appearance.around();
  result.recording = recording_facts(recording, conditions, target, options);
  result.recording.pictures = appearance.pictures();
  result.recording.forces = appearance.forces();

  const ObservationFacts& observation = result.recording.observation;
  const std::vector<bool> used(observation.used.begin(), observation.used.end());
  Calibration calibration(options, conditions, target, used, result.run.history, on_progress, runtime, appearance.view());
  appearance.assess(clear_columns(observation), options.seed, runtime);  // computes, so after whatever the searches refuse
  result.recording.skill = appearance.skill().skill();
  result.recording.panel = appearance.skill().panel();
  result.ranking = calibration.run(result.recording.resolution);

  std::optional<HoldOut> held;
  if (holds_out(recording, options)) held = hold_out(recording, wanted, on_progress, runtime);
  Trial trial = tried(result, calibration, target, appearance, held, options);
  rank_models(result, std::move(trial), held, options.budget.final_replicates);
  result.warnings = all_warnings(result);
  return result;
}

}  // namespace swarmfit
