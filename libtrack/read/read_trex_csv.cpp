// SPDX-License-Identifier: MIT
// TRex CSV, one file per individual, named by the file: frame, time, X#wcentroid (cm), Y#wcentroid (cm), missing. The centroid weighted by
// pixels is the individual; X and Y alone are the head. y points down.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "libtrack/error.h"
#include "libtrack/read/read_text.h"

namespace swarmfit {
namespace {

bool recognises(const Source& source, const ReadOptions& options) {
  if (!options.columns.empty() || !looks_like_text(source)) return false;
  bool frame = false, centroid = false;
  for (const auto& field : split_fields(source.bytes.substr(0, source.bytes.find_first_of("\r\n")), ',')) {
    const auto name = column_name(field).name;
    if (name == "id") return false;  // a table of several individuals, made of such files
    frame = frame || name == "frame";
    centroid = centroid || name == "x#wcentroid";
  }
  return frame && centroid;
}

RawTable read(const Source& source, const ReadOptions& options) {
  const auto header = look_at_text(source.name, source.bytes, options);
  ColumnMap map{.of = std::vector<FileColumn>(header.names.size(), FileColumn::skip)};
  const auto take = [&](std::string_view wanted, FileColumn as) {
    for (std::size_t i = 0; i < header.names.size(); ++i) {
      const auto column = column_name(header.names[i]);
      if (column.name != wanted || map.has(as)) continue;  // "frame" may stand twice
      map.of[i] = as;
      if (as == FileColumn::x || as == FileColumn::y) map.unit = length_unit(column.unit).value_or("");
    }
  };
  take("frame", FileColumn::frame);
  take("time", FileColumn::t);
  take("x#wcentroid", FileColumn::x);
  take("y#wcentroid", FileColumn::y);
  for (const auto& [column, name] : {std::pair{FileColumn::frame, "frame"}, {FileColumn::x, "X#wcentroid"}, {FileColumn::y, "Y#wcentroid"}})
    if (!map.has(column))
      throw InputError(at(source.name, header.names_line, 0,
                          fmt::format("there is no column {} among {}; expected it (export it from TRex)", name, listed(header.names))));
  map.spec = by_name(map, header.names);
  auto table = read_rows(source, header, map, options);
  TrackNames names;
  names.number(std::filesystem::path(source.name).stem().string());
  table.names = std::move(names);
  std::erase_if(table.notes, [](const std::string& note) { return note.starts_with("the file has no id column"); });
  table.notes.emplace_back("the file is one individual (--join reads a folder of them)");
  return table;
}

}  // namespace

const Reader kTrexCsv = {{"trex-csv", "TRex, one file per individual: frame, X#wcentroid, Y#wcentroid", ".csv"}, recognises, read};

}  // namespace swarmfit
