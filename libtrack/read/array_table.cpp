// SPDX-License-Identifier: MIT
#include "libtrack/read/array_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libtrack/error.h"
#include "libtrack/nan.h"

namespace swarmfit {
namespace {

using Arrays = std::vector<NumberArray>;

std::string all_names(const Arrays& arrays) {
  std::vector<std::string> names;
  for (const auto& a : arrays) names.push_back(a.shown());
  return listed(names);
}

// Infinite positions are how some trackers say that nothing was seen.
double seen(double value) { return std::isinf(value) ? kNaN : value; }

bool is_position(FileColumn c) { return c == FileColumn::x || c == FileColumn::y || c == FileColumn::z; }

// One value per row and column; column(c)(row).
template <class Value>
RawTable rows_of(const std::string& file, const ColumnMap& map, std::size_t rows, Value&& value) {
  RawTable table;
  table.file = file;
  table.columns = map.spec;
  table.unit = map.unit;
  if (!map.has(FileColumn::id)) {
    table.track.assign(rows, table.names.number(std::uint32_t{1}));
    table.notes.emplace_back("the file has no ids: all rows are one individual");
  }
  std::vector<double> column(rows);
  for (std::size_t c = 0; c < map.of.size(); ++c) {
    const auto role = map.of[c];
    if (role == FileColumn::skip || role == FileColumn::date) continue;
    for (std::size_t i = 0; i < rows; ++i) column[i] = is_position(role) ? seen(value(i, c)) : value(i, c);
    if (role == FileColumn::id)
      add_ids(table, column);
    else
      table[role] = column;
  }
  check_numbers(table);
  return table;
}

RawTable columns_table(const std::string& file, const Arrays& arrays, const ReadOptions& options) {
  std::vector<std::string> names;
  for (const auto& a : arrays) names.push_back(a.name);
  const auto map = options.columns.empty() ? map_header(names, file) : map_columns(options.columns, names, names.size());
  if (!map.has(FileColumn::x) || !map.has(FileColumn::y))
    throw InputError(fmt::format("{}: no array is x or y among {}; expected `columns` such as id=NAME,frame=NAME,x=NAME,y=NAME", file,
                                 all_names(arrays)));
  return rows_of(file, map, arrays[0].dims[0], [&](std::size_t row, std::size_t column) { return arrays[column].value[row]; });
}

RawTable two_dimensional(const std::string& file, const NumberArray& array, const ReadOptions& options) {
  const std::size_t rows = array.dims[0], columns = array.dims[1];
  if (options.columns.empty()) {
    const auto first =
        std::vector(array.value.begin(), array.value.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(columns, 12)));
    throw InputError(
        fmt::format("{}: nothing says what the {} columns are; expected `columns`, such as `columns` id,frame,x,y; the first row is {:.6g}",
                    file, columns, fmt::join(first, ",")));
  }
  const auto map = map_columns(options.columns, {}, columns);
  return rows_of(file, map, rows, [&](std::size_t row, std::size_t column) { return array.value[row * columns + column]; });
}

// Frames x individuals x axes or individuals x frames x axes, as --columns says.
RawTable three_dimensional(const std::string& file, const NumberArray& array, const ReadOptions& options) {
  const std::size_t axes = array.dims[2];
  const std::string order = axes == 3 ? "x,y,z" : "x,y";
  const bool frames_first = options.columns == "frame,id," + order, ids_first = options.columns == "id,frame," + order;
  if ((axes != 2 && axes != 3) || (!frames_first && !ids_first))
    throw InputError(
        fmt::format("{}: the array is {}; expected `columns` frame,id,{} or id,frame,{} to say which axis is which, the last being {}",
                    file, fmt::join(array.dims, " x "), order, order, order));
  ColumnMap map;
  map.of = {FileColumn::frame, FileColumn::id, FileColumn::x, FileColumn::y};
  if (axes == 3) map.of.push_back(FileColumn::z);
  map.spec = options.columns;
  const std::size_t second = array.dims[1];
  return rows_of(file, map, array.dims[0] * second, [&](std::size_t row, std::size_t column) {
    if (column >= 2) return array.value[row * axes + column - 2];
    return static_cast<double>((column == 0) == frames_first ? row / second : row % second);
  });
}

bool are_columns(const Arrays& arrays) {
  return arrays.size() > 1 &&
         std::all_of(arrays.begin(), arrays.end(), [&](const auto& a) { return a.dims.size() == 1 && a.dims == arrays[0].dims; });
}

}  // namespace

RawTable array_table(const std::string& file, const Arrays& arrays, const ReadOptions& options) {
  if (arrays.empty())
    throw InputError(fmt::format("{}: there is no array {}; expected the name of one", file,
                                 options.variable.empty() ? "of numbers" : fmt::format("'{}'", options.variable)));
  if (std::any_of(arrays.begin(), arrays.end(), [](const auto& a) { return a.value.empty(); }) && arrays.size() == 1)
    throw InputError(file + ": the array is empty; expected positions");
  if (are_columns(arrays)) return columns_table(file, arrays, options);
  Arrays tables;
  std::copy_if(arrays.begin(), arrays.end(), std::back_inserter(tables),
               [](const auto& a) { return (a.dims.size() == 2 || a.dims.size() == 3) && !a.value.empty(); });
  if (tables.size() != 1)
    throw InputError(fmt::format("{}: {} among its arrays {}; expected `var` NAME", file,
                                 tables.empty() ? "there is neither a table nor an array of positions" : "several could hold positions",
                                 all_names(arrays)));
  return tables[0].dims.size() == 2 ? two_dimensional(file, tables[0], options) : three_dimensional(file, tables[0], options);
}

}  // namespace swarmfit
