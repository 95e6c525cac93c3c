// SPDX-License-Identifier: MIT
#include "libtrack/read/clock_times.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libtrack/error.h"

namespace swarmfit {
namespace {

constexpr double kDay = 86400;

// The first row that lies more than half a day before the last one of the same track; the number of rows when there is none.
std::size_t first_fall(const RawTable& table) {
  const auto& t = table[FileColumn::t];
  std::vector<double> last(table.names.names().size(), -kDay);
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (table.track[i] == RawTable::no_track) continue;
    if (t[i] < last[table.track[i]] - kDay / 2) return i;
    last[table.track[i]] = t[i];
  }
  return t.size();
}

// The end of the longest stretch of the day without a row.
double start_of_day(std::vector<double> t) {
  std::sort(t.begin(), t.end());
  double longest = t.front() + kDay - t.back(), start = t.front();
  for (std::size_t i = 1; i < t.size(); ++i) {
    if (t[i] - t[i - 1] <= longest) continue;
    longest = t[i] - t[i - 1];
    start = t[i];
  }
  return start;
}

// 44197.5 and 44197.5000005 are not half a microsecond apart.
void refuse_days(const RawTable& table) {
  constexpr double least = 2e4, closest = 1e-4;
  const auto& t = table[FileColumn::t];
  double step = HUGE_VAL;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (t[i] < least) return;
    if (i > 0 && t[i] != t[i - 1]) step = std::min(step, std::abs(t[i] - t[i - 1]));
  }
  if (step < closest)
    throw InputError(
        fmt::format("{}: the time {:.10g} and steps of {:.2g} look like days, not seconds; expected `time-unit`, that is "
                    "`time-unit` d or s",
                    table.place(0), t[0], step));
}

}  // namespace

void go_on_over_midnight(RawTable& table) {
  auto& t = table[FileColumn::t];
  const auto fall = first_fall(table);
  if (fall == t.size()) return;
  const double start = start_of_day(t);
  for (double& value : t)
    if (value < start) value += kDay;
  if (const auto again = first_fall(table); again != t.size())
    throw InputError(table.place(again) +
                     ": the clock times fall back by more than half a day; expected times with a date, or one recording "
                     "of less than a day");
  table.notes.push_back(fmt::format("the clock passes midnight (first at {}): times go on beyond 24 h", table.place(fall)));
}

void settle_dates(RawTable& table, const std::vector<double>& month_first, const std::string& order) {
  auto& t = table[FileColumn::t];
  const auto impossible = [](const std::vector<double>& times) {
    return static_cast<std::size_t>(std::find_if(times.begin(), times.end(), [](double v) { return std::isnan(v); }) - times.begin());
  };
  const auto no_day = impossible(t), no_month = impossible(month_first);
  const bool day = no_day == t.size() && order != "month-first", month = no_month == t.size() && order != "day-first";
  if (day && month)
    throw InputError(
        table.place(0) +
        ": dates may have the day or the month first, and none in the file shows which; expected `dates` day-first or `dates` month-first");
  if (!day && !month)
    throw InputError(fmt::format("{}: the date cannot have the {} first; expected dates in one order",
                                 table.place(order == "month-first" ? no_month
                                             : order == "day-first" ? no_day
                                                                    : std::max(no_day, no_month)),
                                 order == "month-first" ? "month"
                                 : order == "day-first" ? "day"
                                 : no_day > no_month    ? "day"
                                                        : "month"));
  if (month) t = month_first;
  if (order.empty()) table.notes.push_back(fmt::format("dates have the {} first: some have no other reading", day ? "day" : "month"));
}

void refuse_end_of_summer_time(const RawTable& table) {
  constexpr double hour = 3600, slack = 60;
  const auto& t = table[FileColumn::t];
  std::vector<double> last(table.names.names().size(), -HUGE_VAL);
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (table.track[i] == RawTable::no_track) continue;
    double& before = last[table.track[i]];
    if (before - t[i] > hour - slack && before - t[i] <= hour)
      throw InputError(table.place(i) + ": the clock falls back by an hour, as where summer time ends; expected times in UTC");
    before = t[i];
  }
}

void refuse_other_units(const RawTable& table) {
  refuse_days(table);
  const auto& t = table[FileColumn::t];
  constexpr double most = 1e11;  // seconds: the year 5138
  const auto hit = std::find_if(t.begin(), t.end(), [](double v) { return std::abs(v) >= most; });
  if (hit == t.end()) return;
  const double value = std::abs(*hit);
  throw InputError(
      fmt::format("{}: the time {:.17g} is too large for seconds, it may be {} since 1970; expected `time-unit`, such as "
                  "`time-unit` {}",
                  table.place(static_cast<std::size_t>(hit - t.begin())), *hit,
                  value < 1e14   ? "milliseconds"
                  : value < 1e17 ? "microseconds"
                                 : "nanoseconds",
                  value < 1e14   ? "ms"
                  : value < 1e17 ? "us"
                                 : "ns"));
}

}  // namespace swarmfit
