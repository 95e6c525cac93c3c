// SPDX-License-Identifier: MIT
// Movebank CSV: timestamp (UTC), location-long, location-lat, individual-local-identifier. Rows that Movebank marks as not visible are
// outliers.
#include <fmt/format.h>

#include <algorithm>

#include "libtrack/nan.h"
#include "libtrack/read/read_text.h"

namespace swarmfit {
namespace {

bool recognises(const Source& source, const ReadOptions& options) {
  if (!options.columns.empty() || !looks_like_text(source)) return false;
  const auto line = source.bytes.substr(0, source.bytes.find('\n'));
  return line.find("location-long") != std::string_view::npos && line.find("individual-local-identifier") != std::string_view::npos;
}

RawTable read(const Source& source, const ReadOptions& options) {
  const auto header = look_at_text(source.name, source.bytes, options);
  ColumnMap map{.of = std::vector<FileColumn>(header.names.size(), FileColumn::skip), .degrees = true};
  Cells cells;
  const auto take = [&](std::string_view name, FileColumn as) { map.of[column_named(name, header, source.name, "Movebank")] = as; };
  take("timestamp", FileColumn::t);
  take("location-long", FileColumn::x);
  take("location-lat", FileColumn::y);
  take("individual-local-identifier", FileColumn::id);
  if (std::find(header.names.begin(), header.names.end(), "visible") != header.names.end())
    cells.words_in = column_named("visible", header, source.name, "Movebank");
  map.spec = by_name(map, header.names);
  auto table = read_rows(source, header, map, options, &cells);
  std::size_t hidden = 0;
  for (std::size_t row = 0; row < cells.word.size(); ++row) {
    const auto& word = cells.words.names()[cells.word[row]];
    if (word != "false" && word != "FALSE") continue;
    table[FileColumn::x][row] = kNaN;
    ++hidden;
  }
  if (hidden > 0) table.notes.push_back(fmt::format("{} rows are marked as outliers (visible: false)", hidden));
  return table;
}

}  // namespace

const Reader kMovebank = {{"movebank", "Movebank CSV: time stamps and degrees, projected to metres", ".csv"}, recognises, read};

}  // namespace swarmfit
