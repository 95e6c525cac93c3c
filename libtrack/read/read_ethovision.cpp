// SPDX-License-Identifier: MIT
// EthoVision raw data as text. XT: "Number of header lines:";"8", facts, a row of names, a row of units. Version 3: "Track file,..." and
// facts, a row of names. One individual in a file; "-" is missing. Names come in the language of the program.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "libtrack/error.h"
#include "libtrack/read/read_text.h"
#include "libtrack/text_scan.h"

namespace swarmfit {
namespace {

constexpr std::string_view kMark = "\xEF\xBB\xBF";

std::string_view without_mark(std::string_view bytes) { return bytes.starts_with(kMark) ? bytes.substr(kMark.size()) : bytes; }

bool is_xt(std::string_view bytes) {
  const auto line = bytes.substr(0, bytes.find('\n'));
  return line.starts_with("\"Number of header lines:\"") || line.starts_with("Number of header lines:");
}

bool is_version_3(std::string_view bytes) {
  return bytes.starts_with("Track file,") || bytes.starts_with("Track file;") || bytes.starts_with("Track file\t");
}

bool recognises(const Source& source, const ReadOptions& options) {
  const auto bytes = without_mark(source.bytes);
  return options.columns.empty() && looks_like_text(source) && (is_xt(bytes) || is_version_3(bytes));
}

// The byte at which a line begins, counted from 1; the size when there are fewer.
std::size_t line_at(std::string_view bytes, long number) {
  std::size_t at = 0;
  for (; number > 1 && at < bytes.size(); --number) {
    const auto end = bytes.find('\n', at);
    at = end == std::string_view::npos ? bytes.size() : end + 1;
  }
  return at;
}

std::string_view line_of(std::string_view bytes, long number) {
  const auto at = line_at(bytes, number);
  std::string_view line;
  Lines(bytes.substr(at)).next(line);
  return line;
}

char delimiter_of(std::string_view line) {
  const auto at = line.find_first_of(";,\t");
  return at == std::string_view::npos ? ';' : line[at];
}

// XT says how many lines its header has, the last two being names and units; of version 3 the header ends in "Sample no.".
long names_line(const std::string& name, std::string_view bytes, char delimiter) {
  if (is_xt(bytes)) {
    const auto fields = split_fields(line_of(bytes, 1), delimiter);
    long lines = 0;
    if (fields.size() > 1) std::from_chars(fields[1].data(), fields[1].data() + fields[1].size(), lines);
    if (lines < 3 || lines > 10'000) throw InputError(name + ":1: the number of header lines is missing; expected that of EthoVision");
    return lines - 1;
  }
  Lines lines(bytes);
  for (std::string_view line; lines.number() < 200 && lines.next(line);)
    if (line.starts_with("Sample no")) return lines.number();
  throw InputError(name + ": there is no row of column names; expected 'Sample no.' and others");
}

// English, German, French, Spanish, Dutch and Italian programs name the columns in their language; the axis stands first in all.
ColumnMap find_map(const TextHeader& header) {
  ColumnMap map{.of = std::vector<FileColumn>(header.names.size(), FileColumn::skip)};
  for (std::size_t i = 0; i < header.names.size(); ++i) {
    const auto name = column_name(header.names[i]).name;
    const bool seconds = header.names[i].ends_with("[s]");
    if (name == "x" || name.starts_with("x_"))
      map.of[i] = map.has(FileColumn::x) ? FileColumn::skip : FileColumn::x;
    else if (name == "y" || name.starts_with("y_"))
      map.of[i] = map.has(FileColumn::y) ? FileColumn::skip : FileColumn::y;
    else if (!map.has(FileColumn::t) && (seconds || name == "time"))
      map.of[i] = FileColumn::t;
  }
  return map;
}

RawTable read(const Source& source, const ReadOptions& options) {
  const auto bytes = without_mark(source.bytes);
  const char delimiter = options.delimiter.value_or(delimiter_of(line_of(bytes, 1)));
  const bool xt = is_xt(bytes);
  TextHeader header;
  header.delimiter = delimiter;
  header.names_line = names_line(source.name, bytes, delimiter);
  header.names = split_fields(line_of(bytes, header.names_line), delimiter);
  if (xt) {
    const auto units = split_fields(line_of(bytes, header.names_line + 1), delimiter);
    for (std::size_t i = 0; i < std::min(units.size(), header.names.size()); ++i)
      if (!units[i].empty()) header.names[i] += fmt::format(" [{}]", units[i]);
  }
  header.lines_before = header.names_line + (xt ? 1 : 0);
  const auto data = line_at(bytes, header.lines_before + 1);
  header.data_at = static_cast<std::size_t>(bytes.data() - source.bytes.data()) + data;
  header.first_row = split_fields(line_of(bytes, header.lines_before + 1), delimiter);

  auto map = find_map(header);
  for (const FileColumn needed : {FileColumn::x, FileColumn::y, FileColumn::t})
    if (!map.has(needed))
      throw InputError(at(source.name, header.names_line, 0,
                          fmt::format("no column of time, x or y among {}; expected those of EthoVision", listed(header.names))));
  for (std::size_t i = 0; i < map.of.size(); ++i)
    if (map.of[i] == FileColumn::x) map.unit = length_unit(column_name(header.names[i]).unit).value_or("");
  map.spec = by_name(map, header.names);
  auto table = read_rows(source, header, map, options);
  return table;
}

}  // namespace

const Reader kEthoVision = {{"ethovision", "EthoVision raw data as text, XT and version 3", ".txt .csv"}, recognises, read};

}  // namespace swarmfit
