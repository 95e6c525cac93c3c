// SPDX-License-Identifier: MIT
#include "fit/compare/rank.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "fit/compare/sensitivity.h"
#include "fit/model_fit/race.h"

namespace swarmfit {
namespace {

Order order_of(const std::vector<double>& scores) {
  Order order(scores.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto score = [&](std::size_t k) { return std::isnan(scores[k]) ? -INFINITY : scores[k]; };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return score(a) > score(b); });
  return order;
}

int rank_among(const std::vector<Scored>& models, double score) {
  if (!std::isfinite(score)) return 0;
  return 1 + static_cast<int>(std::count_if(models.begin(), models.end(), [&](const Scored& other) { return other.score > score; }));
}

Energies normalised(const Energies& raw, const Weighting& weighting) {
  Energies out(raw.size());
  for (std::size_t j = 0; j < out.size(); ++j) out[j] = weighting.p2[j] > 0 ? (raw[j] - weighting.p1[j]) / weighting.p2[j] : 0;
  return out;
}

double standard_error(const std::vector<Energies>& replicates, const Weighting& weighting) {
  Moments scores;
  for (const Energies& replicate : replicates) scores.add(-cost_of(replicate, weighting));
  return scores.standard_error();
}

// All models on what was fitted, where they stand in order.
std::vector<Standing> in_sample_standings(const std::vector<FinalRuns>& runs, const Trial& trial, int pooled) {
  PerColumn<double> weights;
  weights.assign(trial.weighting.weights.begin(), trial.weighting.weights.end());
  std::vector<Energies> energies;
  for (const FinalRuns& of : runs) energies.push_back(normalised(of.raw_energies, trial.weighting));
  const auto sensitive = sensitivities(energies, weights);
  const auto sure = certainties({&trial, 1}, pooled);
  std::vector<Standing> out;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const double score = trial.models[k].score, se = standard_error(runs[k].replicate_energies, trial.weighting);
    const InSample in{rank_among(trial.models, score), score, se, sure[k].group, sure[k].lower, sure[k].upper};
    out.push_back({std::isfinite(score) ? static_cast<int>(k) + 1 : 0, score, sure[k], in, energies[k], sensitive[k], {}});
  }
  return out;
}

// What decides if there are halves that were not fitted. Goodness and own energies stay those of the fit to the whole recording.
void decide_by(const HoldOut& held, const Order& order, int pooled, std::vector<Standing>& standings) {
  std::vector<Trial> trials;
  for (const Trial& trial : held.trials) trials.push_back(in_order(trial, order));
  const auto sure = certainties(trials, pooled);
  for (std::size_t k = 0; k < standings.size(); ++k) {
    Standing& s = standings[k];
    s.score = held.scores[order[k]];
    s.rank = std::isfinite(s.score) ? static_cast<int>(k) + 1 : 0;
    s.held_out = held.models[order[k]];
    s.held_out.gof_p = sure[k].gof_p;
    Certainty& c = s.certainty;
    c.group = sure[k].group;
    c.set_p = sure[k].set_p;
    std::tie(c.lower, c.upper, c.lead_lower, c.lead_upper) = std::tie(sure[k].lower, sure[k].upper, sure[k].lead_lower, sure[k].lead_upper);
  }
}

}  // namespace

Trial in_order(Trial trial, const Order& order) {
  trial.models = in_order(std::move(trial.models), order);
  trial.bootstraps.of = in_order(std::move(trial.bootstraps.of), order);
  trial.bootstraps.scatter = in_order(std::move(trial.bootstraps.scatter), order);
  trial.bootstraps.recordings = trial.bootstraps.of.front();
  return trial;
}

Ranked ranked(const std::vector<FinalRuns>& runs, Trial in_sample, const std::optional<HoldOut>& held, int pooled) {
  std::vector<double> scores;
  for (const Scored& model : in_sample.models) scores.push_back(model.score);
  const Order order = order_of(held ? held->scores : scores);
  const Trial trial = in_order(std::move(in_sample), order);
  std::vector<Standing> standings = in_sample_standings(in_order(runs, order), trial, pooled);
  if (held) decide_by(*held, order, pooled, standings);
  return {order, std::move(standings), trial.bootstraps.recordings};
}

}  // namespace swarmfit
