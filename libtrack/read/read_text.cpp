// SPDX-License-Identifier: MIT
// Delimited text with or without header: comma, semicolon, tab, blanks or any other single character.
#include "libtrack/read/read_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "libtrack/error.h"
#include "libtrack/nan.h"
#include "libtrack/read/choose_id.h"
#include "libtrack/read/clock_times.h"
#include "libtrack/read/formats.h"
#include "libtrack/read/numbers.h"
#include "libtrack/read/timestamp.h"
#include "libtrack/text_scan.h"

namespace swarmfit {
namespace {

// Reads the rows of one file; a member per column kind, because each needs its own care.
class RowReader {
 public:
  RowReader(const std::string& name, const TextHeader& header, const ColumnMap& map, const ReadOptions& options, Cells* cells,
            std::size_t bytes)
      : name_(name),
        delimiter_(header.delimiter),
        map_(map),
        header_line_(header.lines_before),
        numbers_(header.delimiter, options.decimal),
        options_(options),
        cells_(cells),
        certain_(header.dt > 0 && map.has(FileColumn::frame)) {
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
    cell_ = 0;
    const std::size_t count = map_.of.size();
    for (std::size_t i = 0; i < count; ++i) {
      if (fields.done()) ragged(place, i);
      if (map_.of[i] == FileColumn::skip && cells_)
        read_cell(fields, i, place);
      else
        read_field(fields, map_.of[i], place);
    }
    if (!fields.done()) check_rest(fields, place, count);
    if (has_date_ && clock_) table_[FileColumn::t].back() += date_;
    if (two_readings_) month_first_.push_back(has_date_ ? month_first_date_ + clock_time_ : month_first_time_);
    table_.track.push_back(track_);
    table_.line.push_back(static_cast<std::uint32_t>(number));
  }

  // Settles what only the whole file tells.
  RawTable take() {
    numbers_.check(table_.file);
    if (two_readings_) settle_dates(table_, month_first_, options_.dates);
    if (clock_) refuse_end_of_summer_time(table_);
    if (clock_ && !dated_ && !has_date_) go_on_over_midnight(table_);
    if (seconds_) in_seconds();
    if (!seconds_ && !options_.time_unit.empty())
      throw InputError(fmt::format("`time-unit` {}: {} has no bare numbers of time; expected none given", options_.time_unit, name_));
    return std::move(table_);
  }

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

  void read_cell(Fields& fields, std::size_t column, const Place& place) {
    if (cells_->words_in == column) {
      cells_->word.push_back(cells_->words.number(fields.text(scratch_)));
    } else if (cell_ < cells_->columns.size() && cells_->columns[cell_] == column) {
      ++cell_;
      cells_->values.push_back(read_number(fields, place));
    } else {
      fields.skip();
    }
  }

  double read_number(Fields& fields, const Place& place) {
    const double value = numbers_.read(fields, place);
    return std::isinf(value) ? kNaN : value;  // how some trackers write "not seen"
  }

  double read_frame(Fields& fields, const Place& place) {
    const long column = fields.column();
    const double value = read_number(fields, place);
    if (std::isnan(value)) place.fail(column, "the frame number is missing; expected an integer");
    if (std::abs(value) > 9e15) place.fail(column, fmt::format("the frame number {} is too large; expected one up to 9e15", value));
    if (value != std::floor(value))
      place.fail(column, fmt::format("the frame number {} is not an integer; expected whole frames (a time column is called t)", value));
    return value;
  }

  // Numbers of seconds or clock times, whichever the first row has.
  double read_time(Fields& fields, const Place& place) {
    const long column = fields.column();
    double value = 0;
    if (numbers_.plain(fields, place, value)) {
      if (clock_) place.fail(column, "the time is a bare number; expected a clock time as in the rows before");
    } else {
      const auto field = fields.text(scratch_);
      if (is_missing(field)) place.fail(column, "the time is missing; expected a time in every row");
      if (!seconds_ && read_stamp(field, place, column, value)) return value;
      if (clock_ || field.find(':') != std::string_view::npos)
        place.fail(column, shown(field) + " is not a time; expected seconds, HH:MM:SS or an ISO 8601 date and time");
      value = numbers_.odd(field, place, column);
    }
    seconds_ = true;
    if (!std::isfinite(value)) place.fail(column, "the time is not finite; expected seconds");
    return value;
  }

  // A clock time or a date with one. Dates that have two readings keep both until the end of the file.
  bool read_stamp(std::string_view field, const Place& place, long column, double& value) {
    if (const auto time = parse_timestamp(field)) {
      const bool dated = !parse_clock(field);
      if ((two_readings_ && !has_date_) || (dated && has_date_) || (clock_ && dated != dated_))
        place.fail(column, shown(field) + " is another kind of time; expected one kind in all rows");
      clock_ = true;
      dated_ = dated;
      value = clock_time_ = *time;
      return true;
    }
    const auto both = parse_day_and_month(field);
    if (!both) return false;
    if ((clock_ && !two_readings_) || has_date_)
      place.fail(column, shown(field) + " is another kind of time; expected one kind in all rows");
    clock_ = dated_ = two_readings_ = true;
    month_first_time_ = both->month_first.value_or(kNaN);
    value = both->day_first.value_or(kNaN);
    return true;
  }

