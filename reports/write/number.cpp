// SPDX-License-Identifier: MIT
#include "reports/write/number.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>

namespace swarmfit {
namespace {

bool is_digit(std::string_view text, std::size_t at) { return at < text.size() && text[at] >= '0' && text[at] <= '9'; }

std::string_view raised(char c) {
  constexpr std::array<std::string_view, 10> kDigits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  return c == '-' ? "⁻" : c == '.' ? "·" : kDigits[static_cast<std::size_t>(c - '0')];
}

std::string superscript(int number) {
  std::string out;
  for (const char c : std::to_string(number)) out += raised(c);
  return out;
}

}  // namespace

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

std::string with_error(double value, double error, int decimals) {
  std::string text = fixed(value, decimals);
  if (!std::isfinite(error)) return text;
  const bool vanishes = error > 0 && error < 0.5 * std::pow(10, -decimals);
  return text + " ± " + (vanishes ? rounded(error, 1) : fixed(error, decimals));
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

std::string in_print(std::string_view text) {
  std::string out;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const std::string_view rest = text.substr(k);
    const bool number_before = k > 0 && is_digit(text, k - 1), word_before = k > 0 && text[k - 1] != ' ' && text[k - 1] != '(';
    if (rest.starts_with(" .. ")) {
      out += " to ";
      k += 3;
    } else if (number_before && rest[0] == 'e' && rest.size() > 2 && (rest[1] == '-' || rest[1] == '+') && is_digit(rest, 2)) {
      std::size_t end = 2;
      while (is_digit(rest, end)) ++end;
      out += "×10" + superscript(std::atoi(std::string(rest.substr(1, end - 1)).c_str()));
      k += end - 1;
    } else if (rest[0] == '-' && !word_before && is_digit(rest, 1)) {
      out += "−";
    } else {
      out += text[k];
    }
  }
  return out;
}

std::string unit_in_print(std::string_view unit) {
  std::string out;
  for (std::size_t k = 0; k < unit.size(); ++k) {
    const bool power = unit[k] == '^' && (is_digit(unit, k + 1) || (k + 1 < unit.size() && unit[k + 1] == '-' && is_digit(unit, k + 2)));
    if (!power) {
      out += unit[k];
      continue;
    }
    for (; k + 1 < unit.size() && (is_digit(unit, k + 1) || unit[k + 1] == '.' || unit[k + 1] == '-'); ++k) out += raised(unit[k + 1]);
  }
  return out;
}

std::string counted(std::int64_t count, const std::string& noun) { return counted(count) + ' ' + noun + (count == 1 ? "" : "s"); }

}  // namespace swarmfit
