// SPDX-License-Identifier: MIT
#pragma once

#include "libtrack/read/raw_table.h"
#include "libtrack/read/read.h"

namespace swarmfit {

// Values that stand for "not seen": positions with the value of --missing in x and y become NaN, with a note. Without the flag, positions
// that are several times exactly (-1,-1), (0,0), (-999,-999) or the like get a note that offers it.
void leave_out_codes(RawTable& table, const ReadOptions& options);

}  // namespace swarmfit
