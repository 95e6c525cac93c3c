// SPDX-License-Identifier: MIT
#include "fit/model_fit/parameter_posterior.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/experiment/run_features.h"
#include "fit/model_fit/feature_runs.h"
#include "libtrack/cut.h"

namespace swarmfit {
namespace {

constexpr double kAtMost = 1.0 / 3;  // of the recording's frames
constexpr double kTouches = 0.05;    // of the interval's length: nearer to a bound, its end says nothing

}  // namespace

Identifiability verdict_in_units(const ParameterInterval& p, double least, double most) {
  const bool touches = std::min(p.lower - least, most - p.upper) < kTouches * (p.upper - p.lower);
  return p.verdict == Identifiability::identified && touches ? Identifiability::one_sided : p.verdict;
}

std::int64_t settling_frames(const Conditions& conditions) {
  const auto wanted = static_cast<std::int64_t>(std::ceil(conditions.scales.time() / conditions.recording.dt()));
  return std::min(wanted, static_cast<std::int64_t>(kAtMost * static_cast<double>(conditions.frames)));
}

ParameterPosterior posterior_of(const SearchSpace& space, const Objective& objective, const Rng& rng, const PosteriorOptions& options) {
  const Conditions& conditions = objective.ensemble().conditions();
  const RunFeatures features(conditions, objective.target());
  const std::int64_t start = conditions.first_frame + settling_frames(conditions);
  const Features settled = [&](const Tracks& tracks) { return features(cut(tracks, start, std::numeric_limits<std::int64_t>::max())); };
  const Simulator run = feature_runs(space, objective.ensemble(), "posterior", settled);
  ParameterPosterior out{posterior(settled(conditions.recording), space.dimensions(), run, rng, options), {}};
  const auto& marginals = out.posterior.marginals;
  Point lower(space.dimensions()), median = lower, upper = lower;
  for (std::size_t k = 0; k < marginals.size(); ++k) {
    const auto a = static_cast<Index>(k);
    lower[a] = marginals[k].lower, median[a] = marginals[k].median, upper[a] = marginals[k].upper;
  }
  const auto least = space.parameters(Point::Zero(space.dimensions())), most = space.parameters(Point::Ones(space.dimensions()));
  const auto low = space.parameters(lower), middle = space.parameters(median), high = space.parameters(upper);
  const auto name = [&](std::size_t k) { return std::string(space.model().spec->parameters[space.searched()[k]].name); };
  for (std::size_t k = 0; k < marginals.size(); ++k) {
    const Marginal& m = marginals[k];
    const std::size_t row = space.searched()[k];
    out.parameters.push_back({row, name(k), middle[row], low[row], high[row], m.contraction, m.verdict,
                              m.partner < 0 ? "" : name(static_cast<std::size_t>(m.partner)), m.correlation});
    out.parameters.back().verdict = verdict_in_units(out.parameters.back(), least[row], most[row]);
  }
  return out;
}

}  // namespace swarmfit
