// SPDX-License-Identifier: MIT
#include "fit/model_fit/model_fit_of.h"

#include <algorithm>

#include "fit/experiment/time_step.h"
#include "fit/model_fit/likelihood.h"
#include "fit/model_fit/parameter_posterior.h"
#include "fit/model_fit/regression.h"
#include "libtrack/nan.h"

namespace swarmfit {
namespace {

FinalRuns final_runs(const Outcome& outcome, const Target& target) {
  FinalRuns out;
  const std::size_t columns = outcome.raw.size();
  out.raw_energies = outcome.raw;
  out.replicate_energies = outcome.replicates;
  out.distributions = outcome.distributions;
  out.raw_se = Energies(columns);
  out.mean_ratio = out.sd_ratio = out.outside_fraction = PerColumn<double>(columns);
  for (std::size_t j = 0; j < columns; ++j) {
    Moments energies;
    for (const auto& replicate : outcome.replicates) energies.add(replicate[j]);
    out.raw_se[j] = energies.standard_error();
    const auto& real = target.recording()[j].moments;
    const auto& sim = out.distributions[j];
    out.mean_ratio[j] = sim.moments.mean / real.mean;
    out.sd_ratio[j] = sim.moments.sd() / real.sd();
    out.outside_fraction[j] =
        sim.histogram.samples ? static_cast<double>(sim.histogram.outside) / static_cast<double>(sim.histogram.samples) : kNaN;
  }
  out.failed_final = static_cast<double>(outcome.failed) / static_cast<double>(outcome.replicates.size());
  const auto& count = outcome.count;
  out.infeasible_avoidance =
      count.agent_steps ? static_cast<double>(count.infeasible_avoidance) / static_cast<double>(count.agent_steps) : 0;
  return out;
}

// Which parameters are of neighbours? Those that go with an option of that name, and lengths in neighbour distances.
void mark_interaction(std::vector<ParameterResult>& parameters, const ModelSpec& spec) {
  for (ParameterResult& p : parameters) {
    const Parameter& row = spec.parameters[static_cast<std::size_t>(spec.find(p.name))];
    p.interaction = row.when.find("interaction=") != std::string_view::npos || row.length == Parameter::Length::spacing;
  }
}

ParameterResult& parameter(ModelFit& fit, const std::string& name) {
  return *std::find_if(fit.parameters.begin(), fit.parameters.end(), [&](const ParameterResult& r) { return r.name == name; });
}

// The posterior of its searched parameters.
void add_posterior(ModelFit& fit, const ModelSearch& search, const Rng& rng) {
  if (search.space().dimensions() == 0) return;
  const ParameterPosterior found = posterior_of(search.space(), search.objective(), rng);
  for (const ParameterInterval& p : found.parameters)
    parameter(fit, p.name).posterior = {p.median, p.lower, p.upper, p.contraction, to_string(p.verdict), p.partner, p.correlation};
  PosteriorFacts& facts = fit.posterior;
  for (const Point& x : found.posterior.sample) {
    const auto values = search.space().parameters(x);
    facts.sample.emplace_back();
    for (const std::size_t row : search.space().searched()) facts.sample.back().push_back(values[row]);
  }
  facts.weight = found.posterior.weight;
  facts.effective = found.posterior.effective;
  for (const PosteriorRound& round : found.posterior.rounds) facts.simulations += round.simulations, facts.blew_up += round.blew_up;
}

// Its parameters of maximum likelihood.
void add_likelihood(ModelFit& fit, const ModelSearch& search, const Rng& rng) {
  const SearchSpace& space = search.space();
  const auto found = maximum_likelihood(space, search.objective().ensemble().conditions(), search.selected().x, rng);
  if (!found) return;
  fit.likelihood = {found->log_likelihood, found->error};
  for (const MostLikely& one : found->parameters)
    parameter(fit, space.model().spec->parameters[one.row].name).likelihood = {one.value, one.lower, one.upper};
}

// And by regression of accelerations.
void add_regression(ModelFit& fit, const ModelSearch& search) {
  const SearchSpace& space = search.space();
  const auto found = acceleration_fit(space, search.objective().ensemble().conditions());
  if (!found) return;
  fit.regression = {found->rows, found->memory};
  for (const RegressedParameter& one : found->parameters)
    parameter(fit, space.model().spec->parameters[one.row].name).regression = {one.value, one.lower, one.upper};
}

}  // namespace

ModelFit model_fit_of(const ModelSearch& search, const Estimates& wanted, const Rng& root) {
  const Ensemble& ensemble = search.objective().ensemble();
  const ModelChoice& model = ensemble.model();
  const Target& target = search.objective().target();
  const Selected& best = search.selected();
  ModelFit fit;
  fit.model = model.name;
  fit.summary = summary_of(model);
  fit.citation = model.spec->citation;
  fit.options = {model.options.begin(), model.options.end()};
  fit.parameters = search.space().describe(best.x, ensemble.conditions().recording.meta().unit);
  mark_interaction(fit.parameters, *model.spec);
  fit.learns = model.spec->needs_reference;
  fit.search = {search.evaluations(), search.simulations(), search.failed(), search.stop_reason(), search.convergence()};
  fit.runs = final_runs(best.outcome, target);
  const Outcome halved = search.objective().energies(search.space().parameters(best.x), search.final_seeds(), 2);
  fit.runs.half_step_energies = halved.raw;
  fit.runs.steps = ensemble.steps();
  fit.runs.map = model.spec->is_map(model.options);
  fit.runs.steps_settled = fit.runs.map || far_off(best.outcome, target) || same_energies(best.outcome, halved, target);
  if (wanted.likelihood) add_likelihood(fit, search, root.derive(Stream::probe, search.index()));
  if (wanted.regression) add_regression(fit, search);
  if (wanted.posterior) add_posterior(fit, search, root.derive(Stream::posterior, search.index()));
  return fit;
}

std::vector<double> parameter_values(const ModelChoice& model, const ModelFit& fit) {
  std::vector<double> values(model.spec->parameters.size(), 0.0);
  for (const auto& p : fit.parameters) values[static_cast<std::size_t>(model.spec->find(p.name))] = p.value;
  return values;
}

}  // namespace swarmfit
