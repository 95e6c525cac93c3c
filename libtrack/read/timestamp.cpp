// SPDX-License-Identifier: MIT
#include "libtrack/read/timestamp.h"

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

std::optional<double> take_clock(std::string_view& text) {
  const auto hour = take_digits(text, 1, 2);
  if (!hour || !take(text, ':')) return std::nullopt;
  const auto minute = take_digits(text, 2, 2);
  if (!minute || *minute > 59) return std::nullopt;
  double seconds = 0;
  if (take(text, ':')) {
    const auto whole = take_digits(text, 2, 2);
    if (!whole || *whole > 60) return std::nullopt;  // 60: a leap second
    const auto fraction = take_fraction(text);
    if (!fraction) return std::nullopt;
    seconds = *whole + *fraction;
  }
  const double total = 3600.0 * *hour + 60.0 * *minute + seconds;
  return total <= 86400.0 ? std::optional(total) : std::nullopt;
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
  const std::chrono::year_month_day date{std::chrono::year(*year), std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*day))};
  if (!date.ok()) return std::nullopt;
  return 86400.0 * static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count());
}

// "Z", "+HH:MM", "-HHMM" or nothing, in seconds east of Greenwich.
std::optional<double> take_zone(std::string_view& text) {
  if (text.empty() || take(text, 'Z')) return 0.0;
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
  const auto date = take_date(text);
  if (!date) return std::nullopt;
  if (!take(text, 'T') && !take(text, ' ')) return std::nullopt;
  const auto clock = take_clock(text);
  if (!clock) return std::nullopt;
  const auto zone = take_zone(text);
  if (!zone || !text.empty()) return std::nullopt;
  return *date + *clock - *zone;
}

}  // namespace swarmfit
