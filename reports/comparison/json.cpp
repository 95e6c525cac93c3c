// SPDX-License-Identifier: MIT
// The document of a comparison or a fit.
#include "reports/comparison/json.h"

#include <nlohmann/json.hpp>

#include "reports/comparison/quantities.h"
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
          {"error_dominated", per_column(columns, o.error_dominated)},
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
    if (std::isfinite(p.halves_lower)) one["halves"] = {p.halves_lower, p.halves_upper};
    if (std::isfinite(p.likelihood.value)) one["likelihood"] = {p.likelihood.value, p.likelihood.lower, p.likelihood.upper};
    if (std::isfinite(p.regression.value)) one["regression"] = {p.regression.value, p.regression.lower, p.regression.upper};
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

// Sets "a.b" as key b of the object a.
void put(Json& object, std::string_view key, Json value) {
  const auto dot = key.find('.');
  Json& in = dot == key.npos ? object : object[std::string(key.substr(0, dot))];
  in[std::string(dot == key.npos ? key : key.substr(dot + 1))] = std::move(value);
}

Json json_of(const Value& value) {
  return std::visit(
      [](const auto& v) -> Json {
        using T = std::decay_t<decltype(v)>;
        if constexpr (std::is_same_v<T, std::optional<int>>) return v ? Json(*v) : Json();
        if constexpr (std::is_same_v<T, IntervalEnds>) return {v.first, v.second};
        if constexpr (!std::is_same_v<T, std::optional<int>> && !std::is_same_v<T, IntervalEnds>) return v;
      },
      value);
}

Json hold_out(const HoldOutFacts& h) {
  if (!h.used()) return {};
  Json ways = Json::array();
  for (const HeldOutWay& w : h.ways)
    ways.push_back({{"fitted", {w.fitted_first, w.fitted_last}},
                    {"held_out", {w.held_first, w.held_last}},
                    {"lags", lags_of(w.columns)},
                    {"weights", per_column(w.columns, w.weights)}});
  return {{"warm_up", h.warm_up}, {"searches", h.searches}, {"ways", std::move(ways)}};
}

Json posterior(const PosteriorFacts& p) {
  return {{"effective_sample_size", p.effective}, {"points", p.sample.size()}, {"simulations", p.simulations}, {"diverged", p.blew_up}};
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

Json model(const Comparison& c, const ModelFit& r) {
  const Columns& columns = c.recording.columns;
  Json out = {{"name", r.model}};
  for (const Quantity& q : quantities())
    if (known(q, c)) put(out, q.key, json_of(q.of(r)));
  for (const ColumnQuantity& q : column_quantities()) put(out, q.key, per_column(columns, q.of(r)));
  if (c.recording.hold_out.used()) out["held_out"]["scores"] = r.standing.held_out.scores;
  Json replicates = Json::array();
  for (const Energies& e : r.runs.replicate_energies) replicates.push_back(per_column(columns, e));
  out["replicate_energies"] = std::move(replicates);
  out["parameters"] = parameters(r.parameters);
  out["at_bounds"] = names(r.parameters, [](const ParameterResult& p) { return p.at_bound; });
  out["options"] = r.options;
  out["summary"] = r.summary;
  out["citation"] = r.citation;
  out["samples"] = samples(columns, r.runs.distributions);
  out["convergence"] = convergence(r.search.convergence);
  if (std::isfinite(r.likelihood.log_likelihood))
    out["likelihood"] = {{"log_likelihood", r.likelihood.log_likelihood}, {"measurement_error", r.likelihood.error}};
  if (r.regression.rows > 0) out["regression"] = {{"accelerations", r.regression.rows}, {"memory", r.regression.memory}};
  if (r.posterior.simulations > 0) out["posterior"] = posterior(r.posterior);
  return out;
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
    models.push_back(model(c, r));
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
               {"bootstrap_recordings", c.ranking.bootstrap_recordings},
               {"hold_out", hold_out(c.recording.hold_out)},
               {"weights_converged", c.ranking.weights_converged},
               {"calibration", c.ranking.mean_weights ? "mean" : "last"},
               {"weight_history", weight_history(c.recording.columns, c.ranking.weight_history)},
               {"models", std::move(models)},
               {"warnings", std::vector<std::string>(c.warnings.begin(), c.warnings.end())},
               {"config", config(c.run.config)}};
  add_skill(full, c);
  return text(full);
}

}  // namespace swarmfit
