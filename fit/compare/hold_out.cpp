// SPDX-License-Identifier: MIT
#include "fit/compare/hold_out.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "fit/compare/calibration.h"
#include "fit/compare/common_dynamics.h"
#include "fit/compare/facts.h"
#include "fit/model_fit/race.h"
#include "libeval/nearness.h"
#include "libtrack/cut.h"
#include "libtrack/error.h"
#include "libtrack/nan.h"

namespace swarmfit {
namespace {

constexpr std::int64_t kFewest = 32;  // frames of a half
constexpr std::int64_t kMemories = 3;
constexpr std::int64_t kShortestPath = 2, kLongestPath = 100;  // frames
constexpr std::size_t kWays = 2;

// [first, first + warm_up) and as many frames of a half.
struct Layout {
  std::int64_t first, warm_up, half;
};

Layout layout(const Tracks& recording) {
  const std::int64_t first = recording.frames().front().number, frames = recording.frames().back().number + 1 - first;
  const double memory = std::max(natural_scales(recording).time(), correlation_time(recording));
  // A group that hardly moves has no end of memory: then there are no halves.
  const auto warm_up = static_cast<std::int64_t>(std::ceil(std::min(memory / recording.dt(), static_cast<double>(frames))));
  return {first, warm_up, (frames - 2 * warm_up) / 2};
}

// Paths are as long as motion takes to become new, if there are unbroken ones so long, else shorter.
std::int64_t path_frames(const Tracks& fitted, const Tracks& held) {
  auto frames = static_cast<std::int64_t>(std::lround(natural_scales(fitted).time() / fitted.dt()));
  frames = std::clamp<std::int64_t>(frames, kShortestPath, kLongestPath);
  while (frames > kShortestPath && !std::isfinite(distance_to_nearest(held, fitted, frames))) frames /= 2;
  return std::max(frames, kShortestPath);
}

HeldOutWay way_of(const Half& fit, const Half& held) {
  const auto first = [](const Half& half) { return half.tracks.frames().front().number + half.warm_up; };
  const auto last = [](const Half& half) { return half.tracks.frames().back().number; };
  return {first(fit), last(fit), first(held), last(held), {}, {}};
}

// What one search of a half left.
struct Searched {
  std::vector<std::vector<double>> values;  // per model
  std::vector<int> steps;
  std::vector<Energies> fitted;  // energies in the half that was fitted
  std::vector<double> scatter;
  std::vector<std::int64_t> simulations;
  std::vector<bool> used;  // columns
  PerColumn<double> resolution;
  Weighting weighting;
};

// Every model as in the search that fits it best, under weights of the energies of those fits. One search alone stays as it is.
Searched best_of(const std::vector<Searched>& searches) {
  Searched best = searches.front();
  if (searches.size() == 1) return best;
  Eigen::MatrixXd table(static_cast<Index>(best.fitted.size()), static_cast<Index>(best.fitted.front().size()));
  for (std::size_t m = 0; m < best.fitted.size(); ++m) {
    const auto cheaper = [&](const Searched& a, const Searched& b) {
      return cost_of(a.fitted[m], best.weighting) < cost_of(b.fitted[m], best.weighting);
    };
    const Searched& chosen = *std::min_element(searches.begin(), searches.end(), cheaper);
    best.values[m] = chosen.values[m];
    best.steps[m] = chosen.steps[m];
    best.fitted[m] = chosen.fitted[m];
    table.row(static_cast<Index>(m)) = Eigen::Map<const Eigen::RowVectorXd>(best.fitted[m].data(), table.cols());
  }
  best.weighting = entropy_weights(table, best.used, {best.resolution.begin(), best.resolution.end()});
  return best;
}

// One half fitted, the other scored.
class Way {
 public:
  Way(const Half& fit, const Half& held, const CompareOptions& options, const OnCompareProgress& on_progress, const Runtime& runtime)
      : options_(options),
        on_progress_(on_progress),
        runtime_(runtime),
        half_(fit),
        fitted_(make_conditions(fit.tracks, options.conditions, fit.warm_up)) {
    fitted_.metrics.lags = lags_for(fitted_, options);
    target_ = std::make_unique<Target>(recorded_samples(fitted_.recording, fitted_.metrics), options.binning);
    held_ = held_out_conditions(held.tracks, fitted_, held.warm_up);
    held_out_target_ = std::make_unique<Target>(recorded_samples(held_.recording, held_.metrics), options.binning);
  }

