// SPDX-License-Identifier: MIT
#include "fit/compare/compare.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "fit/compare/appearance.h"
#include "fit/compare/calibration.h"
#include "fit/compare/certainty.h"
#include "fit/compare/common_dynamics.h"
#include "fit/compare/facts.h"
#include "fit/compare/hold_out.h"
#include "fit/compare/rank.h"
#include "fit/compare/warnings.h"
#include "fit/compare/without_one.h"
#include "fit/model_fit/model_fit_of.h"
#include "libtrack/error.h"

namespace swarmfit {
namespace {

void check_second_opinions(const CompareOptions& options) {
  const auto has_likelihood = [](const ModelChoice& m) { return m.spec->linear != nullptr; };
  if (options.likelihood && std::none_of(options.models.begin(), options.models.end(), has_likelihood))
    throw InputError("`likelihood`: none of these models has one in closed form; expected langevin among them");
  const auto has_forces = [](const ModelChoice& m) { return m.spec->has_force(m.options); };
  if (options.regression && std::none_of(options.models.begin(), options.models.end(), has_forces))
    throw InputError(
        "`regression`: none of these models moves by forces and simple noise; expected brownian, langevin or bswarm[noise=white] among "
        "them");
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

std::vector<std::string> searched_names(const SearchSpace& space) {
  std::vector<std::string> out;
  for (const std::size_t row : space.searched()) out.emplace_back(space.model().spec->parameters[row].name);
  return out;
}

RunRecord run_record(const CompareOptions& options, const Calibration& calibration) {
  RunRecord out;
  out.command = options.models.size() > 1 ? "compare" : "fit";
  out.seed = options.seed;
  out.protocol = options.protocol;
  out.common = options.common;
  out.budget = options.budget;
  for (const ModelChoice& model : options.models) out.named.push_back(model.name);
  for (const ModelSearch& search : calibration.searches()) out.searched.push_back(searched_names(search.space()));
  out.history = calibration.history();
  return out;
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

// Everything about the models but where they stand, in the order in which they were named.
std::vector<ModelFit> fits_of(const Calibration& calibration, const Appearance& appearance, const std::optional<HoldOut>& held,
                              const CompareOptions& options) {
  std::vector<ModelFit> out;
  for (const ModelSearch& search : calibration.searches()) {
    ModelFit fit = model_fit_of(search, {options.likelihood, options.regression, options.posterior}, {options.seed});
    if (held) add_ranges(fit, *search.space().model().spec, held->values[search.index()]);
    Look look = appearance.of(search.selected().views);
    fit.likeness = std::move(look.likeness);
    fit.film = std::move(look.film);
    out.push_back(std::move(fit));
  }
  return out;
}

// What the models came to on the recording that was fitted, and on recordings of their own.
Trial in_sample_trial(const Calibration& calibration, const Target& target, const CompareOptions& options) {
  const Weighting& weighting = calibration.weighting();
  Trial out{{}, {{}, {}, {}, {options.seed}}, &target, weighting};
  std::vector<std::vector<Energies>> selections;
  for (const ModelSearch& search : calibration.searches()) {
    const auto& [x, outcome, views] = search.selected();
    out.models.push_back({-cost_of(outcome.raw, weighting), outcome.raw});
    out.bootstraps.of.push_back(
        bootstrap_of(search.objective(), search.space().parameters(x), {options.seed}, options.bootstrap_recordings));
    selections.push_back(search.selections());
  }
  out.bootstraps.scatter = search_scatter(selections, weighting);
  return out;
}

std::vector<ModelFit> in_place(std::vector<ModelFit> fits, const Ranked& ranked) {
  std::vector<ModelFit> out = in_order(std::move(fits), ranked.order);
  for (std::size_t k = 0; k < out.size(); ++k) out[k].standing = ranked.standings[k];
  return out;
}

// What is compared with: known before anything is simulated.
struct Subject {
  Conditions conditions;
  Target target;
  ObservationFacts observation;
  PerColumn<double> resolution;
};

Subject subject_of(const Tracks& recording, const CompareOptions& options) {
  Conditions conditions = make_conditions(recording, options.conditions);
  conditions.metrics.lags = lags_for(conditions, options);
  Target target(recorded_samples(conditions.recording, conditions.metrics), options.binning);
  ObservationFacts observation = observation_facts(conditions, target, options);
  PerColumn<double> least = resolution(conditions, target, options, observation.error_dominated);
  return {std::move(conditions), std::move(target), std::move(observation), std::move(least)};
}

RecordingFacts recording_facts(const Tracks& recording, const Subject& subject, const Appearance& appearance,
                               const std::optional<HoldOut>& held) {
  RecordingFacts out = measured_facts(subject.target);
  out.data = data_facts(recording, subject.conditions.scales);
  out.observation = subject.observation;
  out.resolution = subject.resolution;
  out.skill = appearance.skill().skill();
  out.panel = appearance.skill().panel();
  out.pictures = appearance.pictures();
  out.forces = appearance.forces();
  if (held) out.hold_out = held->facts;
  return out;
}

Ranking ranking_of(CalibrationFacts calibrated, const RecordingFacts& facts, const std::vector<ModelFit>& models, const Bootstrap& of_first,
                   const Target& target) {
  std::vector<LagFacts> lags = lag_facts(facts, calibrated.weights);
  return {std::move(calibrated),
          std::move(lags),
          static_cast<int>(of_first.size()),
          band_of(of_first, target),
          without_each(models, facts),
          walk_suffices(facts.skill, models)};
}

}  // namespace

Comparison compare(const Tracks& recording, const CompareOptions& wanted, const OnCompareProgress& on_progress, const Runtime& runtime) {
  check_requests(wanted.requests, wanted.models);
  check_second_opinions(wanted);
  const CompareOptions options = wanted.common_dynamics ? with_common_dynamics(recording, wanted, on_progress, runtime) : wanted;
  const Subject subject = subject_of(recording, options);
  Appearance appearance(subject.conditions, options.models.size());
  Calibration calibration(options, subject.conditions, subject.target, subject.observation.used, on_progress, runtime, appearance.view());
  appearance.assess(clear_columns(subject.observation), options.seed, runtime);  // computes, so after whatever the searches refuse
  const CalibrationFacts calibrated = calibration.run(subject.resolution);
  std::optional<HoldOut> held;
  if (holds_out(recording, options)) held = hold_out(recording, wanted, on_progress, runtime);

  std::vector<ModelFit> fits = fits_of(calibration, appearance, held, options);
  std::vector<FinalRuns> runs;
  for (const ModelFit& fit : fits) runs.push_back(fit.runs);
  const Ranked placed = ranked(runs, in_sample_trial(calibration, subject.target, options), held, options.budget.final_replicates);

  const RecordingFacts facts = recording_facts(recording, subject, appearance, held);
  const std::vector<ModelFit> models = in_place(std::move(fits), placed);
  const Ranking ranking = ranking_of(calibrated, facts, models, placed.of_first, subject.target);
  Comparison result{run_record(options, calibration), facts, ranking, models, appearance.film(), appearance.around(), {}};
  result.warnings = all_warnings(result);
  return result;
}

}  // namespace swarmfit
