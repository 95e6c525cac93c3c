// SPDX-License-Identifier: MIT
#include "cli/allowed.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

#include "libtrack/error.h"

namespace swarmfit::cli {
namespace {

constexpr std::size_t kLongestShown = 60;  // bytes
constexpr double kAnything = 1e6;          // an upper end that only keeps nonsense out is not shown in help
constexpr double kPast64Bits = 18446744073709551616.0;

[[noreturn]] void refuse(const Allowed& allowed, const std::string& word) {
  const char* what = allowed.kind == Allowed::Kind::choice ? "known" : "allowed";
  throw InputError(fmt::format("'{}' is not {}; expected {}", shown(word), what, expected(allowed)));
}

std::string whole_text(double value) {
  return value < kPast64Bits ? fmt::format("{:.0f}", value) : std::to_string(std::numeric_limits<std::uint64_t>::max());
}

bool inside(const Allowed& allowed, double value) {
  return std::isfinite(value) && value <= allowed.upper && (allowed.open ? value > allowed.lower : value >= allowed.lower);
}

// Whether the text is a number of this type and nothing else.
template <class Number>
bool parse(std::string_view text, Number& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

// Seeds take all 64 bits, which a double does not hold; an interval's ends it does.
std::string checked_whole(const Allowed& allowed, const std::string& word) {
  std::uint64_t natural = 0;
  std::int64_t integer = 0;
  if (parse(word, natural) && inside(allowed, static_cast<double>(natural))) return fmt::format("{}", natural);
  if (parse(word, integer) && inside(allowed, static_cast<double>(integer))) return fmt::format("{}", integer);
  refuse(allowed, word);
}

std::string checked_number(const Allowed& allowed, const std::string& word) {
  double value = 0;
  if (!parse(word, value) || !inside(allowed, value)) refuse(allowed, word);
  return fmt::format("{}", value);
}

// "90", "45min", "12 h" as seconds.
std::string checked_time(const Allowed& allowed, const std::string& word) {
  std::size_t unit = word.size();
  while (unit > 0 && std::isalpha(static_cast<unsigned char>(word[unit - 1])) != 0) --unit;
  std::string name = word.substr(unit), digits = word.substr(0, unit);
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  while (!digits.empty() && digits.back() == ' ') digits.pop_back();
  const double seconds = name.empty() || name == "s" ? 1 : name == "min" ? 60 : name == "h" ? 3600 : 0;
  double value = 0;
  if (seconds == 0 || !parse(digits, value) || !inside(allowed, value * seconds)) refuse(allowed, word);
  return fmt::format("{}", value * seconds);
}

}  // namespace

std::string checked(const Allowed& allowed, const std::string& word) {
  switch (allowed.kind) {
    case Allowed::Kind::whole:
      return checked_whole(allowed, word);
    case Allowed::Kind::number:
      return checked_number(allowed, word);
    case Allowed::Kind::time:
      return checked_time(allowed, word);
    case Allowed::Kind::flag:
      if (word != "true" && word != "false") refuse(allowed, word);
      return word;
    case Allowed::Kind::choice:
      if (std::find(allowed.choices.begin(), allowed.choices.end(), word) == allowed.choices.end()) refuse(allowed, word);
      return word;
    case Allowed::Kind::text:
      break;
  }
  return word;
}

std::vector<std::string> split_outside_brackets(std::string_view text) {
  std::vector<std::string> parts(1);
  int depth = 0;
  for (const char c : text) {
    depth += (c == '[') - (c == ']');
    if (c == ',' && depth == 0)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

std::string expected(const Allowed& a) {
  switch (a.kind) {
    case Allowed::Kind::whole:
      return fmt::format("a whole number from {:.0f} to {}", a.lower, whole_text(a.upper));
    case Allowed::Kind::number:
      return a.open ? fmt::format("a number above {:g}, at most {:g}", a.lower, a.upper)
                    : fmt::format("a number from {:g} to {:g}", a.lower, a.upper);
    case Allowed::Kind::time:
      return fmt::format("a time above 0 such as 90, 45min or 12h, at most {:g} s", a.upper);
    case Allowed::Kind::flag:
      return "true or false";
    case Allowed::Kind::choice:
      return fmt::format("{}", fmt::join(a.choices, a.choices.size() == 2 ? " or " : ", "));
    case Allowed::Kind::text:
      break;
  }
  return "text";
}

std::string label(const Allowed& a) {
  switch (a.kind) {
    case Allowed::Kind::whole:
      if (a.upper >= kAnything) return a.lower > 0 ? "INT:POSITIVE" : "INT:NONNEGATIVE";
      return fmt::format("INT in [{:.0f} - {:.0f}]", a.lower, a.upper);
    case Allowed::Kind::number:
      if (a.upper >= kAnything) return a.open ? "FLOAT:POSITIVE" : "FLOAT:NONNEGATIVE";
      return fmt::format("FLOAT in {}{:g} - {:g}]", a.open ? '(' : '[', a.lower, a.upper);
    case Allowed::Kind::time:
      return "TIME";
    case Allowed::Kind::flag:
      return "";
    case Allowed::Kind::choice:
      return fmt::format("TEXT:{{{}}}", fmt::join(a.choices, ","));
    case Allowed::Kind::text:
      break;
  }
  return "TEXT";
}

std::string shown(std::string_view word) {
  std::string out;
  for (const char c : word.substr(0, kLongestShown)) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '\n')
      out += "\\n";
    else if (byte < 0x20 || byte == 0x7f)
      out += fmt::format("\\x{:02x}", byte);
    else
      out += c;
  }
  return word.size() > kLongestShown ? out + "..." : out;
}

}  // namespace swarmfit::cli
