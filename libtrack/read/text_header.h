// SPDX-License-Identifier: MIT
// What stands before the first row of a delimited text file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "libtrack/read/read.h"

namespace swarmfit {

struct TextHeader {
  char delimiter = ',';            // ' ' stands for runs of blanks
  std::vector<std::string> names;  // of the columns; empty: none in the file
  long names_line = 0;             // line of the names
  std::string_view names_text;     // that line; it may come again where parts were joined
  bool names_in_comment = false;   // they stood behind a '#'
  bool quoted = false;             // some field of the first rows is quoted
  std::vector<std::string> first_row;
  std::size_t data_at = 0;  // byte offset of the first row
  long lines_before = 0;    // lines before it
  // From comments such as "# framerate: 25 fps", "# unit: mm", "# frame interval: 0.01 s", "# synthetic: yes".
  double dt = 0;  // frame interval [s]; 0: not stated
  double t0 = 0;  // time of frame 0
  std::string unit;
  std::vector<std::string> notes;
  bool synthetic = false;
  bool petrack = false;  // a comment names PeTrack
  std::vector<std::int64_t> episodes;
  std::vector<std::string> kinds;  // from "# kinds: sheep; dog": what kinds 0, 1, ... are called
};

// `names` is empty or has as many entries as `first_row`: R's row names get an empty one, lines of a title above the names are passed
// over, a row of units below is put into the names ("x [mm]"). Throws InputError for files without a row, for text in an encoding other
// than ASCII or UTF-8, and for a header that does not fit the rows.
TextHeader look_at_text(const std::string& name, std::string_view bytes, const ReadOptions& options);

// The column of this name in a file of a program that always writes it. Throws InputError, naming both.
std::size_t column_named(std::string_view column, const TextHeader& header, const std::string& file, std::string_view program);

// A line of names: at least one field is text, and none is a value.
bool is_header(const std::vector<std::string>& fields);

// Fields of one line.
std::vector<std::string> split_fields(std::string_view line, char delimiter);

// NA, NaN, #N/A, NULL, None, inf, "-", "." and the empty field.
bool is_missing(std::string_view field);

}  // namespace swarmfit
