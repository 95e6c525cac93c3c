// SPDX-License-Identifier: MIT
#include "libtrack/read/timestamp.h"

#include <cctype>
#include <charconv>
#include <chrono>

namespace swarmfit {
namespace {

// Reads `least` to `most` digits from the front.
std::optional<int> take_digits(std::string_view& text, std::size_t least, std::size_t most) {
  std::size_t n = 0;
  while (n < text.size() && n < most && text[n] >= '0' && text[n] <= '9') ++n;
  if (n < least) return std::nullopt;
  int value = 0;
  std::from_chars(text.data(), text.data() + n, value);
  text.remove_prefix(n);
  return value;
}

bool take(std::string_view& text, char c) {
  if (text.empty() || text.front() != c) return false;
  text.remove_prefix(1);
  return true;
}

// ".fff" → 0.fff; nothing is 0.
std::optional<double> take_fraction(std::string_view& text) {
  if (text.empty() || (text.front() != '.' && text.front() != ',')) return 0.0;
  text.remove_prefix(1);
  double value = 0, unit = 1;
  std::size_t digits = 0;
  while (!text.empty() && text.front() >= '0' && text.front() <= '9') {
    value = 10 * value + (text.front() - '0');
    unit *= 10;
    ++digits;
    text.remove_prefix(1);
  }
  if (digits == 0 || digits > 15) return std::nullopt;
  return value / unit;
}

// The word in either case, behind blanks or none.
bool take_word(std::string_view& text, std::string_view word) {
  auto rest = text;
  while (take(rest, ' '))
    ;
  if (rest.size() < word.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i)
    if (std::toupper(static_cast<unsigned char>(rest[i])) != word[i]) return false;
  text = rest.substr(word.size());
  return true;
}

// Twelve hours twice a day, where AM or PM follows: 12 AM is midnight.
std::optional<double> take_half(std::string_view& text, int hour, double seconds) {
  const bool morning = take_word(text, "AM") || take_word(text, "A.M.");
  const bool evening = !morning && (take_word(text, "PM") || take_word(text, "P.M."));
  if (!morning && !evening) return seconds;
  if (hour < 1 || hour > 12) return std::nullopt;
  return seconds + (hour == 12 ? -43200.0 : 0.0) + (evening ? 43200.0 : 0.0);
}

// "HH:MM[:SS[.fff]] [AM|PM]", or "HHMM[SS[.fff]]" of ISO 8601 without separators.
std::optional<double> take_clock(std::string_view& text, bool basic = false) {
  const auto hour = basic ? take_digits(text, 2, 2) : take_digits(text, 1, 2);
  if (!hour || (!basic && !take(text, ':'))) return std::nullopt;
  const auto minute = take_digits(text, 2, 2);
  if (!minute || *minute > 59) return std::nullopt;
  double seconds = 0;
  if (basic ? !text.empty() && std::isdigit(static_cast<unsigned char>(text.front())) : take(text, ':')) {
    const auto whole = take_digits(text, 2, 2);
    if (!whole || *whole > 60) return std::nullopt;  // 60: a leap second
    const auto fraction = take_fraction(text);
    if (!fraction) return std::nullopt;
    seconds = *whole + *fraction;
  }
  const double total = 3600.0 * *hour + 60.0 * *minute + seconds;
  if (total > 86400.0) return std::nullopt;
  return take_half(text, *hour, total);
}

std::optional<double> days(int year, int month, int day) {
  const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok()) return std::nullopt;
  return 86400.0 * static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count());
}

// "YYYYMMDD" of ISO 8601 without separators.
std::optional<double> take_basic_date(std::string_view& text) {
  const auto year = take_digits(text, 4, 4), month = take_digits(text, 2, 2), day = take_digits(text, 2, 2);
  return year && month && day ? days(*year, *month, *day) : std::nullopt;
}

std::optional<double> take_date(std::string_view& text) {
  const auto year = take_digits(text, 4, 4);
  if (!year || text.empty() || (text.front() != '-' && text.front() != '/')) return std::nullopt;
  const char separator = text.front();
  text.remove_prefix(1);
  const auto month = take_digits(text, 1, 2);
  if (!month || !take(text, separator)) return std::nullopt;
  const auto day = take_digits(text, 1, 2);
  if (!day) return std::nullopt;
  return days(*year, *month, *day);
}

// "Z", "+HH:MM", "-HHMM" or nothing, in seconds east of Greenwich.
std::optional<double> take_zone(std::string_view& text) {
  if (text.empty() || take(text, 'Z') || take_word(text, "UTC") || take_word(text, "GMT")) return 0.0;
  const double sign = text.front() == '-' ? -1 : 1;
  if (!take(text, '+') && !take(text, '-')) return std::nullopt;
  const auto hours = take_digits(text, 2, 2);
  if (!hours) return std::nullopt;
  take(text, ':');
  const auto minutes = take_digits(text, 0, 2);
  return sign * (3600.0 * *hours + 60.0 * minutes.value_or(0));
}

}  // namespace

std::optional<double> parse_clock(std::string_view text) {
  const auto seconds = take_clock(text);
  return text.empty() ? seconds : std::nullopt;
}

std::optional<double> parse_date(std::string_view text) {
  const auto seconds = take_date(text);
  return text.empty() ? seconds : std::nullopt;
}

std::optional<double> parse_timestamp(std::string_view text) {
  if (const auto clock = parse_clock(text)) return clock;
  const bool basic = text.size() > 9 && text[8] == 'T' && text.find_first_of("-/:") > 8;
  const auto date = basic ? take_basic_date(text) : take_date(text);
  if (!date) return std::nullopt;
  if (!take(text, 'T') && !take(text, ' ')) return std::nullopt;
  const auto clock = take_clock(text, basic);
  if (!clock) return std::nullopt;
  const auto zone = take_zone(text);
  if (!zone || !text.empty()) return std::nullopt;
  return *date + *clock - *zone;
}

std::optional<DayAndMonth> parse_day_and_month(std::string_view text) {
  const auto first = take_digits(text, 1, 2);
  if (!first || text.empty() || std::string_view("/-.").find(text.front()) == std::string_view::npos) return std::nullopt;
  const char separator = text.front();
  text.remove_prefix(1);
  const auto second = take_digits(text, 1, 2);
  if (!second || !take(text, separator)) return std::nullopt;
  const auto year = take_digits(text, 4, 4);
  if (!year) return std::nullopt;
  double seconds = 0;
  if (!text.empty()) {
    if (!take(text, ' ') && !take(text, 'T')) return std::nullopt;
    const auto clock = take_clock(text);
    if (!clock) return std::nullopt;
    const auto zone = take_zone(text);
    if (!zone || !text.empty()) return std::nullopt;
    seconds = *clock - *zone;
  }
  DayAndMonth out{days(*year, *second, *first), days(*year, *first, *second)};
  if (separator == '.') out.month_first.reset();  // nobody writes dots between month and day
  if (!out.day_first && !out.month_first) return std::nullopt;
  if (out.day_first) *out.day_first += seconds;
  if (out.month_first) *out.month_first += seconds;
  return out;
}

}  // namespace swarmfit
