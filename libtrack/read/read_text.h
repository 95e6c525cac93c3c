// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "libtrack/read/columns.h"
#include "libtrack/read/raw_table.h"
#include "libtrack/read/text_header.h"

namespace swarmfit {

// All rows of a delimited text under a given mapping of its columns.
RawTable read_rows(const std::string& name, std::string_view bytes, const TextHeader& header, const ColumnMap& map);

}  // namespace swarmfit
