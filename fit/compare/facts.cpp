// SPDX-License-Identifier: MIT
#include "fit/compare/facts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "fit/compare/warn.h"
#include "libeval/independent.h"
#include "libeval/lags.h"
#include "libeval/skill.h"
#include "libtrack/nan.h"

namespace swarmfit {
namespace {

constexpr double kScaleOff = 2;        // a mean off by more than this factor is called wrong in scale
constexpr double kInfeasible = 0.05;   // share of agent-steps without a collision-free velocity worth a warning
constexpr double kFewIndividuals = 5;  // neighbour statistics of smaller groups say little
constexpr double kSmallChange = 0.02;  // of a weight, that hardly moves a score

std::string name_of(ConditionOptions::Error e) {
  return e == ConditionOptions::Error::estimate ? "estimate" : e == ConditionOptions::Error::given ? "given" : "none";
}

void warn_of_data(const Comparison& r, std::vector<Warning>& out) {
  if (r.recording.data.individuals_per_frame < kFewIndividuals)
    warn(out, Gravity::meaning, "Only {:.1f} individuals per frame: neighbour distances in so small a group say little about interaction.",
         r.recording.data.individuals_per_frame);
  if (!r.recording.observation.white && r.recording.observation.error_source == "estimate")
    warn(
        out, Gravity::meaning,
        "Measurement error could not be estimated separately from motion: it is not independent from frame to frame, because the positions "
        "were smoothed or the motion is rough. Simulations have no error added; if you know the error, give it with --obs-noise.");
}

// Is the longest lag still too short?
void warn_of_lags(const Comparison& r, std::vector<Warning>& out) {
  const int lag = lags_of(r.recording.columns).back();
  std::vector<std::string> error_dominated;
  for (std::size_t j = 0; j < r.recording.columns.size(); ++j)
    if (r.recording.columns[j].motion() && r.recording.columns[j].lag == lag && r.recording.defined[j] &&
        r.recording.observation.error_dominated[j])
      error_dominated.push_back(r.recording.columns[j].key());
  if (error_dominated.empty()) return;
  const bool longer = lag < r.recording.observation.longest_lag;
  warn(out, Gravity::meaning, "{} {} mostly measurement error even at the longest lag ({}); {}.", fmt::join(error_dominated, ", "),
       error_dominated.size() > 1 ? "are" : "is", lag,
       longer ? fmt::format("a longer lag, up to {}, may show motion: --lags", r.recording.observation.longest_lag)
              : "the tracks are too short for a longer lag");
}

// Names the column that changes most.
void warn_of_step(const ModelFit& m, const Comparison& r, std::vector<Warning>& out) {
  if (m.runs.steps_settled) return;
  const auto change = [&](std::size_t j) {
    return r.recording.defined[j] ? std::abs(m.runs.half_step_energies[j] - m.runs.raw_energies[j]) : 0;
  };
  std::size_t most = 0;
  for (std::size_t j = 1; j < r.recording.columns.size(); ++j)
    if (change(j) > change(most)) most = j;
  warn(out, Gravity::result,
       "{}: integration has not converged with {} per frame. Halving the time step changes the energy of {} ({:.3g} → {:.3g}), so "
       "parameters and rank depend on the step; --steps sets more.",
       m.model, m.runs.steps == 1 ? "one step" : fmt::format("{} steps", m.runs.steps), r.recording.columns[most].symbol(),
       m.runs.raw_energies[most], m.runs.half_step_energies[most]);
}

void warn_of_fit(const ModelFit& m, const Comparison& r, std::vector<Warning>& out) {
  std::vector<std::string> bounds;
  for (const auto& p : m.parameters)
    if (p.at_bound) bounds.push_back(p.name);
  if (!bounds.empty())
    warn(out, Gravity::result, "{}: {} ended on a bound of the search; widening the bounds (--bounds) might change its rank.", m.model,
         fmt::join(bounds, ", "));
  for (const auto& p : m.parameters)
    if (!p.at_lower.empty()) warn(out, Gravity::note, "{}: {} ended on its lower bound: {}.", m.model, p.name, p.at_lower);
  for (const std::size_t j : {kSpeed, kDistance})
    if (const double ratio = m.runs.mean_ratio[j]; std::isfinite(ratio) && (ratio > kScaleOff || ratio < 1 / kScaleOff))
      warn(out, Gravity::result, "{}: wrong scale: the mean {} is {:.2g} times the recorded one.", m.model, r.recording.columns[j].name(),
           ratio);
  if (m.runs.failed_final > 0)
    warn(out, Gravity::result, "{}: {:.0f} % of the final simulations diverged and count with the worst energy.", m.model,
         100 * m.runs.failed_final);
  if (m.runs.infeasible_avoidance > kInfeasible)
    warn(out, Gravity::meaning, "{}: no collision-free velocity existed in {:.0f} % of all agent-steps.", m.model,
         100 * m.runs.infeasible_avoidance);
  warn_of_step(m, r, out);
}

std::string_view without_settings(std::string_view model) { return model.substr(0, model.find('[')); }

// Is `part` what `whole` is with a strength at zero? It then searches some of the same parameters, and of the rest one may be zero.
bool is_part(const ModelFit& part, const ModelFit& whole) {
  if (without_settings(part.model) != without_settings(whole.model)) return false;
  const auto searched = [](const ModelFit& fit, const std::string& name) {
    return std::any_of(fit.parameters.begin(), fit.parameters.end(), [&](const auto& p) { return p.fitted && p.name == name; });
  };
  return std::all_of(part.parameters.begin(), part.parameters.end(), [&](const auto& p) { return !p.fitted || searched(whole, p.name); }) &&
         std::any_of(whole.parameters.begin(), whole.parameters.end(),
                     [&](const auto& p) { return p.fitted && p.lower == 0 && !searched(part, p.name); });
}

void warn_of_parts(const ModelFit& whole, const Comparison& r, std::vector<Warning>& out) {
  for (const ModelFit& part : r.models)
    if (is_part(part, whole) && part.standing.in_sample.score - whole.standing.in_sample.score >
                                    kStandardErrors * std::hypot(part.standing.in_sample.score_se, whole.standing.in_sample.score_se))
      warn(out, Gravity::result,
           "{} contains {} as a special case, but scores lower: its search is incomplete, and a larger --budget may change its rank.",
           whole.model, part.model);
}

// Parameters whose best value lies outside their interval of this kind.
template <class Interval>
std::vector<std::string> outside(const ModelFit& fit, Interval ParameterResult::*interval) {
  std::vector<std::string> out;
  for (const ParameterResult& p : fit.parameters)
    if (p.value < (p.*interval).lower || p.value > (p.*interval).upper) out.push_back(p.name);
  return out;
}

// The search sees histograms, the posterior means and correlations besides: where they disagree, no parameters are right for both.
void warn_of_posterior(const ModelFit& fit, std::vector<Warning>& out) {
  const std::vector<std::string> apart = outside(fit, &ParameterResult::posterior);
  const bool several = apart.size() > 1;
  if (!apart.empty())
    warn(out, Gravity::meaning,
         "{}: the best {} {} outside {} 95 % interval{}. No single value fits both distributions and correlations; the model may "
         "be wrong or the search incomplete. Do not report either.",
         fit.model, fmt::join(apart, ", "), several ? "lie" : "lies", several ? "their" : "its", several ? "s" : "");
}

// Two ways to the same parameters: one by what recordings look like, one by what accelerations depend on.
void warn_of_regression(const ModelFit& fit, std::vector<Warning>& out) {
  const std::vector<std::string> apart = outside(fit, &ParameterResult::regression);
  if (!apart.empty())
    warn(out, Gravity::note,
         "{}: search and regression of accelerations disagree about {}: the best {} outside the 95 % interval of the regression.",
         fit.model, fmt::join(apart, ", "), apart.size() > 1 ? "values lie" : "value lies");
}

}  // namespace

PerColumn<double> resolution(const Conditions& c, const Target& target, const CompareOptions& options,
                             const PerColumn<bool>& error_dominated) {
  PerColumn<double> out(target.columns().size(), 0.0);
  if (std::find(error_dominated.begin(), error_dominated.end(), true) != error_dominated.end()) {
    const MetricSamples again = metric_samples(with_error(c.recording, c.sigma, options.seed), c.metrics);
    const Energies changed = target.energies(target.distributions(again));
    for (std::size_t j = 0; j < out.size(); ++j)
      if (error_dominated[j] && std::isfinite(changed[j])) out[j] = changed[j];
  }
  if (!options.resolution) return out;
  const HalfDistance halves(c.recording, c.metrics);
  for (std::size_t j = 0; j < out.size(); ++j)
    if (const double distance = halves.floor()[j]; std::isfinite(distance)) out[j] = std::max(out[j], 0.5 * distance * target.worst());
  return out;
}

ObservationFacts observation_facts(const Conditions& c, const Target& target, const CompareOptions& options) {
  ObservationFacts facts;
  facts.presence = c.options.presence == ConditionOptions::Presence::recorded ? "recorded" : "constant";
  facts.arena = c.options.world.path.empty() ? c.options.arena : "as " + c.options.world.path + " says";
  facts.unseen = c.unseen;
  facts.error_source = name_of(c.options.error);
  facts.sigma = c.sigma;
  facts.white = c.localisation.white || c.localisation.rounding;
  facts.rounding = c.grid.step;
  facts.smoothing = c.options.smoothing;
  facts.velocity = c.options.velocity == VelocitySource::difference ? "difference" : "recorded";
  facts.independent = independent_samples(c.recording, c.metrics);
  facts.error_share = error_share(c.recording, measurement_error(c), options.seed, c.metrics.lags);
  facts.longest_lag = longest_lag(c.recording);
  const std::size_t columns = target.columns().size();
  facts.error_dominated = facts.used = PerColumn<bool>(columns);
  facts.why_not = PerColumn<std::string>(columns);
  for (std::size_t j = 0; j < columns; ++j) {
    facts.error_dominated[j] = facts.error_share[j] > options.error_limit;
    facts.used[j] = target.defined(j);
    if (!facts.used[j]) facts.why_not[j] = "it is constant or undefined in the recording";
  }
  return facts;
}

DataFacts data_facts(const Tracks& recording, const Scales& scales) {
  const auto& meta = recording.meta();
  DataFacts d;
  d.path = meta.from.path;
  d.sha256 = meta.from.sha256;
  d.format = meta.from.format;
  d.columns = meta.from.columns;
  d.unit = meta.unit;
  d.synthetic = meta.from.synthetic;
  d.dims = meta.dims;
  d.dt = meta.dt;
  d.rows = recording.rows();
  d.frames = recording.frames().size();
  for (std::uint32_t t = 0; t < recording.track_count(); ++t) d.tracks += !recording.rows_of(t).empty();
  d.first_frame = recording.frames().front().number;
  d.last_frame = recording.frames().back().number;
  d.individuals_per_frame = static_cast<double>(d.rows) / static_cast<double>(d.frames);
  d.extent = scales.extent;
  d.spacing = scales.spacing;
  d.speed = scales.speed;
  d.notes = meta.from.notes;
  return d;
}

RecordingFacts measured_facts(const Target& target) {
  RecordingFacts r;
  r.binning = target.binning();
  r.distributions = target.recording();
  r.columns = target.columns();
  const std::size_t columns = r.columns.size();
  r.defined = PerColumn<bool>(columns);
  r.axis_lower = r.axis_width = PerColumn<double>(columns);
  for (std::size_t j = 0; j < columns; ++j) {
    r.defined[j] = target.defined(j);
    r.axis_lower[j] = target.axis(j).lower;
    r.axis_width[j] = target.axis(j).width;
  }
  return r;
}

std::vector<int> lags_for(const Conditions& c, const CompareOptions& options) {
  require_lags(c.recording, options.lags);
  if (!options.lags.empty()) return options.lags;
  if (c.options.velocity == VelocitySource::recorded) return {1};
  return choose_lags(c.recording, measurement_error(c), options.error_limit, options.seed);
}

std::vector<LagFacts> lag_facts(const RecordingFacts& r, const PerColumn<double>& weights) {
  std::vector<LagFacts> out;
  for (const int lag : lags_of(r.columns)) out.push_back({lag, 0, 0, kNaN});
  out.push_back({0, 0, 0, kNaN});
  for (std::size_t j = 0; j < r.columns.size(); ++j) {
    const int lag = r.columns[j].motion() ? r.columns[j].lag : 0;
    LagFacts& of = *std::find_if(out.begin(), out.end(), [lag](const LagFacts& f) { return f.lag == lag; });
    of.error_share = std::fmax(of.error_share, r.observation.error_share[j]);
    if (!r.observation.used[j]) continue;
    ++of.scored;
    of.weight += weights[j];
  }
  return out;
}

std::vector<Warning> warnings_for(const Comparison& r) {
  std::vector<Warning> out;
  if (!r.run.common.empty())
    warn(out, Gravity::meaning,
         "{} were fitted with {} alone and kept for all models; the others might score higher with dynamics of their own.",
         fmt::join(r.run.common, ", "), r.run.named.front());
  if (r.recording.data.synthetic) warn(out, Gravity::note, "This recording is synthetic: a simulator made it.");
  warn_of_data(r, out);
  warn_of_lags(r, out);
  if (r.models.size() == 2)
    warn(out, Gravity::meaning,
         "With two models the entropy weights only count which model is closer in each metric; read the raw energies beside the score.");
  std::vector<std::string> within;
  for (std::size_t j = 0; j < r.recording.columns.size(); ++j)
    if (r.models.size() > 1 && r.ranking.weights[j] > 0 && r.recording.resolution[j] > 0 && r.ranking.p2[j] <= r.recording.resolution[j])
      within.push_back(fmt::format("{} ({})", r.recording.columns[j].name(), r.recording.columns[j].symbol()));
  if (!within.empty())
    warn(out, Gravity::note, "Model differences in {} are within sampling noise and were down-weighted.", fmt::join(within, ", "));
  if (r.models.size() > 1 && !r.ranking.weights_converged)
    warn(out, r.ranking.weight_history.back().largest_change > kSmallChange ? Gravity::result : Gravity::note,
         "The weights had not converged after {} passes (last change {:.3f}); a larger --budget may change the scores.",
         r.ranking.weight_history.size(), r.ranking.weight_history.back().largest_change);
  for (const auto& model : r.models) {
    warn_of_fit(model, r, out);
    warn_of_parts(model, r, out);
    warn_of_posterior(model, out);
    warn_of_regression(model, out);
  }
  return out;
}

}  // namespace swarmfit
