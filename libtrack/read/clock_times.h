// SPDX-License-Identifier: MIT
// Time columns that need the whole file to be understood.
#pragma once

#include <string>
#include <vector>

#include "libtrack/read/raw_table.h"

namespace swarmfit {

// Clock times without a date that pass midnight go on beyond 24 h, with a note. The longest time of day at which nothing was recorded is
// taken for the break between end and start. Throws InputError when a track passes midnight more often than once.
void go_on_over_midnight(RawTable& table);

// `table` has times with the day first, `month_first` those with the month first (NaN: impossible); one for every row. Keeps the possible
// one, or that of --dates. Throws InputError when both are possible, or neither is.
void settle_dates(RawTable& table, const std::vector<double>& month_first, const std::string& order);

// Throws InputError when clock times fall back by an hour within a track, as they do where summer time ends.
void refuse_end_of_summer_time(const RawTable& table);

// Throws InputError when bare numbers cannot be seconds: so large that they must be milliseconds since 1970, or so close at tens of
// thousands that they must be days, as spreadsheets and MATLAB count them.
void refuse_other_units(const RawTable& table);

}  // namespace swarmfit
