// SPDX-License-Identifier: MIT
#include "fit/model_fit/search_space.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "fit/experiment/plant.h"
#include "fit/results/axis_scale.h"
#include "libtrack/error.h"

namespace swarmfit {
namespace {

constexpr double kAtBound = 0.01;  // share of the searched axis that counts as being on its bound
constexpr double kLittle = 0.005, kDeviations = 3;

// The request for one parameter of one model: the fullest name wins.
template <class Value>
const Value* find_request(const std::map<std::string, Value>& requests, const ModelChoice& model, std::string_view parameter) {
  for (const std::string& key :
       {fmt::format("{}.{}", model.name, parameter), fmt::format("{}.{}", model.spec->name, parameter), std::string(parameter)})
    if (const auto it = requests.find(key); it != requests.end()) return &it->second;
  return nullptr;
}

bool names_parameter_of(const std::string& key, const ModelChoice& model) {
  return std::any_of(model.spec->parameters.begin(), model.spec->parameters.end(), [&](const Parameter& p) {
    return key == p.name || key == fmt::format("{}.{}", model.spec->name, p.name) || key == fmt::format("{}.{}", model.name, p.name);
  });
}

template <class Value>
void check_keys(const std::map<std::string, Value>& requests, const char* flag, const std::vector<ModelChoice>& models) {
  for (const auto& request : requests) {
    const std::string& key = request.first;
    if (std::any_of(models.begin(), models.end(), [&](const ModelChoice& m) { return names_parameter_of(key, m); })) continue;
    std::vector<std::string_view> names;
    for (const auto& m : models)
      for (const auto& p : m.spec->parameters)
        if (std::find(names.begin(), names.end(), p.name) == names.end()) names.push_back(p.name);
    throw InputError(
        fmt::format("{} {}: no model of this run has such a parameter; expected one of {}", flag, key, fmt::join(names, ", ")));
  }
}

void check_legal(const char* flag, const Parameter& row, double value) {
  try {
    row.check(value);
  } catch (const InputError& e) {
    throw InputError(fmt::format("{} {}", flag, e.what()));
  }
}

}  // namespace

// A speed that everybody keeps for ever is nowhere but among the recorded ones: three of their standard deviations to either side, and a
// little, for what curvature and the error of the mean take from it.
void SearchSpace::look_up_speed(const Scales& scales, double& value, Axis& axis) {
  const double factor = std::exp(kLittle + kDeviations * scales.unlike);
  axis.lower = std::max(axis.lower, scales.speed / factor);
  axis.upper = std::min(axis.upper, scales.speed * factor);
  value = std::clamp(value, axis.lower, axis.upper);
}

SearchSpace::SearchSpace(const ModelChoice& model, const Scales& scales, const ParameterRequests& requests) : model_(model) {
  const auto& table = model.spec->parameters;
  const bool only_published =
      requests.published && std::any_of(table.begin(), table.end(), [](const Parameter& row) { return row.published; });
  for (std::size_t p = 0; p < table.size(); ++p) {
    const double unit = table[p].scale(scales);
    base_.push_back(table[p].fit.initial * unit);
    axes_.push_back({table[p].fit.lower * unit, table[p].fit.upper * unit, table[p].log, table[p].integer});
    if (table[p].shown == Parameter::Shown::speed) look_up_speed(scales, base_.back(), axes_.back());
    if (table[p].fitted && !(only_published && !table[p].published) && model.spec->uses(p, model.options)) searched_.push_back(p);
  }
  apply(model, requests);
}

void SearchSpace::apply(const ModelChoice& model, const ParameterRequests& requests) {
  const auto& table = model.spec->parameters;
  const auto search = [this](std::size_t p, bool yes) {
    std::erase(searched_, p);
    if (yes) searched_.insert(std::upper_bound(searched_.begin(), searched_.end(), p), p);
  };
  for (std::size_t p = 0; p < table.size(); ++p) {
    if (!model.spec->uses(p, model.options)) continue;
    const auto* value = find_request(requests.set, model, table[p].name);
    const auto* bounds = find_request(requests.bounds, model, table[p].name);
    if (value) {
      check_legal("`set`", table[p], *value);
      refuse_idle("`set`", table[p], *value);
      base_[p] = *value;
    }
    if (value || find_request(requests.fix, model, table[p].name)) search(p, false);
    if (!bounds) continue;
    const auto [lower, upper] = *bounds;
    if (!(lower < upper))
      throw InputError(fmt::format("`bounds` {}={}:{}: the interval is empty; expected lower < upper", table[p].name, lower, upper));
    for (const double end : {lower, upper})
      if (!(table[p].log && end == 0))
        check_legal("`bounds`", table[p], end);  // a lower bound of zero makes a logarithmic axis another one
    refuse_idle("`bounds`", table[p], upper);
    axes_[p].lower = lower;
    axes_[p].upper = upper;
    axes_[p].log = table[p].log && lower > 0;  // a zero lower bound is never log-scaled
    base_[p] = std::clamp(base_[p], lower, upper);
    search(p, true);
  }
}

double SearchSpace::Axis::value(double u) const {
  const double inside = std::clamp(value_at(scale_of(log, lower), lower, upper, u), lower, upper);
  return integer ? std::round(inside) : inside;
}

double SearchSpace::Axis::coordinate(double value) const {
  return std::clamp(place_on(scale_of(log, lower), lower, upper, std::clamp(value, lower, upper)), 0.0, 1.0);
}

std::vector<double> SearchSpace::parameters(const Point& x) const {
  auto values = base_;
  for (std::size_t k = 0; k < searched_.size(); ++k) values[searched_[k]] = axes_[searched_[k]].value(x[static_cast<Index>(k)]);
  return values;
}

Point SearchSpace::point(const std::vector<double>& parameters) const {
  Point x(dimensions());
  for (std::size_t k = 0; k < searched_.size(); ++k) x[static_cast<Index>(k)] = axes_[searched_[k]].coordinate(parameters[searched_[k]]);
  return x;
}

Point SearchSpace::adopt(const Point& x, const SearchSpace& other, const Point& there) const {
  auto values = parameters(x);
  const auto theirs = other.parameters(there);
  for (const auto p : other.searched_) values[p] = theirs[p];
  return point(values);
}

std::vector<ParameterResult> SearchSpace::describe(const Point& x, const std::string& length_unit) const {
  const auto values = parameters(x);
  const auto& table = model_.spec->parameters;
  std::vector<ParameterResult> out;
  for (std::size_t p = 0; p < table.size(); ++p) {
    if (!model_.spec->uses(p, model_.options)) continue;
    ParameterResult r{std::string(table[p].name), std::string(table[p].symbol), to_string(table[p].unit, length_unit),
                      std::string(table[p].meaning)};
    r.value = r.lower = r.upper = values[p];
    const auto found = std::find(searched_.begin(), searched_.end(), p);
    if (found != searched_.end()) {
      const double u = x[found - searched_.begin()];
      r.fitted = true;
      r.log = axes_[p].log;
      r.lower = axes_[p].lower;
      r.upper = axes_[p].upper;
      r.at_bound = u < kAtBound || u > 1 - kAtBound;
      if (u < kAtBound) r.at_lower = table[p].at_lower;
    }
    out.push_back(std::move(r));
  }
  return out;
}

void check_requests(const ParameterRequests& requests, const std::vector<ModelChoice>& models) {
  check_keys(requests.set, "`set`", models);
  check_keys(requests.fix, "`fix`", models);
  check_keys(requests.bounds, "`bounds`", models);
}

}  // namespace swarmfit
