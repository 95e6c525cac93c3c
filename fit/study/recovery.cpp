// SPDX-License-Identifier: MIT
#include "fit/study/recovery.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/store/checkpointed.h"
#include "libswarm/simulate.h"
#include "libtrack/error.h"

namespace swarmfit {
namespace {

constexpr double kWarmUp = 2;   // in units of L / V
constexpr int kFilmSteps = 10;  // per frame: animals do not move once per frame, nor as finely as their model is stepped in fits

}  // namespace

RecoveryCase recovery_case(std::size_t planted, const std::string& name, std::uint64_t seed, std::vector<double> parameters,
                           const Comparison& result) {
  RecoveryCase out{planted, seed, std::move(parameters), {}, {}, {}, {}, {}, 0};
  for (const ModelFit& fit : result.models) {
    out.order.push_back(fit.model);
    out.scores.push_back(fit.standing.score);
    out.score_se.push_back(fit.standing.in_sample.score_se);
    out.group.push_back(fit.standing.certainty.group);
    out.gof_p.push_back(fit.standing.certainty.gof_p);
    if (fit.model == name) out.rank_of_planted = fit.standing.rank;
  }
  return out;
}

void add_case(Recovery& recovery, RecoveryCase one) {
  const auto winner = std::find(recovery.compared.begin(), recovery.compared.end(), one.order.front());
  ++recovery.confusion[one.planted][static_cast<std::size_t>(winner - recovery.compared.begin())];
  recovery.cases.push_back(std::move(one));
}

std::vector<double> planted_parameters(const ModelChoice& model, const Scales& scales, const std::map<std::string, double>& set) {
  std::vector<double> values = scene_parameters(model, set);
  for (std::size_t p = 0; p < values.size(); ++p) {
    const Parameter& row = model.spec->parameters[p];
    if (!set.contains(std::string(row.name))) values[p] = row.fit.initial * row.scale(scales);
  }
  return values;
}

std::vector<double> varied(const ModelChoice& model, std::vector<double> parameters, const Scales& scales, double spread,
                           std::uint64_t seed, const std::map<std::string, double>& set) {
  const Rng rng{seed};
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const Parameter& row = model.spec->parameters[p];
    if (!row.fitted || !model.spec->uses(p, model.options) || set.contains(std::string(row.name))) continue;
    const double u = 2 * rng.uniform(Stream::probe, 0, static_cast<std::uint32_t>(p), 0) - 1, unit = row.scale(scales);
    const double value = std::clamp(parameters[p] * std::exp(u * std::log(spread)), row.fit.lower * unit, row.fit.upper * unit);
    parameters[p] = row.integer ? std::round(value) : value;
  }
  return parameters;
}

std::vector<PlantedRow> planted_rows(const ModelChoice& model, const std::string& length_unit) {
  std::vector<PlantedRow> out;
  for (std::size_t k = 0; k < model.spec->parameters.size(); ++k) {
    const Parameter& row = model.spec->parameters[k];
    out.push_back({row.name, row.symbol, to_string(row.unit, length_unit), row.meaning, model.spec->uses(k, model.options)});
  }
  return out;
}

Tracks planted_recording(const ModelChoice& model, const std::vector<double>& parameters, PlantOptions film, const Scales& scales,
                         std::uint64_t seed) {
  film.seed = seed;
  film.scales = scales;
  film.substeps = model.spec->is_map(model.options) ? 1 : kFilmSteps;
  film.start_radius = scales.extent * std::sqrt(film.dims == 3 ? 5.0 / 3 : 2.0);
  film.start_speed = scales.speed;
  film.warm_up = static_cast<std::int64_t>(std::ceil(kWarmUp * scales.time() / film.dt));
  film.path = model.name;
  return plant(model, parameters, film);
}

CompareOptions with_shared_constants(CompareOptions compare, const Scales& scales) {
  for (const auto& model : compare.models) {
    const std::vector<double> values = planted_parameters(model, scales);
    for (std::size_t p = 0; p < values.size(); ++p) {
      const Parameter& row = model.spec->parameters[p];
      if (!row.fitted && model.spec->uses(p, model.options))
        compare.requests.set.try_emplace(fmt::format("{}.{}", model.name, row.name), values[p]);
    }
  }
  return compare;
}

Recovery recover_models(const RecoveryOptions& options, const OnRecoveryCase& on_case, const StudyHooks& hooks) {
  CompareOptions compare_options = with_shared_constants(options.compare, options.scales);
  Recovery out;
  std::size_t number = 0;
  for (const auto& model : options.compare.models) out.compared.push_back(model.name);
  for (std::size_t p = 0; p < options.planted.size(); ++p) {
    const ModelChoice& model = options.planted[p];
    if (std::find(out.compared.begin(), out.compared.end(), model.name) == out.compared.end())
      throw InputError("recover: " + model.name + " makes recordings but is not compared; expected it among the models to compare");
    const auto found = options.set.find(model.name);
    const auto set = found == options.set.end() ? std::map<std::string, double>{} : found->second;
    out.planted.push_back(model.name);
    out.rows.push_back(planted_rows(model, options.film.unit));
    out.parameters.push_back(planted_parameters(model, options.scales, set));
    out.confusion.emplace_back(out.compared.size(), 0);
    for (int k = 1; k <= options.seeds; ++k) {
      const std::uint64_t seed = options.compare.seed + static_cast<std::uint64_t>(k) - 1;
      compare_options.seed = seed;
      if (!hooks.part.has(number++)) continue;
      add_case(out, *checkpointed<RecoveryCase>(hooks.runtime.checkpoint, fmt::format("case {} {}", model.name, seed), [&] {
                 const auto parameters = varied(model, out.parameters.back(), options.scales, options.spread, seed, set);
                 const Tracks recording = planted_recording(model, parameters, options.film, options.scales, seed);
                 return std::optional(recovery_case(p, model.name, seed, parameters,
                                                    compare(recording, compare_options, hooks.on_progress, {hooks.runtime.executor})));
               }));
      if (on_case) on_case(out.cases.back());
    }
  }
  return out;
}

}  // namespace swarmfit
