// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "libtrack/read/columns.h"
#include "libtrack/read/text_header.h"

namespace swarmfit {

// Settles which of several columns is the individual: not one that is new in every row, which numbers the rows. Columns that cut the
// rows into the same individuals are as good as one. Throws InputError when two columns are left that disagree. Returns a remark for
// the notes, or nothing.
std::string choose_id(ColumnMap& map, const std::string& name, std::string_view bytes, const TextHeader& header);

}  // namespace swarmfit
