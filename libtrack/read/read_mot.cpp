// SPDX-License-Identifier: MIT
// MOTChallenge text: frame,id,left,top,width,height,confidence,x,y,z with -1 for what is not known. The position is the centre of the
// box, in pixels. Detections, whose id is -1, belong to nobody.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "libtrack/error.h"
#include "libtrack/nan.h"
#include "libtrack/read/read_text.h"

namespace swarmfit {
namespace {

enum : std::size_t { kFrame, kId, kLeft, kTop, kWidth, kHeight, kConfidence, kAtLeast };

double value_of(const std::string& text) {
  double value = kNaN;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : kNaN;
}

// Ten numbers without a header, the last three -1: nothing else looks so.
bool has_the_shape(const std::vector<std::string>& row) {
  if (row.size() != 10 && row.size() != 9) return false;
  for (const auto& field : row)
    if (std::isnan(value_of(field))) return false;
  const double frame = value_of(row[kFrame]), id = value_of(row[kId]);
  return frame >= 0 && frame == std::floor(frame) && id >= -1 && id == std::floor(id) && value_of(row[kWidth]) > 0 &&
         value_of(row[kHeight]) > 0 && std::all_of(row.begin() + kAtLeast, row.end(), [](const auto& f) { return value_of(f) == -1; });
}

bool recognises(const Source& source, const ReadOptions& options) {
  if (!options.columns.empty() || !looks_like_text(source)) return false;
  try {
    const auto header = look_at_text(source.name, source.bytes, options);
    return header.names.empty() && header.delimiter == ',' && has_the_shape(header.first_row);
  } catch (const InputError&) {
    return false;
  }
}

RawTable read(const Source& source, const ReadOptions& options) {
  const auto header = look_at_text(source.name, source.bytes, options);
  const auto count = header.first_row.size();
  if (count < kAtLeast) throw InputError(fmt::format("{}: {} columns; expected those of MOTChallenge, ten", source.name, count));
  ColumnMap map{.of = std::vector<FileColumn>(count, FileColumn::skip), .spec = "frame,id,left,top,width,height,confidence"};
  map.of[kFrame] = FileColumn::frame;
  map.of[kId] = FileColumn::id;
  Cells cells{.columns = {kLeft, kTop, kWidth, kHeight, kConfidence}};
  auto table = read_rows(source, header, map, options, &cells);
  if (table.names.names().size() == 1 && table.names.names()[0] == "-1")
    throw InputError(source.name +
                     ": these are detections, every id is -1; expected tracks, that is the same number for the same individual");
  std::size_t unsure = 0;
  for (std::size_t row = 0; row < table.track.size(); ++row) {
    if (table.track[row] != RawTable::no_track && table.names.names()[table.track[row]] == "-1") table.track[row] = RawTable::no_track;
    const bool sure = !options.min_confidence || !(cells.at(row, 4) < *options.min_confidence);
    if (!sure) ++unsure;
    table[FileColumn::x].push_back(sure ? cells.at(row, 0) + cells.at(row, 2) / 2 : kNaN);
    table[FileColumn::y].push_back(sure ? cells.at(row, 1) + cells.at(row, 3) / 2 : kNaN);
  }
  table.notes.emplace_back("positions are the centres of the boxes");
  if (unsure > 0)
    table.notes.push_back(fmt::format("{} boxes were left out: their confidence is below {:g}", unsure, *options.min_confidence));
  table.has_confidence = true;
  table.unit = "px";
  return table;
}

}  // namespace

const Reader kMot = {{"mot", "MOTChallenge: frame,id,left,top,width,height,confidence,-1,-1,-1", ".txt .csv"}, recognises, read};

}  // namespace swarmfit
