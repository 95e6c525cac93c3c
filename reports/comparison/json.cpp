// SPDX-License-Identifier: MIT
// The document of a comparison or a fit.
#include "reports/comparison/json.h"

#include <nlohmann/json.hpp>

#include "reports/comparison/skill_json.h"
#include "reports/write/json_parts.h"

namespace swarmfit {

namespace {

using namespace json_parts;

Json data(const DataFacts& d) {
  return {{"path", d.path},
          {"sha256", d.sha256},
          {"format", d.format},
          {"columns", d.columns},
          {"synthetic", d.synthetic},
          {"dims", d.dims},
          {"unit", d.unit},
          {"dt", d.dt},
          {"rows", d.rows},
          {"tracks", d.tracks},
          {"frames", d.frames},
          {"first_frame", d.first_frame},
          {"last_frame", d.last_frame},
          {"individuals_per_frame", d.individuals_per_frame},
          {"extent", d.extent},
          {"spacing", d.spacing},
          {"speed", d.speed},
          {"notes", d.notes}};
}

Json search_size(const SearchSize& s) {
  return {{"population", s.population}, {"generations", s.generations}, {"replicates", s.replicates}};
}

Json observation(const Columns& columns, const ObservationFacts& o) {
  return {{"error_source", o.error_source},
          {"sigma", array(o.sigma)},
          {"white", o.white},
          {"rounding", array(o.rounding)},
          {"smoothing", o.smoothing},
          {"velocity", o.velocity},
          {"independent_samples", per_column(columns, o.independent)},
          {"error_share", per_column(columns, o.error_share)},
          {"drowned", per_column(columns, o.drowned)},
          {"used", per_column(columns, o.used)},
          {"why_not", per_column(columns, o.why_not)},
          {"longest_lag", o.longest_lag}};
}

Json lags(const Comparison& c) {
  Json out = Json::array();
  for (const LagFacts& l : c.ranking.lags) {
    const bool none = l.lag == 0;
    out.push_back({{"lag", none ? Json() : Json(l.lag)},
                   {"seconds", none ? Json() : Json(l.lag * c.recording.data.dt)},
                   {"scored", l.scored},
                   {"weight", l.weight},
                   {"error_share", l.error_share}});
  }
  return out;
}

Json binning(const Comparison& c) {
  return {{"normalisation", name(c.recording.binning.normalisation)},
          {"interval", {c.recording.binning.lower, c.recording.binning.upper}},
          {"bins", c.recording.binning.bins},
          {"clip", c.recording.binning.clip},
          {"scoring", c.recording.binning.pooled ? "pooled" : "proper"},
          {"axis_lower", per_column(c.recording.columns, c.recording.axis_lower)},
          {"axis_width", per_column(c.recording.columns, c.recording.axis_width)},
          {"defined", per_column(c.recording.columns, c.recording.defined)}};
}

Json weight_history(const Columns& columns, const std::vector<WeightStep>& steps) {
  Json out = Json::array();
  for (const WeightStep& s : steps)
    out.push_back({{"pass", s.pass},
                   {"searched", per_column(columns, s.searched)},
                   {"weights", per_column(columns, s.weights)},
                   {"p1", per_column(columns, s.p1)},
                   {"p2", per_column(columns, s.p2)},
                   {"largest_change", s.largest_change}});
  return out;
}

Json parameters(const std::vector<ParameterResult>& table) {
  Json out = Json::object();
  for (const ParameterResult& p : table) {
    const ParameterUncertainty& u = p.posterior;
    Json& one = out[p.name];
    one = {{"value", p.value},       {"unit", p.unit}, {"lower", p.lower},   {"upper", p.upper},     {"fitted", p.fitted},
           {"at_bound", p.at_bound}, {"log", p.log},   {"symbol", p.symbol}, {"meaning", p.meaning}, {"interaction", p.interaction}};
    if (u.verdict.empty()) continue;
    one["ci"] = {u.lower, u.upper};
    one["median"] = u.median;
    one["contraction"] = u.contraction;
    one["verdict"] = u.verdict;
    one["partner"] = u.partner;
    one["correlation"] = u.correlation;
  }
  return out;
}

Json held_out(const Columns& columns, const ModelFit& r) {
  const Certainty& c = r.standing.held_out.certainty;
  return {{"score", r.standing.held_out.score},
          {"gap", r.standing.score - r.standing.held_out.score},
          {"score_ci", {c.lower, c.upper}},
          {"lead_ci", {c.lead_lower, c.lead_upper}},
          {"group", c.group > 0 ? Json(c.group) : Json()},
          {"set_p", c.set_p},
          {"raw_energies", per_column(columns, r.standing.held_out.raw)},
          {"own_energies", per_column(columns, c.own)}};
}

Json hold_out(const HoldOutFacts& h) {
  if (!h.used) return {};
  return {{"fitted", {h.fitted_first, h.fitted_last}}, {"held_out", {h.held_first, h.held_last}}};
}

Json posterior(const PosteriorFacts& p) {
  return {{"effective_sample_size", p.effective}, {"points", p.sample.size()}, {"simulations", p.simulations}, {"blew_up", p.blew_up}};
}

// Names of the parameters that satisfy a condition.
template <class Condition>
Json names(const std::vector<ParameterResult>& table, Condition condition) {
  Json out = Json::array();
  for (const ParameterResult& p : table)
    if (condition(p)) out.push_back(p.name);
  return out;
}

Json convergence(const std::vector<ConvergencePoint>& points) {
  Json out = Json::array();
  for (const ConvergencePoint& p : points) out.push_back({{"pass", p.pass}, {"evaluations", p.evaluations}, {"best", p.best}});
  return out;
}

Json model(const Columns& columns, const ModelFit& r) {
  Json replicates = Json::array();
  for (const Energies& e : r.runs.replicate_energies) replicates.push_back(per_column(columns, e));
  return {{"name", r.model},
          {"rank", r.standing.rank > 0 ? Json(r.standing.rank) : Json()},
          {"score", r.standing.score},
          {"score_se", r.standing.score_se},
          {"score_ci", {r.standing.certainty.lower, r.standing.certainty.upper}},
          {"lead_ci", {r.standing.certainty.lead_lower, r.standing.certainty.lead_upper}},
          {"group", r.standing.certainty.group > 0 ? Json(r.standing.certainty.group) : Json()},
          {"set_p", r.standing.certainty.set_p},
          {"gof_p", r.standing.certainty.goodness_p},
          {"own_energies", per_column(columns, r.standing.certainty.own)},
          {"raw_energies", per_column(columns, r.runs.raw_energies)},
          {"raw_energies_se", per_column(columns, r.runs.raw_se)},
          {"energies", per_column(columns, r.standing.energies)},
          {"half_step_energies", per_column(columns, r.runs.half_step_energies)},
          {"replicate_energies", std::move(replicates)},
          {"parameters", parameters(r.parameters)},
          {"n_parameters", names(r.parameters, [](const ParameterResult& p) { return p.fitted; }).size()},
          {"at_bounds", names(r.parameters, [](const ParameterResult& p) { return p.at_bound; })},
          {"options", r.options},
          {"summary", r.summary},
          {"citation", r.citation},
          {"mean_ratio", per_column(columns, r.runs.mean_ratio)},
          {"sd_ratio", per_column(columns, r.runs.sd_ratio)},
          {"outside_fraction", per_column(columns, r.runs.outside_fraction)},
          {"samples", samples(columns, r.runs.distributions)},
          {"extent", r.likeness.extent},
          {"spacing", r.likeness.spacing},
          {"speed", r.likeness.speed},
          {"evaluations", r.search.evaluations},
          {"simulations", r.search.simulations},
          {"failed_simulations", r.search.failed_simulations},
          {"failed_final", r.runs.failed_final},
          {"stop_reason", r.search.stop_reason},
          {"n_sub", r.runs.steps},
          {"map", r.runs.map},
          {"steps_settled", r.runs.steps_settled},
          {"infeasible_avoidance", r.runs.infeasible_avoidance},
          {"convergence", convergence(r.search.convergence)}};
}

// Settings are TOML values; strings, numbers and lists of them are JSON as well.
Json config(const std::vector<std::pair<std::string, std::string>>& settings) {
  Json out = Json::object();
  for (const auto& [key, value] : settings) {
    Json parsed = Json::parse(value, nullptr, false);
    out[key] = parsed.is_discarded() ? Json(value) : std::move(parsed);
  }
  return out;
}

}  // namespace

std::string to_json(const Comparison& c) {
  Json models = Json::array();
  for (const ModelFit& r : c.models) {
    models.push_back(model(c.recording.columns, r));
    if (c.recording.hold_out.used) models.back()["held_out"] = held_out(c.recording.columns, r);
    if (r.posterior.simulations > 0) models.back()["posterior"] = posterior(r.posterior);
    add_skill(models.back(), r, c);
  }
  Json full = {{"schema", "swarmfit-results/1"},
               {"version", c.run.version},
               {"command", c.run.command},
               {"seed", c.run.seed},
               {"protocol", c.run.protocol},
               {"common_parameters", c.run.common},
               {"budget",
                {{"name", c.run.budget.name},
                 {"search", search_size(c.run.budget.search)},
                 {"scout", {{"rounds", c.run.budget.scout.rounds}, {"simulations", c.run.budget.scout.simulations}}},
                 {"selection", search_size(c.run.budget.selection)},
                 {"confirmation_replicates", c.run.budget.confirmation_replicates},
                 {"final_replicates", c.run.budget.final_replicates},
                 {"passes", c.run.budget.passes}}},
               {"presence", c.recording.observation.presence},
               {"arena", c.recording.observation.arena},
               {"unseen_individuals", c.recording.observation.unseen},
               {"data", data(c.recording.data)},
               {"observation", observation(c.recording.columns, c.recording.observation)},
               {"binning", binning(c)},
               {"recording",
                {{"samples", samples(c.recording.columns, c.recording.distributions)},
                 {"mean", means(c.recording.columns, c.recording.distributions)},
                 {"sd", sds(c.recording.columns, c.recording.distributions)}}},
               {"lags", lags(c)},
               {"weights", per_column(c.recording.columns, c.ranking.weights)},
               {"p1", per_column(c.recording.columns, c.ranking.p1)},
               {"p2", per_column(c.recording.columns, c.ranking.p2)},
               {"resolution", per_column(c.recording.columns, c.recording.resolution)},
               {"laws", c.ranking.laws},
               {"hold_out", hold_out(c.recording.hold_out)},
               {"weights_converged", c.ranking.weights_converged},
               {"calibration", c.ranking.mean_weights ? "mean" : "last"},
               {"weight_history", weight_history(c.recording.columns, c.ranking.weight_history)},
               {"models", std::move(models)},
               {"warnings", c.warnings},
               {"config", config(c.run.config)}};
  add_skill(full, c);
  return text(full);
}

}  // namespace swarmfit
