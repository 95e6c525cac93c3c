// SPDX-License-Identifier: MIT
#include "cli/parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "libtrack/error.h"

namespace swarmfit::cli {
namespace {

constexpr int kMostSteps = 1000;  // per frame
constexpr double kLongestError = 1e9;

double number(std::string_view text, std::string_view whole) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    throw InputError(fmt::format("'{}': '{}' is not a number; expected a finite one", shown(whole), shown(text)));
  return value;
}

// "name=rest" into its two parts.
std::pair<std::string, std::string> assignment(const std::string& text, std::string_view expected) {
  // The name may hold settings of a model in brackets, which have an equals sign of their own.
  const auto bracket = text.rfind(']');
  const auto equals = text.find('=', bracket == std::string::npos ? 0 : bracket);
  if (equals == std::string::npos || equals == 0) throw InputError(fmt::format("'{}' is not allowed; expected {}", shown(text), expected));
  return {text.substr(0, equals), text.substr(equals + 1)};
}

}  // namespace

std::vector<ModelChoice> parse_models(const std::vector<std::string>& texts) {
  std::vector<ModelChoice> choices;
  for (const auto& text : texts) {
    for (const auto& part : split_outside_brackets(text)) {
      choices.push_back(parse_model(part));
      for (std::size_t k = 0; k + 1 < choices.size(); ++k)
        if (choices[k].name == choices.back().name)
          throw InputError(fmt::format("'{}': {} is named twice; expected different models", shown(text), choices.back().name));
    }
  }
  return choices;
}

std::map<std::string, double> parse_assignments(const std::vector<std::string>& texts) {
  std::map<std::string, double> out;
  for (const auto& text : texts) {
    const auto [name, value] = assignment(text, "parameter=value");
    out[name] = number(value, text);
  }
  return out;
}

std::map<std::string, std::map<std::string, double>> parse_planted(const std::vector<std::string>& texts) {
  std::map<std::string, std::map<std::string, double>> out;
  for (const auto& [name, value] : parse_assignments(texts)) {
    const auto dot = name.rfind('.');
    if (dot == std::string::npos) throw InputError(fmt::format("'{}' does not name a model; expected model.parameter=value", shown(name)));
    out[parse_model(name.substr(0, dot)).name][name.substr(dot + 1)] = value;
  }
  return out;
}

std::map<std::string, std::pair<double, double>> parse_bounds(const std::vector<std::string>& texts) {
  std::map<std::string, std::pair<double, double>> out;
  for (const auto& text : texts) {
    const auto [name, range] = assignment(text, "parameter=lower:upper");
    const auto colon = range.find(':');
    if (colon == std::string::npos) throw InputError(fmt::format("'{}' is not allowed; expected parameter=lower:upper", shown(text)));
    out[name] = {number(std::string_view(range).substr(0, colon), text), number(std::string_view(range).substr(colon + 1), text)};
  }
  return out;
}

PerIndividual parse_frames(const std::vector<std::string>& texts, std::int64_t otherwise) {
  constexpr double most = 10'000'000;
  PerIndividual out{otherwise, {}};
  for (const auto& text : texts) {
    const auto equals = text.rfind('=');
    const double frames = number(std::string_view(text).substr(equals == std::string::npos ? 0 : equals + 1), text);
    if (frames < 0 || frames > most || frames != std::floor(frames))
      throw InputError(fmt::format("'{}' is not allowed; expected frames or NAME=frames, a whole number from 0 to {}", shown(text), most));
    (equals == std::string::npos ? out.all : out.own[text.substr(0, equals)]) = static_cast<std::int64_t>(frames);
  }
  return out;
}

char parse_delimiter(const std::string& text) {
  if (text == "\\t" || text == "tab") return '\t';
  if (text == "space") return ' ';
  if (text.size() != 1) throw InputError(fmt::format("'{}' is not allowed; expected one character, tab or space", shown(text)));
  return text[0];
}

int parse_steps(const std::string& text) {
  if (text == "auto") return 0;
  if (text == "fewest") return kFewestSteps;
  int steps = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), steps);
  if (error != std::errc() || end != text.data() + text.size() || steps < 1 || steps > kMostSteps)
    throw InputError(fmt::format("'{}' is not allowed; expected auto, fewest or a whole number from 1 to {}", shown(text), kMostSteps));
  return steps;
}

void set_localisation_error(ConditionOptions& conditions, const std::string& text) {
  if (text == "estimate") return;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), conditions.sigma);
  if (error != std::errc() || end != text.data() + text.size() || !(conditions.sigma >= 0 && conditions.sigma <= kLongestError))
    throw InputError(fmt::format("'{}' is not allowed; expected estimate or a length from 0 to {:g}", shown(text), kLongestError));
  conditions.error = conditions.sigma > 0 ? ConditionOptions::Error::given : ConditionOptions::Error::none;
}

Binning binning(const std::string& normalisation, const Values& others) {
  Binning b = Binning::standard(normalisation == "separate" ? Normalisation::separate
                                : normalisation == "none"   ? Normalisation::none
                                                            : Normalisation::reference);
  const auto bins = static_cast<int>(others.number("bins", 0));
  if (bins > 0) b.bins = bins;
  const std::string scoring = others.text("scoring");
  if (scoring == "proper" && b.normalisation == Normalisation::separate)
    throw InputError(
        "separate together with --scoring proper: simulations would have no common axes to be scored on; expected --scoring pooled");
  if (!scoring.empty()) b.pooled = scoring == "pooled";
  return b;
}

}  // namespace swarmfit::cli
