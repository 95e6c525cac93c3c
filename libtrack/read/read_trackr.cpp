// SPDX-License-Identifier: MIT
// trackR (package trackdf): id,x,y,size,frame,track,ignore,track_fixed in pixels. `track_fixed` is the individual once its tracks were
// mended, `id` numbers the objects of a frame; rows to be ignored are left out.
#include <fmt/format.h>

#include <array>

#include "libtrack/nan.h"
#include "libtrack/read/read_text.h"

namespace swarmfit {
namespace {

bool recognises(const Source& source, const ReadOptions& options) {
  if (!options.columns.empty() || !looks_like_text(source)) return false;
  const auto line = source.bytes.substr(0, source.bytes.find('\n'));
  return line.find("track_fixed") != std::string_view::npos && line.find("ignore") != std::string_view::npos;
}

RawTable read(const Source& source, const ReadOptions& options) {
  const auto header = look_at_text(source.name, source.bytes, options);
  ColumnMap map{.of = std::vector<FileColumn>(header.names.size(), FileColumn::skip)};
  Cells cells;
  constexpr std::array wanted = {std::pair{"x", FileColumn::x}, std::pair{"y", FileColumn::y}, std::pair{"frame", FileColumn::frame},
                                 std::pair{"track_fixed", FileColumn::id}, std::pair{"ignore", FileColumn::skip}};
  for (const auto& [name, column] : wanted) {
    const std::size_t i = column_named(name, header, source.name, "trackR");
    map.of[i] = column;
    if (column == FileColumn::skip) cells.words_in = i;
  }
  map.spec = by_name(map, header.names);
  auto table = read_rows(source, header, map, options, &cells);
  std::size_t ignored = 0;
  for (std::size_t row = 0; row < table.track.size(); ++row) {
    const auto& word = cells.words.names()[cells.word[row]];
    if (word != "TRUE" && word != "true" && word != "1") continue;
    table[FileColumn::x][row] = kNaN;
    ++ignored;
  }
  table.notes.emplace_back(
      "'track_fixed' is the individual ('track' is it before tracks were mended, 'id' numbers the objects of a frame)");
  if (ignored > 0) table.notes.push_back(fmt::format("{} rows are marked to be ignored", ignored));
  table.unit = "px";
  return table;
}

}  // namespace

const Reader kTrackR = {
    {"trackr", "trackR, as package trackdf has it: id,x,y,size,frame,track,ignore,track_fixed", ".csv"}, recognises, read};

}  // namespace swarmfit