  Searched search(std::uint64_t seed) const {
    CompareOptions options = options_;
    options.seed = seed;
    if (options.common_dynamics) options = with_common_dynamics(half_.tracks, options, on_progress_, runtime_);
    const ObservationFacts observation = observation_facts(fitted_, *target_, options);
    Searched out;
    out.used.assign(observation.used.begin(), observation.used.end());
    out.resolution = resolution(fitted_, *target_, options, observation.error_dominated);
    Calibration calibration(options, fitted_, *target_, observation.used, on_progress_, runtime_);
    calibration.run(out.resolution);
    std::vector<std::vector<Energies>> selections;
    for (const ModelSearch& s : calibration.searches()) {
      out.values.push_back(s.space().parameters(s.selected().x));
      out.steps.push_back(s.objective().ensemble().steps());
      out.fitted.push_back(s.selected().outcome.raw);
      out.simulations.push_back(s.simulations());
      selections.push_back(s.selections());
    }
    out.weighting = calibration.weighting();
    out.scatter = search_scatter(selections, out.weighting);
    return out;
  }

  Scored score(const Searched& found, std::size_t m, const Weighting& weighting, std::uint64_t seed) const {
    const Objective objective = objective_of(found, m);
    const auto seeds = replicate_seeds({seed}, Stream::final_seeds, options_.budget.final_replicates);
    const Energies raw = objective.energies(found.values[m], seeds).raw;
    return {-cost_of(raw, weighting), raw};
  }

  Bootstrap bootstrap(const Searched& found, std::size_t m, std::uint64_t seed) const {
    return bootstrap_of(objective_of(found, m), found.values[m], {seed}, options_.bootstrap_recordings);
  }

  // Of all models: how near they lie to what they were fitted to.
  std::vector<Nearness> nearness(const Searched& found, std::uint64_t seed) const {
    const std::int64_t frames = path_frames(fitted_.recording, held_.recording);
    const double recorded = distance_to_nearest(held_.recording, fitted_.recording, frames);
    const Rng first = replicate_seeds({seed}, Stream::final_seeds, 1).front();
    std::vector<Nearness> out;
    for (std::size_t m = 0; m < options_.models.size(); ++m) {
      Ensemble ensemble(options_.models[m], held_, runtime_);
      ensemble.use_steps(found.steps[m]);
      const Tracks run = ensemble.run({found.values[m], first}).seen;
      out.push_back({distance_to_nearest(run, fitted_.recording, frames), recorded, frames});
    }
    return out;
  }

  const Target& target() const { return *target_; }
  std::unique_ptr<Target> take_held_out_target() { return std::move(held_out_target_); }

 private:
  Objective objective_of(const Searched& found, std::size_t m) const {
    Objective out(options_.models[m], held_, *held_out_target_, runtime_);
    out.use_steps(found.steps[m]);
    return out;
  }

