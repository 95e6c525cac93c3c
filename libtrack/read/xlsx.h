// SPDX-License-Identifier: MIT
// The cells of spreadsheets (.xlsx: ECMA-376, XML in a zip archive), as texts. Formulas are their stored values; formats are ignored.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "libtrack/read/unpack.h"

namespace swarmfit {

struct Sheet {
  std::string name;
  std::vector<std::vector<std::string>> rows;  // rows may be of different lengths; empty cells are empty texts
};

inline constexpr std::string_view kWorkbook = "xl/workbook.xml";

// All sheets in the book's order. Throws InputError when it is no sound spreadsheet or claims cells far beyond what is there.
std::vector<Sheet> read_xlsx(const std::string& name, const ZipFile& zip);

}  // namespace swarmfit
