// SPDX-License-Identifier: MIT
#include "fit/compare/hold_out.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/model_fit/race.h"
#include "libeval/nearness.h"
#include "libtrack/cut.h"
#include "libtrack/error.h"

namespace swarmfit {
namespace {

constexpr std::int64_t kFewest = 32;                           // frames of a half
constexpr std::int64_t kShortestPath = 2, kLongestPath = 100;  // frames

// Paths are as long as motion takes to become new, if there are unbroken ones so long, else shorter.
std::int64_t path_frames(const Halves& halves) {
  auto frames = static_cast<std::int64_t>(std::lround(natural_scales(halves.fitted).time() / halves.fitted.dt()));
  frames = std::clamp<std::int64_t>(frames, kShortestPath, kLongestPath);
  while (frames > kShortestPath && !std::isfinite(distance_to_nearest(halves.held_out, halves.fitted, frames))) frames /= 2;
  return std::max(frames, kShortestPath);
}

const ModelChoice& choice_of(const CompareOptions& options, const std::string& name) {
  return *std::find_if(options.models.begin(), options.models.end(), [&](const ModelChoice& m) { return m.name == name; });
}

}  // namespace

Halves halves(const Tracks& recording) {
  const std::int64_t first = recording.frames().front().number, frames = recording.frames().back().number + 1 - first;
  const double memory = std::max(natural_scales(recording).time(), correlation_time(recording));
  const auto apart = static_cast<std::int64_t>(std::ceil(memory / recording.dt()));
  const std::int64_t half = (frames - apart) / 2;
  if (half < kFewest)
    throw InputError(
        fmt::format("`holdout`: {} frames are too few; expected at least {}, two halves of {} with the time after which motion is new, {} "
                    "frames, in between",
                    frames, 2 * kFewest + apart, kFewest, apart));
  return {cut(recording, first, first + half), cut(recording, first + frames - half, first + frames)};
}

HoldOutFacts facts_of(const Halves& halves) {
  const auto first = [](const Tracks& half) { return half.frames().front().number; };
  const auto last = [](const Tracks& half) { return half.frames().back().number; };
  return {true, first(halves.fitted), last(halves.fitted), first(halves.held_out), last(halves.held_out)};
}

std::vector<HeldOut> held_out(const std::vector<ModelFit>& models, const Halves& halves, const CompareOptions& options,
                              const Conditions& fitted, const Weighting& weighting, const Runtime& runtime) {
  const Conditions conditions = held_out_conditions(halves.held_out, fitted);
  const Target target(recorded_samples(conditions.recording, conditions.metrics), options.binning);
  const auto seeds = replicate_seeds({options.seed}, Stream::final_seeds, options.budget.final_replicates);
  const std::int64_t frames = path_frames(halves);
  const double recorded = distance_to_nearest(conditions.recording, fitted.recording, frames);
  std::vector<Nearness> nearness;
  std::vector<Scored> there;
  Laws laws{{}, {}, std::vector<double>(models.size(), 0), {options.seed}};
  for (const ModelFit& fit : models) {
    const ModelChoice& model = choice_of(options, fit.model);
    Objective objective(model, conditions, target, runtime);
    objective.use_steps(fit.runs.steps);
    const auto values = parameter_values(model, fit);
    const Energies raw = objective.energies(values, seeds).raw;
    there.push_back({-cost_of(raw, weighting), raw});
    laws.of.push_back(law_of(objective, values, {options.seed}, options.laws));
    Ensemble ensemble(model, conditions, runtime);
    ensemble.use_steps(fit.runs.steps);
    nearness.push_back({distance_to_nearest(ensemble.run({values, seeds.front()}).seen, fitted.recording, frames), recorded, frames});
  }
  laws.recordings = laws.of.front();
  const auto certainty = certainties(there, laws, target, weighting, options.budget.final_replicates);
  std::vector<HeldOut> out;
  for (std::size_t m = 0; m < models.size(); ++m) out.push_back({there[m].score, there[m].raw, certainty[m], nearness[m]});
  return out;
}

}  // namespace swarmfit
