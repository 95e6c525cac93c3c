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
  for (const LagFacts& l : c.lags) {
    const bool none = l.lag == 0;
    out.push_back({{"lag", none ? Json() : Json(l.lag)},
                   {"seconds", none ? Json() : Json(l.lag * c.data.dt)},
                   {"scored", l.scored},
                   {"weight", l.weight},
                   {"error_share", l.error_share}});
  }
  return out;
}

Json binning(const Comparison& c) {
  return {{"normalisation", name(c.binning.normalisation)},
          {"interval", {c.binning.lower, c.binning.upper}},
          {"bins", c.binning.bins},
          {"clip", c.binning.clip},
          {"scoring", c.binning.pooled ? "pooled" : "proper"},
          {"axis_lower", per_column(c.columns, c.axis_lower)},
          {"axis_width", per_column(c.columns, c.axis_width)},
          {"defined", per_column(c.columns, c.defined)}};
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

Json nearness(const Nearness& n) {
  return {{"simulated", n.simulated}, {"recorded", n.recorded}, {"ratio", n.simulated / n.recorded}, {"frames", n.frames}};
}

Json held_out(const Columns& columns, const FitResult& r) {
  const Certainty& c = r.held_out.certainty;
  return {{"score", r.held_out.score},
          {"gap", r.score - r.held_out.score},
          {"score_ci", {c.lower, c.upper}},
          {"lead_ci", {c.lead_lower, c.lead_upper}},
          {"group", c.group > 0 ? Json(c.group) : Json()},
          {"set_p", c.set_p},
          {"raw_energies", per_column(columns, r.held_out.raw)},
          {"own_energies", per_column(columns, c.own)},
          {"nearness", nearness(r.held_out.nearness)}};
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

Json model(const Columns& columns, const FitResult& r) {
  Json replicates = Json::array();
  for (const Energies& e : r.replicate_energies) replicates.push_back(per_column(columns, e));
  return {{"name", r.model},
          {"rank", r.rank > 0 ? Json(r.rank) : Json()},
          {"score", r.score},
          {"score_se", r.score_se},
          {"score_ci", {r.certainty.lower, r.certainty.upper}},
          {"lead_ci", {r.certainty.lead_lower, r.certainty.lead_upper}},
          {"group", r.certainty.group > 0 ? Json(r.certainty.group) : Json()},
          {"set_p", r.certainty.set_p},
          {"gof_p", r.certainty.goodness_p},
          {"own_energies", per_column(columns, r.certainty.own)},
          {"raw_energies", per_column(columns, r.raw_energies)},
          {"raw_energies_se", per_column(columns, r.raw_se)},
          {"energies", per_column(columns, r.energies)},
          {"half_step_energies", per_column(columns, r.half_step_energies)},
          {"replicate_energies", std::move(replicates)},
          {"parameters", parameters(r.parameters)},
          {"n_parameters", names(r.parameters, [](const ParameterResult& p) { return p.fitted; }).size()},
          {"at_bounds", names(r.parameters, [](const ParameterResult& p) { return p.at_bound; })},
          {"options", r.options},
          {"summary", r.summary},
          {"citation", r.citation},
          {"mean_ratio", per_column(columns, r.mean_ratio)},
          {"sd_ratio", per_column(columns, r.sd_ratio)},
          {"outside_fraction", per_column(columns, r.outside_fraction)},
          {"samples", samples(columns, r.distributions)},
          {"extent", r.extent},
          {"spacing", r.spacing},
          {"speed", r.speed},
          {"evaluations", r.evaluations},
          {"simulations", r.simulations},
          {"failed_simulations", r.failed_simulations},
          {"failed_final", r.failed_final},
          {"stop_reason", r.stop_reason},
          {"n_sub", r.steps},
          {"map", r.map},
          {"steps_settled", r.steps_settled},
          {"infeasible_avoidance", r.infeasible_avoidance},
          {"convergence", convergence(r.convergence)}};
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
  for (const FitResult& r : c.models) {
    models.push_back(model(c.columns, r));
    if (c.hold_out.used) models.back()["held_out"] = held_out(c.columns, r);
    if (r.posterior.simulations > 0) models.back()["posterior"] = posterior(r.posterior);
    add_skill(models.back(), r, c);
  }
  Json full = {
      {"schema", "swarmfit-results/1"},
      {"version", c.version},
      {"command", c.command},
      {"seed", c.seed},
      {"protocol", c.protocol},
      {"common_parameters", c.common},
      {"budget",
       {{"name", c.budget.name},
        {"search", search_size(c.budget.search)},
        {"scout", {{"rounds", c.budget.scout.rounds}, {"simulations", c.budget.scout.simulations}}},
        {"selection", search_size(c.budget.selection)},
        {"confirmation_replicates", c.budget.confirmation_replicates},
        {"final_replicates", c.budget.final_replicates},
        {"passes", c.budget.passes}}},
      {"presence", c.observation.presence},
      {"arena", c.observation.arena},
      {"unseen_individuals", c.observation.unseen},
      {"data", data(c.data)},
      {"observation", observation(c.columns, c.observation)},
      {"binning", binning(c)},
      {"recording",
       {{"samples", samples(c.columns, c.recording)}, {"mean", means(c.columns, c.recording)}, {"sd", sds(c.columns, c.recording)}}},
      {"lags", lags(c)},
      {"weights", per_column(c.columns, c.weights)},
      {"p1", per_column(c.columns, c.p1)},
      {"p2", per_column(c.columns, c.p2)},
      {"resolution", per_column(c.columns, c.resolution)},
      {"laws", c.laws},
      {"hold_out", hold_out(c.hold_out)},
      {"weights_converged", c.weights_converged},
      {"calibration", c.mean_weights ? "mean" : "last"},
      {"weight_history", weight_history(c.columns, c.weight_history)},
      {"models", std::move(models)},
      {"warnings", c.warnings},
      {"config", config(c.config)}};
  add_skill(full, c);
  return text(full);
}

}  // namespace swarmfit
