// SPDX-License-Identifier: MIT
#include "reports/number.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace swarmfit {

std::string exact(double value) { return std::isfinite(value) ? fmt::format("{}", value) : std::string(); }

std::string fixed(double value, int decimals) {
  if (!std::isfinite(value)) return kUndefined;
  std::string text = fmt::format("{:.{}f}", value, decimals);
  const bool only_zeros = text.find_first_not_of("-0.") == std::string::npos;
  return only_zeros && text.front() == '-' ? text.substr(1) : text;
}

std::string rounded(double value, int significant) {
  if (!std::isfinite(value)) return kUndefined;
  if (value == 0) return "0";
  // Rounding may carry into the next decade (9.996 -> 10.0), so the exponent is read off the rounded number.
  const std::string scientific = fmt::format("{:.{}e}", value, significant - 1);
  const int exponent = std::atoi(scientific.c_str() + scientific.find('e') + 1);
  if (exponent < -4 || exponent > 6) return fmt::format("{:.{}g}", value, significant);
  const int decimals = significant - 1 - exponent;
  return decimals >= 0 ? fmt::format("{:.{}f}", value, decimals) : fmt::format("{:.0f}", std::strtod(scientific.c_str(), nullptr));
}

std::string brief(double value, int significant) {
  std::string text = rounded(value, significant);
  if (text.find('.') == std::string::npos || text.find('e') != std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string percent(double share) {
  if (!std::isfinite(share)) return kUndefined;
  const double value = 100 * share;
  return value != 0 && std::abs(value) < 1 ? fmt::format("{:.1g} %", value) : fmt::format("{:.0f} %", value);
}

std::string counted(std::int64_t count) {
  std::string digits = std::to_string(count);
  const std::size_t first = count < 0 ? 1 : 0;
  if (digits.size() - first < 5) return digits;  // four digits read well without a space
  for (std::size_t k = digits.size(); k > first + 3;) digits.insert(k -= 3, "\u202f");
  return digits;
}

std::string counted(std::int64_t count, const std::string& noun) { return counted(count) + ' ' + noun + (count == 1 ? "" : "s"); }

}  // namespace swarmfit
