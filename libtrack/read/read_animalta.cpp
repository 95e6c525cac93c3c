// SPDX-License-Identifier: MIT
// AnimalTA with a variable number of individuals: Frame;Time;Arena;Ind;X;Y, one row per individual and frame. Individuals are numbered
// within their arena. Time is written without leading zeros of its decimals (0.03, 0.07, 0.01, 0.13) and cannot be used. With a fixed
// number it writes a wide table, X_Arena0_Ind0, which read_wide.cpp reads.
#include <fmt/format.h>

#include "libtrack/read/read_text.h"

namespace swarmfit {
namespace {

bool recognises(const Source& source, const ReadOptions& options) {
  return options.columns.empty() && looks_like_text(source) && source.bytes.starts_with("Frame;Time;Arena;Ind;X;Y");
}

RawTable read(const Source& source, const ReadOptions& options) {
  const auto header = look_at_text(source.name, source.bytes, options);
  ColumnMap map{.of = std::vector<FileColumn>(header.names.size(), FileColumn::skip)};
  Cells cells;
  const auto find = [&](std::string_view column) { return column_named(column, header, source.name, "AnimalTA"); };
  map.of[find("Frame")] = FileColumn::frame;
  map.of[find("Ind")] = FileColumn::id;
  map.of[find("X")] = FileColumn::x;
  map.of[find("Y")] = FileColumn::y;
  cells.words_in = find("Arena");
  map.spec = by_name(map, header.names);
  auto table = read_rows(source, header, map, options, &cells);
  TrackNames names;
  for (std::size_t row = 0; row < table.track.size(); ++row) {
    if (table.track[row] == RawTable::no_track) continue;
    table.track[row] =
        names.number(fmt::format("Arena{}_Ind{}", cells.words.names()[cells.word[row]], table.names.names()[table.track[row]]));
  }
  table.names = std::move(names);
  table.notes.emplace_back("Time was not used: AnimalTA writes its decimals without leading zeros");
  return table;
}

}  // namespace

const Reader kAnimalTa = {
    {"animalta", "AnimalTA with a variable number of individuals: Frame;Time;Arena;Ind;X;Y", ".csv"}, recognises, read};

}  // namespace swarmfit
