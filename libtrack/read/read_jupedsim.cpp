// SPDX-License-Identifier: MIT
// Trajectories that JuPedSim writes, a SQLite database of version 1 or 2: trajectory_data holds positions in metres, metadata the frame
// rate. https://www.jupedsim.org
#include <fmt/format.h>

#include <charconv>
#include <map>
#include <unordered_map>

#include "libtrack/error.h"
#include "libtrack/read/formats.h"
#include "libtrack/read/sqlite_file.h"

namespace swarmfit {
namespace {

const std::vector<std::string> kColumns = {"frame", "id", "pos_x", "pos_y"};

bool is_ours(const SqliteFile& file) { return file.has("trajectory_data", kColumns) && file.has("metadata", {"key", "value"}); }

bool recognises(const Source& source, const ReadOptions&) {
  return is_sqlite(source.bytes) && is_ours(SqliteFile(source.name, source.bytes));
}

double number(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : 0;
}

// What swarmfit convert says beyond JuPedSim's layout.
void take_ours(const std::map<std::string, std::string>& metadata, RawTable& table) {
  for (const auto& [key, value] : metadata) {
    if (key == "swarmfit_dt") table.dt = number(value);
    if (key == "swarmfit_t0") table.t0 = number(value);
    if (key.starts_with("swarmfit_note_")) table.notes.push_back(value);
  }
}

void add_named(RawTable& table, const std::vector<double>& ids, const std::map<std::string, std::string>& names) {
  std::unordered_map<double, std::uint32_t> of;
  for (const double id : ids) {
    const auto [hit, fresh] = of.try_emplace(id, 0);
    if (fresh) {
      const auto text = fmt::format("{}", id);
      const auto name = names.find(text);
      hit->second = table.names.number(name == names.end() ? text : name->second);
    }
    table.track.push_back(hit->second);
  }
}

RawTable read(const Source& source, const ReadOptions&) {
  const SqliteFile file(source.name, source.bytes);
  if (!is_ours(file))
    throw InputError(source.name + ": there are no tables trajectory_data and metadata; expected trajectories of JuPedSim (SQLite)");
  auto metadata = file.pairs("metadata", "key", "value");
  const auto& version = metadata["version"];
  if (version != "1" && version != "2")
    throw InputError(fmt::format("{}: the version of the layout is '{}'; expected 1 or 2", source.name, version.substr(0, 20)));
  RawTable table;
  table.file = source.name;
  table.row_name = "table 'trajectory_data' row";
  table.unit = "m";
  table.columns = "frame,id,x,y,_,_";
  if (const double fps = number(metadata["fps"]); fps > 0) table.dt = 1 / fps;
  take_ours(metadata, table);
  auto data = file.numbers("trajectory_data", kColumns);
  table[FileColumn::frame] = std::move(data[0]);
  if (file.has("track_names", {"id", "name"}))
    add_named(table, data[1], file.pairs("track_names", "id", "name"));
  else
    add_ids(table, data[1]);
  table[FileColumn::x] = std::move(data[2]);
  table[FileColumn::y] = std::move(data[3]);
  check_numbers(table);
  return table;
}

}  // namespace

const Reader kJuPedSim = {{"jupedsim", "JuPedSim trajectories (SQLite, versions 1 and 2)", ".sqlite .db"}, recognises, read};

}  // namespace swarmfit