  const CompareOptions& options_;
  const OnCompareProgress& on_progress_;
  const Runtime& runtime_;
  const Half& half_;
  Conditions fitted_, held_;
  std::unique_ptr<Target> target_, held_out_target_;  // of the fitted half, of the other
};

// Of the k-th search of a way: other than those of the whole recording and of all other searches.
std::uint64_t seed_of(std::uint64_t seed, std::size_t way, int search) {
  return Rng{seed}.derive(Stream::hold_out, way + kWays * static_cast<std::size_t>(search)).seed;
}

// Variance of a model's score between searches; NaN for one search.
double variance_of_searches(const Way& way, const std::vector<Searched>& searches, std::size_t m, const Weighting& weighting,
                            std::uint64_t seed) {
  if (searches.size() == 1) return kNaN;
  Moments moments;
  for (const Searched& found : searches) moments.add(way.score(found, m, weighting, seed).score);
  return moments.sd() * moments.sd();
}

// Of both ways.
Nearness mean(const Nearness& a, const Nearness& b) {
  return {(a.simulated + b.simulated) / 2, (a.recorded + b.recorded) / 2, std::max(a.frames, b.frames)};
}

// Searches one way and adds what it found.
void add_way(HoldOut& out, Way& way, std::size_t number, const CompareOptions& options) {
  std::vector<Searched> searches;
  for (int k = 0; k < options.searches; ++k) searches.push_back(way.search(seed_of(options.seed, number, k)));
  const Searched best = best_of(searches);
  const std::uint64_t seed = seed_of(options.seed, number, 0);
  out.facts.ways[number].columns = way.target().columns();
  out.facts.ways[number].weights.assign(best.weighting.weights.begin(), best.weighting.weights.end());
  Trial trial{{}, {{}, {}, best.scatter, {seed}}, nullptr, best.weighting};
  const auto nearness = way.nearness(best, seed);
  for (std::size_t m = 0; m < options.models.size(); ++m) {
    trial.models.push_back(way.score(best, m, best.weighting, seed));
    trial.bootstraps.of.push_back(way.bootstrap(best, m, seed));
    const double variance = variance_of_searches(way, searches, m, best.weighting, seed);
    if (std::isfinite(variance)) trial.bootstraps.scatter[m] = std::sqrt(variance / options.searches);
    HeldOut& model = out.models[m];
    model.scores.push_back(trial.models[m].score);
    model.search_sd = number == 0 ? std::sqrt(variance) : std::sqrt((std::pow(model.search_sd, 2) + variance) / 2);
    model.nearness = number == 0 ? nearness[m] : mean(model.nearness, nearness[m]);
    for (const Searched& found : searches) {
      model.simulations += found.simulations[m];
      out.values[m].push_back(found.values[m]);
    }
  }
  out.targets.push_back(way.take_held_out_target());
  trial.target = out.targets.back().get();
  out.trials.push_back(std::move(trial));
}

}  // namespace

Halves halves(const Tracks& recording) {
  const auto [first, warm_up, half] = layout(recording);
  if (half < kFewest)
    throw InputError(
        fmt::format("`holdout`: {} frames are too few; expected at least {}, two halves of {}, each after the time in which motion becomes "
                    "new, {} frames",
                    recording.frames().back().number + 1 - first, 2 * (kFewest + warm_up), kFewest, warm_up));
  const std::int64_t middle = first + warm_up + half;
  return {{cut(recording, first, middle), warm_up}, {cut(recording, middle, middle + warm_up + half), warm_up}};
}

bool worth_halving(const Tracks& recording) {
  const Layout of = layout(recording);
  return of.half >= kFewest && of.half > kMemories * of.warm_up;
}

HoldOut hold_out(const Tracks& recording, const CompareOptions& options, const OnCompareProgress& on_progress, const Runtime& runtime) {
  const Halves parts = halves(recording);
  const std::array<const Half*, kWays> fit = {&parts.first, &parts.second}, held = {&parts.second, &parts.first};
  const std::array<const char*, kWays> names = {"first half", "second half"};
  HoldOut out;
  out.facts.warm_up = parts.first.warm_up;
  out.facts.searches = options.searches;
  out.models.resize(options.models.size());
  out.values.resize(options.models.size());
  for (std::size_t w = 0; w < kWays; ++w) {
    const OnCompareProgress tell = [&](CompareProgress now) {
      now.part = names[w];
      if (on_progress) on_progress(now);
    };
    out.facts.ways.push_back(way_of(*fit[w], *held[w]));
    Way way(*fit[w], *held[w], options, tell, runtime);
    add_way(out, way, w, options);
  }
  for (const HeldOut& m : out.models) out.scores.push_back((m.scores[0] + m.scores[1]) / 2);
  return out;
}

}  // namespace swarmfit
