// SPDX-License-Identifier: MIT
// Any spreadsheet (.xlsx) with a table in it: a sheet is read as the delimited text that it would be saved as, by whichever reader of
// text knows it.
#include <fmt/format.h>

#include <algorithm>

#include "libtrack/error.h"
#include "libtrack/read/formats.h"
#include "libtrack/read/xlsx.h"

namespace swarmfit {
namespace {

constexpr std::size_t kMostCells = 50'000'000;

bool recognises(const Source& source, const ReadOptions&) {
  return is_zip(source.bytes) && ZipFile(source.name, source.bytes).has(kWorkbook);
}

// Between commas; quoted where it must be; rows as long as the longest.
std::string as_text(const std::string& file, const Sheet& sheet) {
  std::size_t width = 0;
  for (const auto& row : sheet.rows) width = std::max(width, row.size());
  if (width * sheet.rows.size() > kMostCells)
    throw InputError(
        fmt::format("{}: sheet '{}' has {} rows of up to {} cells; expected a table", file, sheet.name, sheet.rows.size(), width));
  std::string out;
  for (const auto& row : sheet.rows) {
    for (std::size_t c = 0; c < width; ++c) {
      if (c > 0) out += ',';
      if (c >= row.size()) continue;
      if (row[c].find_first_of(",\"\r\n") == std::string::npos) {
        out += row[c];
        continue;
      }
      out += '"';
      for (const char letter : row[c]) out += letter == '"' ? "\"\"" : letter == '\n' || letter == '\r' ? " " : std::string(1, letter);
      out += '"';
    }
    out += '\n';
  }
  return out;
}

const Sheet& choose(const std::vector<Sheet>& sheets, const std::string& file, const ReadOptions& options) {
  std::vector<std::string> names;
  std::vector<const Sheet*> full;
  for (const auto& sheet : sheets) {
    names.push_back(sheet.name);
    if (options.variable.empty() ? !sheet.rows.empty() : sheet.name == options.variable) full.push_back(&sheet);
  }
  if (full.size() == 1 && !full[0]->rows.empty()) return *full[0];
  throw InputError(fmt::format("{}: the spreadsheet has the sheets {}; expected {}", file, listed(names),
                               full.empty() || !options.variable.empty() ? "one with a table" : "`var` SHEET to choose one"));
}

RawTable read(const Source& source, const ReadOptions& options) {
  if (!recognises(source, options)) throw InputError(source.name + ": this is not a spreadsheet; expected .xlsx");
  const auto sheets = read_xlsx(source.name, ZipFile(source.name, source.bytes));
  const auto& sheet = choose(sheets, source.name, options);
  const auto text = as_text(source.name, sheet);
  ReadOptions as_csv = options;
  as_csv.delimiter = ',';
  as_csv.format.clear();
  as_csv.variable.clear();
  const Source as_saved{source.name, text};
  auto table = text_reader(as_saved, as_csv).read(as_saved, as_csv);
  table.notes.push_back(fmt::format("the table is that of sheet '{}'", sheet.name));
  return table;
}

}  // namespace

const Reader kSpreadsheet = {{"xlsx", "any table in a spreadsheet", ".xlsx"}, recognises, read};

}  // namespace swarmfit
