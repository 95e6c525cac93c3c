// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "libtrack/columns.h"
#include "libtrack/raw_table.h"
#include "libtrack/text_header.h"

namespace swarmfit {

// All rows of a delimited text under a given mapping of its columns.
RawTable read_rows(const std::string& name, std::string_view bytes, const TextHeader& header, const ColumnMap& map);

}  // namespace swarmfit
