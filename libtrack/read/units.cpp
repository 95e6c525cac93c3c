// SPDX-License-Identifier: MIT
#include "libtrack/read/units.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

#include "libtrack/text_scan.h"

namespace swarmfit {
namespace {

struct Spelling {
  std::string_view written, unit;
};

constexpr std::array kLengths = {
    Spelling{"nm", "nm"},         Spelling{"nanometer", "nm"},  Spelling{"nanometre", "nm"},  Spelling{"um", "um"},
    Spelling{"\xC2\xB5m", "um"},  // micro sign
    Spelling{"\xCE\xBCm", "um"},  // Greek mu
    Spelling{"\xB5m", "um"},      // micro sign in Latin-1
    Spelling{"micron", "um"},     Spelling{"micrometer", "um"}, Spelling{"micrometre", "um"}, Spelling{"mm", "mm"},
    Spelling{"millimeter", "mm"}, Spelling{"millimetre", "mm"}, Spelling{"cm", "cm"},         Spelling{"centimeter", "cm"},
    Spelling{"centimetre", "cm"}, Spelling{"dm", "dm"},         Spelling{"m", "m"},           Spelling{"meter", "m"},
    Spelling{"metre", "m"},       Spelling{"km", "km"},         Spelling{"kilometer", "km"},  Spelling{"kilometre", "km"},
    Spelling{"in", "in"},         Spelling{"inch", "in"},       Spelling{"inche", "in"},      Spelling{"ft", "ft"},
    Spelling{"feet", "ft"},       Spelling{"px", "px"},         Spelling{"pix", "px"},        Spelling{"pixel", "px"},
    Spelling{"bl", "bl"},
};

struct Duration {
  std::string_view written;
  TimeUnit unit;
};

constexpr double kLeastFactor = 1e-9, kLargestFactor = 1e9;  // of a unit of time

constexpr std::array kDurations = {
    Duration{"ns", {1, 1e9}},        Duration{"nsec", {1, 1e9}},        Duration{"nanosecond", {1, 1e9}},
    Duration{"us", {1, 1e6}},        Duration{"usec", {1, 1e6}},        Duration{"microsecond", {1, 1e6}},
    Duration{"\xC2\xB5s", {1, 1e6}}, Duration{"\xCE\xBCs", {1, 1e6}},   Duration{"\xB5s", {1, 1e6}},
    Duration{"ms", {1, 1e3}},        Duration{"msec", {1, 1e3}},        Duration{"milli", {1, 1e3}},
    Duration{"millisec", {1, 1e3}},  Duration{"millisecond", {1, 1e3}}, Duration{"s", {1, 1}},
    Duration{"sec", {1, 1}},         Duration{"second", {1, 1}},        Duration{"min", {60, 1}},
    Duration{"minute", {60, 1}},     Duration{"h", {3600, 1}},          Duration{"hr", {3600, 1}},
    Duration{"hour", {3600, 1}},     Duration{"d", {86400, 1}},         Duration{"day", {86400, 1}},
};

std::string_view without_brackets(std::string_view text) {
  const auto outer = [](char c) { return c == ' ' || c == '\t' || c == '[' || c == ']' || c == '(' || c == ')'; };
  while (!text.empty() && outer(text.front())) text.remove_prefix(1);
  while (!text.empty() && outer(text.back())) text.remove_suffix(1);
  return text;
}

// In the table as it is, or without the s of the plural.
template <class Table>
auto find(const Table& table, std::string_view text) {
  const std::string word = lower(without_brackets(text));
  const auto by = [&](std::string_view wanted) {
    return std::find_if(table.begin(), table.end(), [&](const auto& row) { return row.written == wanted; });
  };
  auto hit = by(word);
  if (hit == table.end() && word.size() > 3 && word.back() == 's') hit = by(std::string_view(word).substr(0, word.size() - 1));
  return hit;
}

// "x in cm" and "x_cm": the last word is a unit, and what stands before it can have one. "x_min" is no time, "x_in" no inch.
bool cut_last_word(std::string_view& name, std::string& unit) {
  const auto cut = name.find_last_of(" _");
  if (cut == std::string_view::npos || cut == 0 || cut + 1 == name.size()) return false;
  const auto word = name.substr(cut + 1);
  auto rest = without_brackets(name.substr(0, cut));
  const bool in = rest.size() > 3 && lower(rest.substr(rest.size() - 3)) == " in";
  if (in) rest = without_brackets(rest.substr(0, rest.size() - 3));
  const auto stem = lower(rest);
  const bool time = stem == "t" || stem.find("time") != std::string::npos, axis = stem == "x" || stem == "y" || stem == "z";
  if (time ? !time_unit(word) : !length_unit(word)) return false;
  // A short word may as well be part of a name.
  if (!in && (lower(word) == "in" || (word.size() < 2 && !axis))) return false;
  unit = word;
  name = rest;
  return true;
}

}  // namespace

std::optional<std::string> length_unit(std::string_view text) {
  const auto hit = find(kLengths, text);
  return hit == kLengths.end() ? std::nullopt : std::optional(std::string(hit->unit));
}

std::optional<TimeUnit> time_unit(std::string_view text) {
  const auto hit = find(kDurations, text);
  return hit == kDurations.end() ? std::nullopt : std::optional(hit->unit);
}

std::optional<TimeUnit> scaled_time_unit(std::string_view text) {
  double number = 1;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return time_unit(text);
  const auto unit = time_unit(text.substr(static_cast<std::size_t>(rest - text.data())));
  if (!unit || !(number >= kLeastFactor && number <= kLargestFactor)) return std::nullopt;
  TimeUnit out = *unit;
  const double inverse = 1 / number;  // 0.01 is no double, but 1 / 100 is one division
  (inverse > 1 && inverse == std::round(inverse) ? out.per *= inverse : out.times *= number);
  return out;
}

ColumnName column_name(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  ColumnName out;
  const auto cut = text.find_first_of("[(/");
  if (cut != std::string_view::npos && cut > 0) {
    auto unit = text.substr(cut + 1);
    if (text[cut] != '/') unit = unit.substr(0, unit.find_first_of("])"));
    out.unit = without_brackets(unit);
    text = without_brackets(text.substr(0, cut));
    if (out.unit.starts_with("in ")) out.unit.erase(0, 3);
  } else {
    cut_last_word(text, out.unit);
  }
  out.title = text;
  out.name = lower(text);
  for (char& c : out.name)
    if (c == ' ' || c == '-' || c == '.' || c == ':') c = '_';
  return out;
}

}  // namespace swarmfit
