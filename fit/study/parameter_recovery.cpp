// SPDX-License-Identifier: MIT
#include "fit/study/parameter_recovery.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "fit/compare/facts.h"
#include "fit/experiment/time_step.h"
#include "fit/infer/posterior_ranks.h"
#include "fit/model_fit/parameter_posterior.h"
#include "fit/store/checkpointed.h"
#include "libtrack/distributions.h"
#include "libtrack/error.h"
#include "libtrack/nan.h"

namespace swarmfit {
namespace {

constexpr double kMiddle = 0.9;  // share of each axis from which true values are drawn
constexpr int kMostTries = 10;   // per recording

bool reachable(const SearchSpace& space, const std::vector<double>& truth) {
  const auto back = space.parameters(space.point(truth));
  return std::all_of(space.searched().begin(), space.searched().end(),
                     [&](std::size_t p) { return std::abs(back[p] - truth[p]) <= 1e-9 * std::abs(truth[p]); });
}

// A true value on the axes of the planted swarms, of which `u`, uniform on 0 .. 1, is drawn; the middle nine tenths hold all of them.
double middle(double u) { return 0.5 + kMiddle * (u - 0.5); }
bool in_middle(const Point& x) { return (x.array() - 0.5).abs().maxCoeff() <= kMiddle / 2; }

// A uniform prior remains one on a part of the cube: what of the sample lies where true values are drawn from is a sample of the posterior
// under that prior.
WeightedSample under_drawn_prior(const SearchSpace& drawn, const SearchSpace& space, const Posterior& posterior) {
  WeightedSample out;
  for (std::size_t k = 0; k < posterior.sample.size(); ++k)
    if (Point x = drawn.point(space.parameters(posterior.sample[k])); in_middle(x)) {
      out.points.push_back(std::move(x));
      out.weights.push_back(posterior.weight[k]);
    }
  return out;
}

void add_ranks(ParameterCase& out, const SearchSpace& drawn, const SearchSpace& space, const std::vector<double>& truth,
               const Posterior& posterior) {
  const WeightedSample sample = under_drawn_prior(drawn, space, posterior);
  const Point at = drawn.point(truth);
  Point reference(at.size());
  for (Eigen::Index a = 0; a < at.size(); ++a) {
    out.rank.push_back(rank_of(sample, a, at[a]));
    reference[a] = middle(Rng{out.seed}.uniform(Stream::probe, 1, static_cast<std::uint32_t>(a)));
  }
  out.nearer = nearer_than(sample, reference, at);
}

// Nothing if this recording carries no fit, or its fit would not search where the truth lies: bounds are in the recording's scales.
std::optional<ParameterCase> one_case(const RecoveryOptions& options, const CompareOptions& compare, const std::vector<double>& truth,
                                      std::uint64_t seed, const Runtime& runtime) {
  const ModelChoice& model = options.planted.front();
  const Tracks recording = planted_recording(model, truth, options.film, options.scales, seed);
  Conditions conditions;
  try {
    conditions = make_conditions(recording, compare.conditions);
    conditions.metrics.lags = lags_for(conditions, compare);
  } catch (const InputError&) {
    return {};
  }
  const SearchSpace space(model, conditions.scales, compare.requests);
  if (!reachable(space, truth)) return {};
  const Target target(recorded_samples(conditions.recording, conditions.metrics), compare.binning);
  Objective objective(model, conditions, target, runtime);
  if (compare.conditions.steps == 0 && !model.spec->is_map(model.options)) {
    const auto few = replicate_seeds({seed}, Stream::selection, compare.budget.selection.replicates);
    const auto more = replicate_seeds({seed}, Stream::confirmation, compare.budget.confirmation_replicates);
    settle_steps(objective, target, {truth}, {few, more}, objective.ensemble().stable_steps());
  }
  const auto found = posterior_of(space, objective, Rng{seed}.derive(Stream::posterior, 0));
  ParameterCase out{seed, {}, found.parameters, {}, {}, {}, {}, kNaN};
  const Point place = space.point(truth);
  for (std::size_t k = 0; k < space.searched().size(); ++k) {
    const Marginal& m = found.posterior.marginals[k];
    out.truth.push_back(truth[space.searched()[k]]);
    out.truth_place.push_back(place[static_cast<Eigen::Index>(k)]);
    out.median_place.push_back(m.median);
    out.width.push_back(m.upper - m.lower);
  }
  add_ranks(out, SearchSpace(model, options.scales, compare.requests), space, truth, found.posterior);
  return out;
}

ParameterCoverage coverage(const std::vector<ParameterCase>& cases, std::size_t k, const Parameter& row, const std::string& length_unit) {
  ParameterCoverage out;
  out.unit = to_string(row.unit, length_unit);
  out.scale = scale_of(row.log, row.fit.lower);
  for (const ParameterCase& c : cases) {
    const ParameterInterval& found = c.found[k];
    out.name = found.name;
    ++out.recordings;
    out.covered += found.lower <= c.truth[k] && c.truth[k] <= found.upper;
    out.identified += found.verdict == Identifiability::identified;
    out.one_sided += found.verdict == Identifiability::one_sided;
    out.flat += found.verdict == Identifiability::flat;
    const double error = c.median_place[k] - c.truth_place[k];
    out.bias += error;
    out.rmse += error * error;
    out.width += c.width[k];
  }
  out.bias /= out.recordings;
  out.rmse = std::sqrt(out.rmse / out.recordings);
  out.width /= out.recordings;
  std::vector<double> ranks;
  for (const ParameterCase& c : cases) ranks.push_back(c.rank[k]);
  out.from_uniform = distance_from_uniform(ranks);
  return out;
}

}  // namespace

std::pair<int, int> coverage_band(int n, int tests) { return binomial_band(n, 0.95, 0.005 / tests); }

ParameterRecovery recover_parameters(const RecoveryOptions& options, const OnParameterCase& on_case, const Runtime& runtime,
                                     const Part& part) {
  const ModelChoice& model = options.planted.front();
  const CompareOptions compare = with_shared_constants(options.compare, options.scales);
  const SearchSpace prior(model, options.scales, compare.requests);
  ParameterRecovery out;
  out.model = model.name;
  for (std::uint64_t seed = options.compare.seed; static_cast<int>(out.cases.size()) < options.seeds; ++seed) {
    const std::uint64_t number = seed - options.compare.seed;
    if (part.of > 1 && number == static_cast<std::uint64_t>(options.seeds)) break;
    if (!part.has(number)) continue;
    Point x(prior.dimensions());
    for (Eigen::Index a = 0; a < x.size(); ++a) x[a] = middle(Rng{seed}.uniform(Stream::probe, 0, static_cast<std::uint32_t>(a)));
    if (auto one = checkpointed<ParameterCase>(runtime.checkpoint, fmt::format("case {}", seed),
                                               [&] { return one_case(options, compare, prior.parameters(x), seed, {runtime.executor}); }))
      out.cases.push_back(std::move(*one));
    else if (++out.left_out > kMostTries * options.seeds)
      break;
    if (on_case) on_case(out.cases.size());
  }
  for (std::size_t k = 0; !out.cases.empty() && k < prior.searched().size(); ++k)
    out.parameters.push_back(coverage(out.cases, k, model.spec->parameters[prior.searched()[k]], options.film.unit));
  std::vector<double> nearer;
  for (const ParameterCase& c : out.cases) nearer.push_back(c.nearer);
  out.from_uniform = distance_from_uniform(nearer);
  if (!out.cases.empty()) out.uniform_band = uniform_band(out.cases.size(), out.parameters.size() + 1);
  const int tests = std::max<int>(1, static_cast<int>(out.parameters.size()));
  std::tie(out.fewest, out.most) = coverage_band(static_cast<int>(out.cases.size()), tests);
  return out;
}

}  // namespace swarmfit