  double read_date(Fields& fields, const Place& place) {
    const long column = fields.column();
    const auto field = fields.text(scratch_);
    if (const auto date = parse_date(field); date && !two_readings_) return *date;
    const auto both = parse_day_and_month(field);
    if (!both || (!two_readings_ && !table_.track.empty())) place.fail(column, shown(field) + " is not a date; expected YYYY-MM-DD");
    two_readings_ = true;
    month_first_date_ = both->month_first.value_or(kNaN);
    return both->day_first.value_or(kNaN);
  }

  // Bare numbers in the unit of the header or of --time-unit.
  void in_seconds() {
    TimeUnit unit = map_.time;
    if (!options_.time_unit.empty()) unit = given_time_unit(options_.time_unit);
    if (unit == TimeUnit{} && options_.time_unit.empty()) {
      if (!certain_) refuse_other_units(table_);
      return;
    }
    for (double& value : table_[FileColumn::t]) value = unit.seconds(value);
  }

  TimeUnit given_time_unit(const std::string& text) const {
    const auto unit = scaled_time_unit(text);
    if (!unit)
      throw InputError(fmt::format("`time-unit`: '{}' is not known; expected s, ms, us, ns, min, h or d, or so many of them: 0.01s", text));
    if (map_.time != TimeUnit{} && map_.time != *unit)
      throw InputError(
          fmt::format("{}: the header states another unit of time than `time-unit` {}; expected the same or none given", name_, text));
    return *unit;
  }

  // Between quotes NA is a name.
  void read_id(Fields& fields) {
    const bool quoted = fields.quoted();
    const auto field = fields.text(scratch_);
    std::uint32_t integer = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), integer);
    if (error == std::errc() && end == field.data() + field.size() && (field[0] != '0' || field.size() == 1))
      track_ = table_.names.number(integer);
    else
      track_ = is_missing(field) && (!quoted || field.empty()) ? RawTable::no_track : table_.names.number(field);
  }

  [[noreturn]] void ragged(const Place& place, std::size_t found) const {
    place.fail(0, fmt::format("{} columns; expected {} as in line {}", found, map_.of.size(), header_line_ + 1));
  }
  // Beyond the columns there may be one empty field: a row that ends in a delimiter.
  void check_rest(Fields& fields, const Place& place, std::size_t count) {
    std::size_t n = 1;
    const bool empty = fields.text(scratch_).empty();
    for (; !fields.done(); ++n) fields.skip();
    if (n > 1 || !empty) ragged(place, count + n);
  }

  const std::string& name_;
  const char delimiter_;
  const ColumnMap& map_;
  const long header_line_;
  RawTable table_;
  std::string scratch_;
  std::uint32_t one_track_ = 0, track_ = 0;
  std::size_t cell_ = 0;
  Numbers numbers_;
  const ReadOptions& options_;
  Cells* const cells_;
  const bool certain_;  // the header tells the frame interval, and rows their frames: times are in seconds, however large
  double date_ = 0, month_first_date_ = 0, month_first_time_ = 0, clock_time_ = 0;
  std::vector<double> month_first_;
  bool has_date_ = false, clock_ = false, dated_ = false, two_readings_ = false, seconds_ = false;
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

bool recognises(const Source& source, const ReadOptions&) { return looks_like_text(source); }

RawTable read_text(const Source& source, const ReadOptions& options) {
  auto header = look_at_text(source.name, source.bytes, options);
  auto map = find_map(source, header, options);
  if (auto remark = choose_id(map, source.name, source.bytes, header); !remark.empty()) header.notes.push_back(std::move(remark));
  return read_rows(source, header, map, options);
}

}  // namespace

bool looks_like_text(const Source& source) { return source.bytes.substr(0, 4096).find('\0') == std::string_view::npos; }

RawTable read_rows(const Source& source, const TextHeader& header, const ColumnMap& map, const ReadOptions& options, Cells* cells) {
  const auto& name = source.name;
  const auto text = source.bytes.substr(header.data_at);
  RowReader reader(name, header, map, options, cells, text.size());
  Lines lines(text);
  long repeated = 0, repeated_at = 0;
  for (std::string_view line; lines.next(line);) {
    if (!has_content(line)) continue;
    if (line == header.names_text) {
      if (repeated++ == 0) repeated_at = header.lines_before + lines.number();
      continue;
    }
    reader.row(line, header.lines_before + lines.number());
  }
  RawTable table = reader.take();
  table.notes.insert(table.notes.begin(), header.notes.begin(), header.notes.end());
  if (repeated > 0)
    table.notes.push_back(fmt::format("the header is repeated ({}first at line {}): the parts were read as one table",
                                      repeated > 1 ? fmt::format("{} times, ", repeated) : "", repeated_at));
  table.dt = header.dt;
  table.t0 = header.t0;
  table.unit = header.unit.empty() ? map.unit : header.unit;
  table.degrees = map.degrees;
  table.columns = map.spec;
  table.synthetic = header.synthetic;
  table.episodes = header.episodes;
  table.kinds = header.kinds;
  if (!map.has(FileColumn::id) && !cells) table.notes.push_back("the file has no id column: all rows are one individual");
  return table;
}

const Reader kDelimitedText = {
    {"text", "delimited text: comma, semicolon, tab, blanks; with or without header", ".csv .txt .tsv .dat"}, recognises, read_text};

}  // namespace swarmfit
