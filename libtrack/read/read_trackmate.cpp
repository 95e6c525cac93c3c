// SPDX-License-Identifier: MIT
// TrackMate's table of spots as CSV: one row of column names, or four (keys, names, short names, units). Spots without TRACK_ID belong
// to no track.
#include <fmt/format.h>

#include <algorithm>

#include "libtrack/error.h"
#include "libtrack/read/read_text.h"
#include "libtrack/text_scan.h"

namespace swarmfit {
namespace {

std::size_t column(const TextHeader& header, std::string_view name) {
  return static_cast<std::size_t>(std::find(header.names.begin(), header.names.end(), name) - header.names.begin());
}

bool recognises(const Source& source, const ReadOptions& options) {
  if (!options.columns.empty() || !looks_like_text(source)) return false;
  const auto start = source.bytes.substr(0, 4096);
  const auto names = split_fields(start.substr(0, start.find_first_of("\r\n")), ',');
  const auto has = [&](std::string_view name) { return std::find(names.begin(), names.end(), name) != names.end(); };
  return has("TRACK_ID") && has("POSITION_X") && has("POSITION_Y") && has("FRAME");
}

// Passes over the rows of names, and returns that of units: the last one without a number in POSITION_X.
std::vector<std::string> skip_names(std::string_view bytes, TextHeader& header, std::size_t x) {
  std::vector<std::string> last;
  Lines lines(bytes);
  for (std::string_view line; lines.next(line);) {
    if (!has_content(line) || lines.number() <= header.names_line) continue;
    auto fields = split_fields(line, header.delimiter);
    double value = 0;
    const bool row = fields.size() > x && Fields(fields[x], '\0').number(value);
    if (row || lines.number() > header.names_line + 3) {
      header.first_row = std::move(fields);
      header.data_at = static_cast<std::size_t>(line.data() - bytes.data());
      header.lines_before = lines.number() - 1;
      break;
    }
    last = std::move(fields);
  }
  return last;
}

// Without calibration, TrackMate writes the frame number where the time stands: that is no time.
bool time_is_frame(const RawTable& table) { return table.has(FileColumn::t) && table[FileColumn::t] == table[FileColumn::frame]; }

// Planar recordings have a z that is 0 throughout.
void drop_flat_z(RawTable& table) {
  auto& z = table[FileColumn::z];
  if (z.empty() || !std::all_of(z.begin(), z.end(), [](double v) { return v == 0; })) return;
  z = {};
  table.notes.emplace_back("z is 0 in every row: the recording is two-dimensional");
}

RawTable read(const Source& source, const ReadOptions& options) {
  auto header = look_at_text(source.name, source.bytes, options);
  const auto x = column(header, "POSITION_X");
  const auto units = skip_names(source.bytes, header, x);
  header.notes.clear();
  ColumnMap map{.of = std::vector<FileColumn>(header.names.size(), FileColumn::skip)};
  const auto take = [&](std::string_view name, FileColumn as) {
    const auto i = column(header, name);
    if (i < map.of.size()) map.of[i] = as;
  };
  take("TRACK_ID", FileColumn::id);
  take("FRAME", FileColumn::frame);
  take("POSITION_T", FileColumn::t);
  take("POSITION_X", FileColumn::x);
  take("POSITION_Y", FileColumn::y);
  take("POSITION_Z", FileColumn::z);
  for (const FileColumn needed : {FileColumn::x, FileColumn::y, FileColumn::frame})
    if (!map.has(needed))
      throw InputError(at(source.name, header.names_line, 0, "a column is missing; expected TrackMate's POSITION_X, POSITION_Y and FRAME"));
  if (units.size() > x) map.unit = length_unit(units[x]).value_or("");
  const auto t = column(header, "POSITION_T");
  const auto stated = units.size() > t ? time_unit(units[t]) : std::nullopt;
  map.time = stated.value_or(TimeUnit{});
  map.spec = by_name(map, header.names);
  auto table = read_rows(source, header, map, options);
  if (!stated && time_is_frame(table)) {
    table[FileColumn::t] = {};
    table.notes.emplace_back("POSITION_T is the frame number: the recording was not calibrated, and has no times");
  }
  drop_flat_z(table);
  return table;
}

}  // namespace

const Reader kTrackMateCsv = {{"trackmate-csv", "TrackMate's table of spots, with one row of names or four", ".csv"}, recognises, read};

}  // namespace swarmfit
