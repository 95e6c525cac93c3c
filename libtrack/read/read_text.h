// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "libtrack/read/columns.h"
#include "libtrack/read/formats.h"
#include "libtrack/read/raw_table.h"
#include "libtrack/read/text_header.h"

namespace swarmfit {

// More of a row than a RawTable holds: numbers of other columns, and the words of one.
struct Cells {
  std::vector<std::size_t> columns{};     // which to read, ascending; the map skips them
  std::vector<double> values{};           // row by row, columns.size() each; NaN: missing
  std::optional<std::size_t> words_in{};  // a column of names
  TrackNames words{};
  std::vector<std::uint32_t> word{};  // one per row, as words numbers them
  double at(std::size_t row, std::size_t cell) const { return values[row * columns.size() + cell]; }
};

// All rows of a delimited text under a given mapping of its columns, and what `cells` asks for. Units and comments of the header are
// kept; the mapping may lack x and y.
RawTable read_rows(const Source& source, const TextHeader& header, const ColumnMap& map, const ReadOptions& options,
                   Cells* cells = nullptr);

// Whether the file begins as text does.
bool looks_like_text(const Source& source);

}  // namespace swarmfit
