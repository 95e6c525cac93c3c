// SPDX-License-Identifier: MIT
#include "fit/model_fit/fit_result.h"

#include <algorithm>
#include <cmath>

#include "fit/experiment/time_step.h"
#include "fit/model_fit/parameter_posterior.h"

namespace swarmfit {
namespace {

double standard_error(const std::vector<double>& values) {
  Moments moments;
  for (const double v : values) moments.add(v);
  const auto n = static_cast<double>(moments.count);
  return n > 1 ? std::sqrt(moments.m2 / (n - 1) / n) : NAN;
}

void fill_energies(FitResult& fit, const ModelSearch& search, const Weighting& weighting) {
  const Outcome& outcome = search.selected().outcome;
  fit.score = -cost_of(outcome.raw, weighting);
  fit.raw_energies = outcome.raw;
  fit.replicate_energies = outcome.replicates;
  std::vector<double> scores;
  for (const auto& replicate : outcome.replicates) scores.push_back(-cost_of(replicate, weighting));
  fit.score_se = standard_error(scores);
  const std::size_t columns = outcome.raw.size();
  fit.energies = fit.raw_se = Energies(columns);
  for (std::size_t j = 0; j < columns; ++j) {
    fit.energies[j] = weighting.p2[j] > 0 ? (outcome.raw[j] - weighting.p1[j]) / weighting.p2[j] : 0;
    std::vector<double> column;
    for (const auto& replicate : outcome.replicates) column.push_back(replicate[j]);
    fit.raw_se[j] = standard_error(column);
  }
  fit.distributions = outcome.distributions;
}

void fill_ratios(FitResult& fit, const Target& target) {
  const std::size_t columns = target.columns().size();
  fit.mean_ratio = fit.sd_ratio = fit.outside_fraction = PerColumn<double>(columns);
  for (std::size_t j = 0; j < columns; ++j) {
    const auto& real = target.recording()[j];
    const auto& sim = fit.distributions[j];
    fit.mean_ratio[j] = sim.moments.mean / real.moments.mean;
    fit.sd_ratio[j] = sim.moments.sd() / real.moments.sd();
    fit.outside_fraction[j] =
        sim.histogram.samples ? static_cast<double>(sim.histogram.outside) / static_cast<double>(sim.histogram.samples) : NAN;
  }
}

// Which parameters are of neighbours? Those that go with an option of that name, and lengths in neighbour distances.
void mark_interaction(FitResult& fit, const ModelSpec& spec) {
  for (ParameterResult& p : fit.parameters) {
    const Parameter& row = spec.parameters[static_cast<std::size_t>(spec.find(p.name))];
    p.interaction = row.when.find("interaction=") != std::string_view::npos || row.length == Parameter::Length::spacing;
  }
}

}  // namespace

FitResult fit_result(const ModelSearch& search, const Weighting& weighting) {
  const Ensemble& ensemble = search.objective().ensemble();
  const ModelChoice& model = ensemble.model();
  const Target& target = search.objective().target();
  FitResult fit;
  fit.model = model.name;
  fit.summary = model.spec->summary;
  fit.citation = model.spec->citation;
  fit.options = {model.options.begin(), model.options.end()};
  const auto& best = search.selected();
  fit.parameters = search.space().describe(best.x, ensemble.conditions().recording.meta().unit);
  mark_interaction(fit, *model.spec);
  fill_energies(fit, search, weighting);
  fill_ratios(fit, target);
  const auto values = search.space().parameters(best.x);
  fit.map = model.spec->is_map(model.options);
  const Outcome halved = search.objective().energies(values, search.final_seeds(), 2);
  fit.half_step_energies = halved.raw;
  fit.steps_settled = fit.map || far_off(best.outcome, target) || same_energies(best.outcome, halved, target);
  fit.evaluations = search.evaluations();
  fit.simulations = search.simulations();
  fit.failed_simulations = search.failed();
  fit.failed_final = static_cast<double>(best.outcome.failed) / static_cast<double>(best.outcome.replicates.size());
  fit.stop_reason = search.stop_reason();
  fit.steps = ensemble.steps();
  const auto& count = best.outcome.count;
  fit.infeasible_avoidance =
      count.agent_steps ? static_cast<double>(count.infeasible_avoidance) / static_cast<double>(count.agent_steps) : 0;
  fit.convergence = search.convergence();
  return fit;
}

void fill_posterior(FitResult& fit, const ModelSearch& search, const Rng& rng) {
  if (search.space().dimensions() == 0) return;
  const ParameterPosterior found = posterior_of(search.space(), search.objective(), rng);
  for (const ParameterInterval& p : found.parameters) {
    const auto row = std::find_if(fit.parameters.begin(), fit.parameters.end(), [&](const ParameterResult& r) { return r.name == p.name; });
    row->posterior = {p.median, p.lower, p.upper, p.contraction, to_string(p.verdict), p.partner, p.correlation};
  }
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

std::vector<double> parameter_values(const ModelChoice& model, const FitResult& fit) {
  std::vector<double> values(model.spec->parameters.size(), 0.0);
  for (const auto& p : fit.parameters) values[static_cast<std::size_t>(model.spec->find(p.name))] = p.value;
  return values;
}

}  // namespace swarmfit
