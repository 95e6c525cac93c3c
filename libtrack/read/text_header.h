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
  bool names_in_comment = false;   // they stood behind a '#'
  bool quoted = false;             // some field of the first rows is quoted
  std::vector<std::string> first_row;
  std::size_t data_at = 0;  // byte offset of the first row
  long lines_before = 0;    // lines before it
  // From comments such as "# framerate: 25 fps", "# unit: mm", "# frame interval: 0.01 s", "# synthetic: yes".
  double dt = 0;  // frame interval [s]; 0: not stated
  double t0 = 0;  // time of frame 0
  std::string unit;
  bool synthetic = false;
  bool petrack = false;  // a comment names PeTrack
  std::vector<std::int64_t> episodes;
};

// Throws InputError for files without a row and for text in an encoding other than ASCII or UTF-8.
TextHeader look_at_text(const std::string& name, std::string_view bytes, const ReadOptions& options);

// Fields of one line.
std::vector<std::string> split_fields(std::string_view line, char delimiter);

// NA, NaN, NULL, None, "-" and the empty field.
bool is_missing(std::string_view field);

}  // namespace swarmfit
