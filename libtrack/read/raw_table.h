// SPDX-License-Identifier: MIT
// What a reader hands over: rows as they stand in the file. One function turns them into Tracks, the same for every format.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "libtrack/read/columns.h"
#include "libtrack/read/read.h"

namespace swarmfit {

// Numbers the individuals by name. "7" and "7.0" are the same one.
class TrackNames {
 public:
  std::uint32_t number(std::string_view name);
  std::uint32_t number(std::uint32_t integer);  // the same as number(std::to_string(integer)), only faster
  const std::vector<std::string>& names() const { return names_; }

 private:
  std::vector<std::string> names_;
  std::vector<std::uint32_t> by_integer_;  // 1 + number of the individual named 0, 1, 2, ...; 0: not seen yet
  std::unordered_map<std::string, std::uint32_t> by_name_;
};

struct RawTable {
  static constexpr std::uint32_t no_track = 0xFFFFFFFF;  // a row that belongs to nobody; it is dropped and counted

  std::string file;  // for messages
  TrackNames names;
  std::vector<std::uint32_t> track;
  std::array<std::vector<double>, kNumberColumns> number;  // by FileColumn; empty when the file has none; position NaN: not seen
  std::vector<std::uint32_t> line;                         // source line of every row; empty: rows have no lines
  struct Part {
    std::string file;
    std::size_t first;  // row
  };
  std::vector<Part> parts;       // of several joined files; empty: one file
  std::string row_name = "row";  // what to call a row without a line
  std::vector<std::int64_t> episodes;
  std::vector<std::string> kinds;  // names of kinds 0, 1, ...

  double dt = 0;         // frame interval stated in the file [s]; 0: none
  double t0 = 0;         // time of frame 0, when dt is stated
  std::string unit;      // stated in the file; empty: none
  bool degrees = false;  // x and y are longitude and latitude
  std::string columns, format;
  std::vector<std::string> notes;
  bool synthetic = false;
  bool has_nodes = false, has_confidence = false;  // the file names points, says how sure they are: --node, --min-confidence apply

  std::vector<double>& operator[](FileColumn c) { return number[static_cast<std::size_t>(c)]; }
  const std::vector<double>& operator[](FileColumn c) const { return number[static_cast<std::size_t>(c)]; }
  bool has(FileColumn c) const { return !(*this)[c].empty(); }
  std::string place(std::size_t row) const;  // "file:line", or "file: row 17"
};

// Appends a row's individual for each id. NaN: nobody.
void add_ids(RawTable& table, std::span<const double> ids);

// Throws InputError at the row of a number that no later step can use: an infinite value, a missing time, a frame number that is not whole.
void check_numbers(const RawTable& table);

// Turns raw rows into Tracks: frame numbers and frame interval, unit, selection, duplicates, gaps. Throws InputError.
Tracks assemble(RawTable table, const ReadOptions& options, std::string sha256);

}  // namespace swarmfit
