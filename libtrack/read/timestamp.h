// SPDX-License-Identifier: MIT
// Clock times and dates in recordings.
#pragma once

#include <optional>
#include <string_view>

namespace swarmfit {

// Seconds since midnight of "H:MM", "H:MM:SS" or "H:MM:SS.fff" (0:00 to 24:00, or 1 to 12 with AM or PM behind); nothing when the text
// is no such time.
std::optional<double> parse_clock(std::string_view text);

// Seconds from 1970-01-01 to the start of "YYYY-MM-DD" (also with '/').
std::optional<double> parse_date(std::string_view text);

// Seconds since 1970-01-01 of an ISO 8601 date and time "YYYY-MM-DDTHH:MM:SS[.fff][Z|UTC|+HH:MM]", 'T' or a blank between, or without
// separators "YYYYMMDDTHHMMSS[Z]"; or a clock time as above.
std::optional<double> parse_timestamp(std::string_view text);

// The two readings of "3/4/2021" and "3/4/2021 11:59:00", seconds since 1970-01-01; of "31/1/2021" there is one only.
struct DayAndMonth {
  std::optional<double> day_first, month_first;
};
std::optional<DayAndMonth> parse_day_and_month(std::string_view text);

}  // namespace swarmfit
