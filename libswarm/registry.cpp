// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "libswarm/model_spec.h"
#include "libtrack/error.h"

namespace swarmfit {

#define MODEL(name) ModelSpec name##_spec();
#include "libswarm/models.def"
#undef MODEL

std::span<const ModelSpec> models() {
#define MODEL(name) name##_spec(),
  static const std::array specs{
#include "libswarm/models.def"
  };
#undef MODEL
  return specs;
}

namespace {

using Names = std::vector<std::string_view>;

// Calls piece(text) for each part of `text` between separators.
template <class Piece>
void split(std::string_view text, char separator, Piece&& piece) {
  for (std::size_t first = 0; first <= text.size();) {
    const std::size_t end = std::min(text.find(separator, first), text.size());
    piece(text.substr(first, end - first));
    first = end + 1;
  }
}

const Option& find_option(const ModelSpec& spec, std::string_view name) {
  const auto found = std::find_if(spec.options.begin(), spec.options.end(), [&](const Option& o) { return o.name == name; });
  if (found != spec.options.end()) return *found;
  Names names;
  for (const Option& o : spec.options) names.push_back(o.name);
  const std::string legal = names.empty() ? "no options" : fmt::format("one of {}", fmt::join(names, ", "));
  throw InputError(fmt::format("model {}: unknown option '{}'; expected {}", spec.name, name, legal));
}

const ModelSpec& find_model(std::string_view name, std::span<const ModelSpec> more) {
  Names names;
  for (const auto known : {models(), more})
    for (const ModelSpec& spec : known) {
      if (spec.name == name) return spec;
      names.push_back(spec.name);
    }
  throw InputError(fmt::format("model '{}': unknown; expected one of {}", name, fmt::join(names, ", ")));
}

std::string canonical(const ModelSpec& spec, const Options& options) {
  std::vector<std::string> settings;
  for (const Option& o : spec.options)
    if (const auto& value = options.find(o.name)->second; value != o.values.front())
      settings.push_back(fmt::format("{}={}", o.name, value));
  return settings.empty() ? spec.name : fmt::format("{}[{}]", spec.name, fmt::join(settings, ","));
}

}  // namespace

void Parameter::check(double value) const {
  const bool positive = log && scene.lower > 0, signless = std::min(scene.lower, fit.lower) >= 0;
  if (std::isfinite(value) && (!signless || value >= 0) && (!positive || value > 0) && (!integer || value == std::round(value))) return;
  throw InputError(fmt::format("{}={}: is not allowed; expected {}{}", name, value, integer ? "a whole number" : "a number",
                               positive   ? " greater than 0"
                               : signless ? ", at least 0"
                                          : ""));
}

double Parameter::scale(const Scales& s) const {
  const double unit_length = length == Length::extent ? s.extent : s.spacing;
  return std::pow(unit_length, unit.length) * std::pow(s.time(), unit.time);
}

std::string to_string(Unit unit, const std::string& length_unit) {
  const auto power = [](const std::string& base, double exponent) { return exponent == 1 ? base : fmt::format("{}^{:g}", base, exponent); };
  std::string above, below;
  const auto place = [&](const std::string& base, double exponent) {
    if (exponent == 0) return;
    std::string& side = exponent > 0 ? above : below;
    side += (side.empty() ? "" : "·") + power(base, std::abs(exponent));
  };
  place(length_unit, unit.length);
  place("s", unit.time);
  if (below.empty()) return above;
  return (above.empty() ? "1" : above) + "/" + (below.find("·") == std::string::npos ? below : "(" + below + ")");
}

Options ModelSpec::resolve(const Options& given) const {
  Options all;
  for (const Option& o : this->options) all.emplace(o.name, o.values.front());
  for (const auto& [key, value] : given) {
    const Option& o = find_option(*this, key);
    if (std::find(o.values.begin(), o.values.end(), value) == o.values.end())
      throw InputError(fmt::format("model {}: option {} cannot be '{}'; expected one of {}", name, key, value, fmt::join(o.values, ", ")));
    all[key] = value;
  }
  return all;
}

int ModelSpec::find(std::string_view parameter) const {
  const auto found = std::find_if(parameters.begin(), parameters.end(), [&](const Parameter& p) { return p.name == parameter; });
  return found == parameters.end() ? -1 : static_cast<int>(found - parameters.begin());
}

namespace {

// Do options meet conditions such as "noise=curl|perlin,interaction=on"?
bool meets(std::string_view when, const Options& given) {
  bool used = true;
  split(when, ',', [&](std::string_view condition) {
    const std::size_t equals = condition.find('=');
    const auto option = given.find(condition.substr(0, equals));
    bool any = false;
    split(condition.substr(equals + 1), '|',
          [&](std::string_view value) { any = any || (option != given.end() && option->second == value); });
    used = used && any;
  });
  return used;
}

bool always_or_with(std::string_view when, const Options& given) { return when == "always" || (!when.empty() && meets(when, given)); }

}  // namespace

bool ModelSpec::uses(std::size_t p, const Options& given) const {
  const std::string_view when = parameters[p].when;
  return when.empty() || meets(when, given);
}

bool ModelSpec::is_map(const Options& given) const { return fixed_step || always_or_with(map, given); }

bool ModelSpec::has_force(const Options& given) const {
  return force && !is_map(given) && (force->when.empty() || meets(force->when, given));
}

bool ModelSpec::remembers(const Options& given) const { return force && always_or_with(force->memory, given); }

ModelChoice parse_model(std::string_view text, std::span<const ModelSpec> more) {
  const std::size_t bracket = text.find('[');
  const ModelSpec& spec = find_model(text.substr(0, bracket), more);
  Options given;
  if (bracket != std::string_view::npos) {
    if (text.back() != ']') throw InputError(fmt::format("model '{}': no closing bracket; expected name[option=value,...]", text));
    split(text.substr(bracket + 1, text.size() - bracket - 2), ',', [&](std::string_view setting) {
      const std::size_t equals = setting.find('=');
      if (equals == std::string_view::npos)
        throw InputError(fmt::format("model '{}': '{}' is not a setting; expected name[option=value,...]", text, setting));
      if (!given.emplace(setting.substr(0, equals), setting.substr(equals + 1)).second)
        throw InputError(fmt::format("model '{}': option {} is given twice; expected once", text, setting.substr(0, equals)));
    });
  }
  Options options = spec.resolve(given);
  std::string name = canonical(spec, options);
  return {&spec, std::move(options), std::move(name)};
}

std::string summary_of(const ModelChoice& model) {
  std::string with;
  for (const Option& o : model.spec->options) {
    const std::string& value = model.options.find(o.name)->second;
    const auto k = static_cast<std::size_t>(std::find(o.values.begin(), o.values.end(), value) - o.values.begin());
    if (k == 0) continue;
    with += (with.empty() ? "" : " and ") + (k < o.with.size() ? o.with[k] : fmt::format("{} = {}", o.name, value));
  }
  std::string summary = model.spec->summary;
  if (with.empty()) return summary;
  if (!summary.empty()) summary[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(summary[0])));
  return fmt::format("{} with {}. {}", model.spec->name, with, summary);
}

}  // namespace swarmfit
