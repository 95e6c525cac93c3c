// SPDX-License-Identifier: MIT
#include "fit/study/power.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/experiment/ensemble.h"
#include "fit/store/checkpointed.h"
#include "libeval/lags.h"

namespace swarmfit {
namespace {

constexpr double kOneSided = 1.6449;  // 95 % of a standard normal lie below

// The index of a model in a case's order.
std::size_t place(const RecoveryCase& c, const std::string& model) {
  return static_cast<std::size_t>(std::find(c.order.begin(), c.order.end(), model) - c.order.begin());
}

PowerPair pair_of(const Recovery& r, std::size_t planted, std::size_t rival) {
  PowerPair out{planted, rival};
  Moments lead;
  for (const RecoveryCase& c : r.cases) {
    if (c.planted != planted) continue;
    const std::size_t own = place(c, r.planted[planted]), other = place(c, r.compared[rival]);
    ++out.recordings;
    out.first += own < other;
    out.told_apart += own < other && c.group[own] == 1 && c.group[other] > 1;
    lead.add(c.scores[own] - c.scores[other]);
  }
  if (lead.count > 0) out.lead = lead.mean;
  if (lead.count < 2) return out;
  out.lead_sd = std::sqrt(lead.m2 / static_cast<double>(lead.count - 1));
  const double root = kOneSided * out.lead_sd / out.lead;
  out.factor = out.lead > 0 ? std::max(1.0, root * root) : INFINITY;
  return out;
}

// Constants as in the recording, whatever scales a planted one turns out to have.
CompareOptions with_constants_of(const Comparison& fitted, CompareOptions options) {
  for (const ModelFit& fit : fitted.models)
    for (const ParameterResult& p : fit.parameters)
      if (!p.fitted) options.requests.set.try_emplace(fmt::format("{}.{}", fit.model, p.name), p.value);
  return options;
}

const ModelFit& result_of(const Comparison& c, const std::string& model) {
  return *std::find_if(c.models.begin(), c.models.end(), [&](const ModelFit& r) { return r.model == model; });
}

}  // namespace

std::vector<PowerPair> power_pairs(const Recovery& recovery) {
  std::vector<PowerPair> out;
  for (std::size_t p = 0; p < recovery.planted.size(); ++p)
    for (std::size_t r = 0; r < recovery.compared.size(); ++r)
      if (recovery.planted[p] != recovery.compared[r]) out.push_back(pair_of(recovery, p, r));
  return out;
}

Power power(const Tracks& recording, const PowerOptions& options, const OnPower& on_power, const StudyHooks& hooks) {
  const std::size_t all = 1 + options.compare.models.size() * static_cast<std::size_t>(options.seeds);
  std::size_t done = 0, number = 0;
  const auto tell = [&] {
    if (on_power) on_power(done++, all);
  };
  tell();
  Power out;
  out.fitted = compare(recording, options.compare, hooks.on_progress, hooks.runtime);
  const Comparison& fitted = out.fitted;
  tell();
  ConditionOptions as_filmed = options.compare.conditions;
  as_filmed.smoothing = 0;  // what is filmed is smoothed when it is compared
  const Conditions conditions = make_conditions(recording, as_filmed);
  CompareOptions again = with_constants_of(fitted, options.compare);
  for (std::size_t m = 0; m < options.compare.models.size(); ++m) {
    const ModelChoice& model = options.compare.models[m];
    const ModelFit& fit = result_of(fitted, model.name);
    Ensemble ensemble(model, conditions);
    ensemble.use_steps(fit.runs.steps);
    const auto parameters = parameter_values(model, fit);
    out.recovery.planted.push_back(model.name);
    out.recovery.rows.push_back(planted_rows(model, recording.meta().unit));
    out.recovery.compared = fitted.run.named;
    out.recovery.parameters.push_back(parameters);
    out.recovery.confusion.emplace_back(options.compare.models.size(), 0);
    for (int k = 1; k <= options.seeds; ++k) {
      again.seed = options.compare.seed + static_cast<std::uint64_t>(k);
      if (!hooks.part.has(number++)) continue;
      auto one = checkpointed<RecoveryCase>(hooks.runtime.checkpoint, fmt::format("case {} {}", model.name, again.seed), [&] {
        const Run film = ensemble.run({parameters, Rng{again.seed}.derive(Stream::bootstrap, m)});
        if (film.blew_up) return std::optional<RecoveryCase>();
        return std::optional(
            recovery_case(m, model.name, again.seed, parameters, compare(film.seen, again, hooks.on_progress, {hooks.runtime.executor})));
      });
      if (one) add_case(out.recovery, std::move(*one));
      tell();
    }
  }
  out.pairs = power_pairs(out.recovery);
  return out;
}

}  // namespace swarmfit
