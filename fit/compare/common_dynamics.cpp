// SPDX-License-Identifier: MIT
#include "fit/compare/common_dynamics.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "libtrack/error.h"

namespace swarmfit {
namespace {

std::vector<std::string> searched_parameters(const ModelChoice& model, const Scales& scales, const ParameterRequests& requests) {
  std::vector<std::string> names;
  const SearchSpace space(model, scales, requests);
  for (const std::size_t p : space.searched()) names.emplace_back(model.spec->parameters[p].name);
  return names;
}

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::vector<std::string> shared_parameters(const std::vector<ModelChoice>& models, const Scales& scales,
                                           const ParameterRequests& requests) {
  std::vector<std::string> shared;
  for (const ModelChoice& model : models) {
    const auto own = searched_parameters(model, scales, requests);
    if (&model == &models.front()) shared = own;
    std::erase_if(shared, [&](const std::string& name) { return !holds(own, name); });
  }
  return shared;
}

CompareOptions with_common_dynamics(const Tracks& recording, const CompareOptions& options, const OnCompareProgress& on_progress,
                                    const Runtime& runtime) {
  const ModelSpec* spec = options.models.front().spec;
  for (const ModelChoice& model : options.models)
    if (model.spec != spec)
      throw InputError(fmt::format("`common`: {} and {} are different models; expected settings of one, as in `preset` noise",
                                   options.models.front().name, model.name));
  const Scales scales = make_conditions(recording, options.conditions).scales;
  CompareOptions common = options;
  common.common_dynamics = false;
  common.common = shared_parameters(options.models, scales, options.requests);
  if (common.common.empty()) throw InputError("`common`: the models share no parameter that is searched; expected at least one");
  for (const ModelChoice& model : options.models)
    if (searched_parameters(model, scales, options.requests).size() == common.common.size())
      throw InputError(fmt::format("`common`: {} has no searched parameter of its own; expected at least one", model.name));
  CompareOptions alone = common;
  alone.hold_out = CompareOptions::HoldOutWhen::never;
  alone.common.clear();
  alone.models.resize(1);
  const Comparison fit = compare(recording, alone, on_progress, runtime);
  for (const ParameterResult& p : fit.models.front().parameters) {
    if (!holds(common.common, p.name)) continue;
    const auto of_this = [&](const auto& request) { return request.first == p.name || request.first.ends_with("." + p.name); };
    std::erase_if(common.requests.bounds, of_this);
    std::erase_if(common.requests.set, of_this);  // where the search was to start: the fuller name would win
    common.requests.set[p.name] = p.value;
  }
  return common;
}

}  // namespace swarmfit
