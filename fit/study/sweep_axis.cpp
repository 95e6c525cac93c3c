// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string_view>

#include "fit/study/sweep.h"
#include "libtrack/error.h"

namespace swarmfit {
namespace {

constexpr int kMostValues = 10'000;

[[noreturn]] void refuse(const std::string& text, std::string_view why) {
  throw InputError(fmt::format("'{}' {}; expected name=lo:hi:n, name=lo:hi:n:log or name=value,value,...", text, why));
}

std::vector<std::string> split(std::string_view text, char at) {
  std::vector<std::string> parts(1);
  for (const char c : text) c == at ? void(parts.emplace_back()) : parts.back().push_back(c);
  return parts;
}

bool parse_number(const std::string& text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

SweepAxis range(const std::string& text, const std::string& name, const std::vector<std::string>& parts) {
  double lower = 0, upper = 0, count = 0;
  if (!parse_number(parts[0], lower) || !parse_number(parts[1], upper) || !parse_number(parts[2], count)) refuse(text, "has no numbers");
  if (!(count >= 1 && count <= kMostValues) || count != std::floor(count)) refuse(text, "has no whole number of values from 1 to 10000");
  const bool log = parts.size() == 4;
  if (log && parts[3] != "log") refuse(text, "is not understood");
  if (count == 1 ? lower != upper : !(lower < upper)) refuse(text, "does not ascend");
  if (log && !(lower > 0)) refuse(text, "has no logarithms");
  SweepAxis axis{name, {}, {}, log, true, false};
  const auto n = static_cast<int>(count);
  for (int k = 0; k < n; ++k) {
    const double share = n > 1 ? static_cast<double>(k) / (n - 1) : 0;
    // The ends as they were given.
    double value = k == 0       ? lower
                   : k == n - 1 ? upper
                   : log        ? lower * std::exp(share * std::log(upper / lower))
                                : lower + share * (upper - lower);
    // 0.30000000000000004 is for nobody to read.
    const std::string word = fmt::format("{:.10g}", value);
    parse_number(word, value);
    axis.value.push_back(value);
    axis.words.push_back(word);
  }
  return axis;
}

}  // namespace

SweepAxis parse_axis(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) refuse(text, "names no values");
  const std::string name = text.substr(0, equals), values = text.substr(equals + 1);
  if (const auto parts = split(values, ':'); parts.size() == 3 || parts.size() == 4) return range(text, name, parts);
  SweepAxis axis{name, {}, {}, false, true, false};
  for (const std::string& word : split(values, ',')) {
    double value = 0;
    if (word.empty()) refuse(text, "has an empty value");
    for (const std::string& before : axis.words)
      if (before == word) refuse(text, "has a value twice");
    axis.numeric = axis.numeric && parse_number(word, value);
    axis.words.push_back(word);
    axis.value.push_back(value);
  }
  for (std::size_t k = 0; k < axis.words.size(); ++k) {
    if (!axis.numeric) axis.value[k] = static_cast<double>(k);
    if (axis.numeric && k > 0 && !(axis.value[k - 1] < axis.value[k])) refuse(text, "does not ascend");
  }
  return axis;
}

}  // namespace swarmfit
