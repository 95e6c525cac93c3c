// SPDX-License-Identifier: MIT
// Delimited text with or without header: comma, semicolon, tab, blanks or any other single character.
#include "libtrack/read/read_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "libtrack/error.h"
#include "libtrack/read/formats.h"
#include "libtrack/read/timestamp.h"
#include "libtrack/text_scan.h"

namespace swarmfit {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

// Where parsing stands, for messages.
struct Place {
  const std::string& name;
  long line;
  [[noreturn]] void fail(long column, const std::string& what) const { throw InputError(at(name, line, column, what)); }
};

std::string shown(std::string_view field) { return '\'' + std::string(field.substr(0, 40)) + '\''; }

// A field that is no plain number: missing, signed with '+', out of range, or wrong.
double odd_number(std::string_view field, const Place& place, long column) {
  if (is_missing(field)) return kMissing;
  std::string_view digits = field;
  if (digits.size() > 1 && digits.front() == '+' && digits[1] != '-') digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool whole = end == digits.data() + digits.size();
  if (whole && error == std::errc::result_out_of_range) {
    value = std::strtod(std::string(digits).c_str(), nullptr);
    if (std::abs(value) < 1) return value;  // too small for a double: zero or denormal
    place.fail(column, shown(field) + " is too large; expected a finite number");
  }
  if (whole && error == std::errc()) return value;
  const bool comma = field.find(',') != std::string_view::npos;
  place.fail(column, shown(field) + " is not a number; expected " + (comma ? "a decimal point instead of the comma" : "a number"));
}

// Reads the rows of one file; a member per column kind, because each needs its own care.
class RowReader {
 public:
  RowReader(const std::string& name, const TextHeader& header, const ColumnMap& map, std::size_t bytes)
      : name_(name), delimiter_(header.delimiter), map_(map), header_line_(header.lines_before) {
    table_.file = name;
    if (!map.has(FileColumn::id)) one_track_ = table_.names.number(std::uint32_t{1});
    has_date_ = map.has(FileColumn::date);
    const std::size_t guess = bytes / std::max<std::size_t>(1, 6 * map.of.size());
    for (const FileColumn c : map.of)
      if (static_cast<std::size_t>(c) < kNumberColumns) table_[c].reserve(guess);
  }

  void row(std::string_view line, long number) {
    const Place place{name_, number};
    Fields fields(line, delimiter_);
    date_ = 0;
    track_ = one_track_;
    const std::size_t count = map_.of.size();
    for (std::size_t i = 0; i < count; ++i) {
      if (fields.done()) ragged(place, i);
      read_field(fields, map_.of[i], place);
    }
    if (!fields.done()) ragged(place, count + remaining(fields));
    if (has_date_ && clock_) table_[FileColumn::t].back() += date_;
    table_.track.push_back(track_);
    table_.line.push_back(static_cast<std::uint32_t>(number));
  }

  RawTable take() { return std::move(table_); }

 private:
  void read_field(Fields& fields, FileColumn column, const Place& place) {
    switch (column) {
      case FileColumn::skip:
        return fields.skip();
      case FileColumn::id:
        return read_id(fields);
      case FileColumn::t:
        return table_[column].push_back(read_time(fields, place));
      case FileColumn::frame:
        return table_[column].push_back(read_frame(fields, place));
      case FileColumn::date:
        date_ = read_date(fields, place);
        return;
      default:
        table_[column].push_back(read_number(fields, place));
    }
  }

  double read_number(Fields& fields, const Place& place) {
    const long column = fields.column();
    double value = 0;
    if (!fields.number(value)) {
      const auto field = fields.text(scratch_);
      value = odd_number(field, place, column);
    }
    if (std::isinf(value)) place.fail(column, "the value is infinite; expected a finite number");
    return value;
  }

  double read_frame(Fields& fields, const Place& place) {
    const long column = fields.column();
    const double value = read_number(fields, place);
    if (std::isnan(value)) place.fail(column, "the frame number is missing; expected an integer");
    if (value != std::floor(value) || std::abs(value) > 9e15)
      place.fail(column, fmt::format("the frame number {} is not an integer; expected whole frames (a time column is called t)", value));
    return value;
  }

  // Numbers of seconds or clock times, whichever the first row has.
  double read_time(Fields& fields, const Place& place) {
    const long column = fields.column();
    double value = 0;
    if (fields.number(value)) {
      if (clock_) place.fail(column, "the time is a bare number; expected a clock time as in the rows before");
      seconds_ = true;
    } else {
      const auto field = fields.text(scratch_);
      if (is_missing(field)) place.fail(column, "the time is missing; expected a time in every row");
      const auto time = parse_timestamp(field);
      if (time && !seconds_) {
        clock_ = true;
        return *time;
      }
      if (clock_ || field.find(':') != std::string_view::npos)
        place.fail(column, shown(field) + " is not a time; expected seconds, HH:MM:SS or an ISO 8601 date and time");
      value = odd_number(field, place, column);
      seconds_ = true;
    }
    if (!std::isfinite(value)) place.fail(column, "the time is not finite; expected seconds");
    return value;
  }

