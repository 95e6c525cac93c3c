// SPDX-License-Identifier: MIT
// Imaris statistics "Position": Position X,Position Y,Position Z,Unit,Category,Collection,Time,TrackID,ID below a title. TrackID is the
// individual, ID numbers rows; Time is the number of the time point, from 1.
#include <algorithm>
#include <array>

#include "libtrack/error.h"
#include "libtrack/read/read_text.h"

namespace swarmfit {
namespace {

bool recognises(const Source& source, const ReadOptions& options) {
  return options.columns.empty() && looks_like_text(source) &&
         source.bytes.substr(0, 4096).find("Position X,Position Y,Position Z,Unit,Category") != std::string_view::npos;
}

RawTable read(const Source& source, const ReadOptions& options) {
  const auto header = look_at_text(source.name, source.bytes, options);
  ColumnMap map{.of = std::vector<FileColumn>(header.names.size(), FileColumn::skip)};
  Cells cells;
  const auto find = [&](std::string_view column) { return column_named(column, header, source.name, "Imaris"); };
  map.of[find("TrackID")] = FileColumn::id;
  map.of[find("Position X")] = FileColumn::x;
  map.of[find("Position Y")] = FileColumn::y;
  map.of[find("Position Z")] = FileColumn::z;
  map.of[find("Time")] = FileColumn::frame;
  cells.words_in = find("Unit");
  map.spec = by_name(map, header.names);
  auto table = read_rows(source, header, map, options, &cells);
  if (cells.words.names().size() != 1)
    throw InputError(source.name + ": the column Unit has several units; expected one length unit for all rows");
  table.unit = length_unit(cells.words.names()[0]).value_or(cells.words.names()[0]);
  if (!options.fps) {
    table.dt = 1;
    table.notes.emplace_back(
        "Time numbers the time points, and Imaris does not say how far apart they are: one step counts as 1 s (--fps)");
  }
  auto& z = table[FileColumn::z];
  if (std::all_of(z.begin(), z.end(), [&](double v) { return v == z[0]; })) {
    z = {};
    table.notes.emplace_back("z is the same in every row: the recording is two-dimensional");
  }
  return table;
}

}  // namespace

const Reader kImaris = {{"imaris", "Imaris statistics of positions", ".csv"}, recognises, read};

}  // namespace swarmfit
