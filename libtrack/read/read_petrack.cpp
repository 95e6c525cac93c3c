// SPDX-License-Identifier: MIT
// Text files of PeTrack and of the Pedestrian Dynamics Data Archive: rows "id frame x y z" between blanks, where z is the height of the
// head. Comments give frame rate and unit; older files (HERMES) have no comments at all, and are recognised by their shape.
#include <algorithm>
#include <charconv>

#include "libtrack/error.h"
#include "libtrack/read/formats.h"
#include "libtrack/read/read_text.h"
#include "libtrack/text_scan.h"

namespace swarmfit {
namespace {

bool is_integer(const std::string& field) {
  long long value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  return error == std::errc() && end == field.data() + field.size();
}

bool is_decimal(const std::string& field) {
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  return error == std::errc() && end == field.data() + field.size();
}

// Rows without any header: five numbers between blanks, the first two whole, consecutive frames of the same person at the start.
bool has_the_shape(std::string_view rows, char delimiter) {
  if (delimiter != ' ' && delimiter != '\t') return false;
  std::vector<std::vector<std::string>> first;
  Lines lines(rows);
  for (std::string_view line; first.size() < 3 && lines.next(line);)
    if (has_content(line)) first.push_back(split_fields(line, delimiter));
  const bool numbers = std::all_of(first.begin(), first.end(), [](const auto& f) {
    return f.size() == 5 && is_integer(f[0]) && is_integer(f[1]) && std::all_of(f.begin() + 2, f.end(), is_decimal);
  });
  if (!numbers || first.size() < 3) return false;
  const auto frame = [&](std::size_t i) { return std::stoll(first[i][1]); };
  return first[0][0] == first[2][0] && frame(1) == frame(0) + 1 && frame(2) == frame(1) + 1;
}

bool has_the_names(const TextHeader& header) {
  if (header.names.empty()) return false;
  const auto map = map_header(header.names, "");
  return map.has(FileColumn::id) && map.has(FileColumn::frame) && map.has(FileColumn::x) && map.has(FileColumn::y);
}

bool recognises(const Source& source, const ReadOptions& options) {
  if (!options.columns.empty() || source.bytes.substr(0, 4096).find('\0') != std::string_view::npos) return false;
  try {
    const auto header = look_at_text(source.name, source.bytes, options);
    if (header.names_in_comment && has_the_names(header) && (header.petrack || header.dt > 0)) return true;
    return header.names.empty() && has_the_shape(source.bytes.substr(header.data_at), header.delimiter);
  } catch (const InputError&) {
    return false;  // whatever is wrong is reported by the reader that takes the file in the end
  }
}

RawTable read(const Source& source, const ReadOptions& options) {
  const auto header = look_at_text(source.name, source.bytes, options);
  ColumnMap map;
  if (!options.columns.empty())
    map = map_columns(options.columns, header.names, header.first_row.size());
  else if (has_the_names(header))
    map = map_header(header.names, source.name);
  else
    map = map_columns(header.first_row.size() == 4 ? "id,frame,x,y" : "id,frame,x,y,z", header.names, header.first_row.size());

  const bool head = options.columns.empty() && map.has(FileColumn::z);
  if (head) std::replace(map.of.begin(), map.of.end(), FileColumn::z, FileColumn::skip);
  map.spec = positional(map);
  RawTable table = read_rows(source, header, map, options);
  if (head) table.notes.push_back("z is the height of the head: the motion is two-dimensional (--columns id,frame,x,y,z reads it as 3-D)");
  return table;
}

}  // namespace

const Reader kPeTrack = {{"petrack", "PeTrack and Pedestrian Dynamics Data Archive text: id frame x y z", ".txt .trc"}, recognises, read};

}  // namespace swarmfit
