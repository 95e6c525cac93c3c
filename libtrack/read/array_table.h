// SPDX-License-Identifier: MIT
// From plain arrays of numbers, which say nothing about themselves, to a table of rows.
#pragma once

#include <string>
#include <vector>

#include "libtrack/read/npy.h"
#include "libtrack/read/raw_table.h"

namespace swarmfit {

// Arrays in one dimension and of one length are columns, known by their names or by --columns id=NAME,x=NAME,…. Otherwise one array is
// read, that of --var where there are several: rows x columns, with --columns for the columns, or positions of all individuals in all
// frames, with --columns frame,id,x,y[,z] or id,frame,x,y[,z] to say which axis is which. Throws InputError that says what to give.
RawTable array_table(const std::string& file, const std::vector<NumberArray>& arrays, const ReadOptions& options);

}  // namespace swarmfit
