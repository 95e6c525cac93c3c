// SPDX-License-Identifier: MIT
// MATLAB .mat files: a two-dimensional table of rows, the herding drives of Jadhav et al. 2024, or trx of fly trackers.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "libtrack/error.h"
#include "libtrack/read/formats.h"
#include "libtrack/read/mat_drives.h"
#include "libtrack/read/mat_file.h"
#include "libtrack/read/mat_trx.h"

namespace swarmfit {
namespace {

// Ling et al., Nature Communications 10:5174 (2019), jackdaw flocks: `tracks` has 11 columns, the smoothed `tracks_filt` also the
// wingbeat frequency.
constexpr std::string_view kLingColumns = "id,x,y,z,t,vx,vy,vz,ax,ay,az";

bool recognises(const Source& source, const ReadOptions&) {
  return source.bytes.starts_with("MATLAB 5.0 MAT-file") || source.bytes.starts_with("MATLAB 7.3 MAT-file");
}

bool is_table(const MatVariable& v) { return v.numeric && v.dims.size() == 2 && v.dims[0] >= 2 && v.dims[1] >= 3; }

std::string all_names(const MatVariables& variables) {
  std::vector<std::string> names;
  for (const auto& v : variables) names.push_back(v.shown());
  return listed(names);
}

const MatVariable& choose_table(const MatVariables& variables, const std::string& file, const ReadOptions& options) {
  if (!options.variable.empty()) {
    if (const auto* v = find(variables, options.variable)) return *v;
    throw InputError(fmt::format("`var`: {} has no variable '{}'; expected one of {}", file, options.variable, all_names(variables)));
  }
  for (const auto* usual : {"tracks_filt", "tracks"})
    if (const auto* v = find(variables, usual); v && is_table(*v)) return *v;
  const auto cells = std::find_if(variables.begin(), variables.end(), [](const auto& v) { return v.cells; });
  if (cells != variables.end() && options.columns.empty())
    throw InputError(fmt::format("{}: {} are cells, which is how detections without identities come; expected tracks, a table with ids",
                                 file, cells->shown()));
  const auto tables = std::count_if(variables.begin(), variables.end(), is_table);
  if (tables == 1) return *std::find_if(variables.begin(), variables.end(), is_table);
  throw InputError(fmt::format("{}: {} among its variables {}; expected `var` NAME", file,
                               tables == 0 ? "there is no table of rows" : "there are several tables", all_names(variables)));
}

ColumnMap find_map(const MatVariable& variable, const MatArray& table, const Source& source, const ReadOptions& options) {
  const std::size_t count = table.dims[1];
  if (!options.columns.empty()) return map_columns(options.columns, {}, count);
  const bool ling = (variable.name == "tracks_filt" && count == 12) || (variable.name == "tracks" && count == 11);
  if (ling) return map_columns(std::string(kLingColumns) + (count == 12 ? ",_" : ""), {}, count);
  std::string row;
  for (std::size_t c = 0; c < std::min<std::size_t>(count, 12); ++c)
    row += fmt::format("{}{:.6g}", c > 0 ? "," : "", table.value[c * table.dims[0]]);
  throw InputError(
      fmt::format("{}: nothing says what the {} columns of '{}' are; expected `columns`, such as `columns` id,x,y,z,t; the first row is {}",
                  source.name, count, variable.name, row));
}

RawTable read_table(const MatFile& mat, const Source& source, const ReadOptions& options) {
  const auto& variable = choose_table(mat.variables, source.name, options);
  const auto& array = mat.array.at(variable.name);
  if (array.dims.size() != 2 || array.value.empty())
    throw InputError(fmt::format("{}: variable '{}' is not a table; expected rows and columns", source.name, variable.shown()));
  const auto map = find_map(variable, array, source, options);
  const std::size_t rows = array.dims[0];
  RawTable table;
  table.file = source.name;
  table.row_name = fmt::format("variable '{}' row", variable.name);
  table.columns = map.spec;
  if (!map.has(FileColumn::id)) {
    table.track.assign(rows, table.names.number(std::uint32_t{1}));
    table.notes.push_back("the file has no id column: all rows are one individual");
  }
  for (std::size_t c = 0; c < map.of.size(); ++c) {
    const double* values = array.value.data() + c * rows;
    if (map.of[c] == FileColumn::id) add_ids(table, {values, rows});
    if (static_cast<std::size_t>(map.of[c]) >= kNumberColumns) continue;
    table[map.of[c]].assign(values, values + rows);
  }
  check_numbers(table);
  return table;
}

RawTable read(const Source& source, const ReadOptions& options) {
  const auto drives = [&](const MatVariables& variables) { return options.variable.empty() && has_drives(variables); };
  const auto trx = [&](const MatVariables& variables) { return options.variable.empty() && has_trx(variables); };
  const MatFile mat = read_mat_file(source.name, source.bytes, [&](const MatVariables& variables) {
    if (drives(variables)) return drive_variables(variables);
    if (trx(variables)) return std::vector<std::string>{"trx"};
    return std::vector{choose_table(variables, source.name, options).name};
  });
  if (trx(mat.variables)) return read_trx(mat, source.name);
  return drives(mat.variables) ? read_drives(mat, source.name) : read_table(mat, source, options);
}

}  // namespace

const Reader kMatlab = {
    {"mat", "MATLAB 5 and 7.3: a table of rows, the arrays pos_ev_k of herding drives, or trx of Ctrax, JAABA and FlyTracker", ".mat"},
    recognises,
    read};

}  // namespace swarmfit
