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

// Throws InputError when bare numbers of seconds are so large that they must be something else since 1970, such as milliseconds.
void refuse_epochs(const RawTable& table);

}  // namespace swarmfit