  double read_date(Fields& fields, const Place& place) {
    const long column = fields.column();
    const auto field = fields.text(scratch_);
    const auto date = parse_date(field);
    if (!date) place.fail(column, shown(field) + " is not a date; expected YYYY-MM-DD");
    return *date;
  }

  void read_id(Fields& fields) {
    const auto field = fields.text(scratch_);
    std::uint32_t integer = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), integer);
    if (error == std::errc() && end == field.data() + field.size() && (field[0] != '0' || field.size() == 1))
      track_ = table_.names.number(integer);
    else
      track_ = is_missing(field) ? RawTable::no_track : table_.names.number(field);
  }

  [[noreturn]] void ragged(const Place& place, std::size_t found) const {
    place.fail(0, fmt::format("{} columns; expected {} as in line {}", found, map_.of.size(), header_line_ + 1));
  }
  static std::size_t remaining(Fields& fields) {
    std::size_t n = 0;
    for (; !fields.done(); ++n) fields.skip();
    return n;
  }

  const std::string& name_;
  const char delimiter_;
  const ColumnMap& map_;
  const long header_line_;
  RawTable table_;
  std::string scratch_;
  std::uint32_t one_track_ = 0, track_ = 0;
  double date_ = 0;
  bool has_date_ = false, clock_ = false, seconds_ = false;
};

// The error for a file without a header, showing what to type.
[[noreturn]] void demand_columns(const Source& source, const TextHeader& header) {
  std::string row, example;
  for (const auto& field : header.first_row) row += (row.empty() ? "" : ",") + field;
  const auto count = header.first_row.size();
  constexpr std::array<std::string_view, 11> usual = {"id", "x", "y", "z", "t", "vx", "vy", "vz", "ax", "ay", "az"};
  for (std::size_t i = 0; i < count; ++i) example += fmt::format("{}{}", i > 0 ? "," : "", i < usual.size() ? usual[i] : "_");
  throw InputError(
      at(source.name, header.lines_before + 1, 0,
         fmt::format(
             "the file has no header; expected `columns` to name its {} columns, such as `columns` {} (_ skips one); the first row is {}",
             count, example, row.substr(0, 160))));
}

void check_positions(const Source& source, const TextHeader& header, const ColumnMap& map) {
  if (map.has(FileColumn::x) && map.has(FileColumn::y)) return;
  throw InputError(at(source.name, header.names_line, 0,
                      fmt::format("no position columns among {}; expected x and y (`columns` x=NAME,y=NAME,... if they have other names)",
                                  listed(header.names))));
}

ColumnMap find_map(const Source& source, const TextHeader& header, const ReadOptions& options) {
  if (!options.columns.empty()) return map_columns(options.columns, header.names, header.first_row.size());
  if (header.names.empty()) demand_columns(source, header);
  auto map = map_header(header.names, fmt::format("{}:{}", source.name, header.names_line));
  check_positions(source, header, map);
  return map;
}

bool looks_like_text(const Source& source, const ReadOptions&) {
  const auto start = source.bytes.substr(0, 4096);
  return start.find('\0') == std::string_view::npos;
}

RawTable read_text(const Source& source, const ReadOptions& options) {
  const auto header = look_at_text(source.name, source.bytes, options);
  const auto map = find_map(source, header, options);
  return read_rows(source.name, source.bytes, header, map);
}

}  // namespace

RawTable read_rows(const std::string& name, std::string_view bytes, const TextHeader& header, const ColumnMap& map) {
  const auto text = bytes.substr(header.data_at);
  RowReader reader(name, header, map, text.size());
  Lines lines(text);
  for (std::string_view line; lines.next(line);)
    if (has_content(line)) reader.row(line, header.lines_before + lines.number());
  if (map.degrees)
    throw InputError(
        name +
        ": positions are longitude and latitude in degrees; expected a length unit (project them to metres first, for example to UTM)");
  RawTable table = reader.take();
  table.dt = header.dt;
  table.t0 = header.t0;
  table.unit = header.unit.empty() ? map.unit : header.unit;
  table.columns = map.spec;
  table.format = "text";
  table.synthetic = header.synthetic;
  table.episodes = header.episodes;
  if (!map.has(FileColumn::id)) table.notes.push_back("the file has no id column: all rows are one individual");
  return table;
}

const Reader kDelimitedText = {
    {"text", "delimited text: comma, semicolon, tab, blanks; with or without header", ".csv .txt .tsv .dat"}, looks_like_text, read_text};

}  // namespace swarmfit
