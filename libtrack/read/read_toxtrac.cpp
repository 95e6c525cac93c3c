// SPDX-License-Identifier: MIT
// ToxTrac, after its manual (2017): Tracking_RealSpace*.txt with Time (sec), Arena, Track, Pos. X (mm), Pos. Y (mm), Label, and the same in
// frames and pixels without names as Tracking*.txt. Tracks are numbered within their arena. Label: 0 predicted, 1 confirmed, 2 occluded,
// 3 mirrored; predictions and reflections are not where an animal was seen. https://sourceforge.net/projects/toxtrac
#include <fmt/format.h>

#include <filesystem>

#include "libtrack/error.h"
#include "libtrack/nan.h"
#include "libtrack/read/read_text.h"

namespace swarmfit {
namespace {

enum : std::size_t { kTime, kArena, kTrack, kX, kY, kLabel, kCount };

bool recognises(const Source& source, const ReadOptions& options) {
  if (!options.columns.empty() || !looks_like_text(source)) return false;
  const auto first = source.bytes.substr(0, source.bytes.find_first_of("\r\n"));
  if (first.starts_with("Time (sec)\tArena\tTrack\tPos. X")) return true;
  // Six numbers could be anything, but for the name that the program gives its file.
  if (!std::filesystem::path(source.name).filename().string().starts_with("Tracking") || !source.ends_with(".txt")) return false;
  try {
    const auto header = look_at_text(source.name, source.bytes, options);
    return header.names.empty() && header.first_row.size() == kCount;
  } catch (const InputError&) {
    return false;
  }
}

std::string arena_and_track(const RawTable& table, const Cells& cells, std::size_t row) {
  return fmt::format("Arena{}_Track{}", cells.words.names()[cells.word[row]], table.names.names()[table.track[row]]);
}

// Individuals by arena and track, positions without what was not seen.
void settle(RawTable& table, const Cells& cells) {
  TrackNames names;
  std::size_t predicted = 0, mirrored = 0, occluded = 0;
  for (std::size_t row = 0; row < table.track.size(); ++row) {
    if (table.track[row] != RawTable::no_track) table.track[row] = names.number(arena_and_track(table, cells, row));
    const double label = cells.at(row, 0);
    if (label == 2) ++occluded;
    if (label != 0 && label != 3) continue;
    ++(label == 0 ? predicted : mirrored);
    table[FileColumn::x][row] = table[FileColumn::y][row] = kNaN;
  }
  table.names = std::move(names);
  if (predicted + mirrored > 0)
    table.notes.push_back(
        fmt::format("{} predicted and {} mirrored positions were left out: the animal was not seen there", predicted, mirrored));
  if (occluded > 0) table.notes.push_back(fmt::format("{} positions are of occluded animals", occluded));
  if (cells.words.names().size() > 1)
    table.notes.push_back(
        fmt::format("there are {} arenas, whose animals do not meet (--tracks takes those of one)", cells.words.names().size()));
}

RawTable read(const Source& source, const ReadOptions& options) {
  const auto header = look_at_text(source.name, source.bytes, options);
  if (header.first_row.size() < kCount)
    throw InputError(fmt::format("{}: {} columns; expected those of ToxTrac: time or frame, arena, track, x, y, label", source.name,
                                 header.first_row.size()));
  const bool pixels = header.names.empty();
  ColumnMap map{.of = std::vector<FileColumn>(header.first_row.size(), FileColumn::skip)};
  map.of[kTime] = pixels ? FileColumn::frame : FileColumn::t;
  map.of[kTrack] = FileColumn::id;
  map.of[kX] = FileColumn::x;
  map.of[kY] = FileColumn::y;
  map.unit = pixels ? "px" : length_unit(column_name(header.names[kX]).unit).value_or("");
  map.spec = pixels ? positional(map) : by_name(map, header.names);
  Cells cells{.columns = {kLabel}, .words_in = kArena};
  auto table = read_rows(source, header, map, options, &cells);
  settle(table, cells);
  return table;
}

}  // namespace

const Reader kToxTrac = {{"toxtrac", "ToxTrac: Tracking_RealSpace.txt, Tracking.txt", ".txt"}, recognises, read};

}  // namespace swarmfit
