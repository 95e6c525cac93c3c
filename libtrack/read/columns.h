// SPDX-License-Identifier: MIT
// Which column of a table holds what: the --columns flag and the usual header names.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "libtrack/read/units.h"

namespace swarmfit {

enum class FileColumn : std::uint8_t { frame, t, x, y, z, vx, vy, vz, ax, ay, az, kind, id, date, skip };

// The columns that hold numbers come first in the enumeration.
inline constexpr std::size_t kNumberColumns = static_cast<std::size_t>(FileColumn::kind) + 1;

struct ColumnMap {
  std::vector<FileColumn> of;            // one entry per column of the file
  bool degrees = false;                  // x and y are longitude and latitude
  std::string unit{};                    // length unit found in the header ("x [mm]", "x/mm"); empty: none
  TimeUnit time{};                       // of the column t; seconds unless the header says otherwise
  std::vector<std::size_t> id_claims{};  // all columns that could be the individual, where there are several
  std::string spec{};                    // the same mapping as --columns would take it
  bool has(FileColumn c) const;
};

// The mapping by --columns. `names` is the header (empty when the file has none), `count` the number of columns of the file.
// Throws InputError "`columns`: ..." for unknown or repeated names, a wrong count, a mapping without x and y, or x and y in different
// units. `names` has `count` entries or none.
ColumnMap map_columns(std::string_view spec, const std::vector<std::string>& names, std::size_t count);

// The mapping by the usual names in the header; an exact name ("x") wins over an alias ("pos_x"). The result may lack x or y. Which of
// several columns is the individual, only the rows can tell: see choose_id(). Throws InputError at `place` when two columns have an
// equal claim, or x and y are in different units.
ColumnMap map_header(const std::vector<std::string>& names, const std::string& place);

// The mapping as --columns takes it by position: "id,frame,x,y,_".
std::string positional(const ColumnMap& map);

// The mapping as --columns takes it by name: "id=object,x=X".
std::string by_name(const ColumnMap& map, const std::vector<std::string>& names);

// The names joined for a message, shortened when there are many.
std::string listed(const std::vector<std::string>& names);

}  // namespace swarmfit
