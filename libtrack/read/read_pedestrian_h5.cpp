// SPDX-License-Identifier: MIT
// HDF5 files of the Pedestrian Dynamics Data Archive: a table `trajectory` of id, frame, x, y and, mostly, z, the height of the head;
// the frame rate is its attribute fps, units are in what its attributes say about the columns. https://ped.fz-juelich.de/da
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libtrack/error.h"
#include "libtrack/read/formats.h"

namespace swarmfit {
namespace {

constexpr const char* kTable = "/trajectory";

bool has(const Hdf5Object& table, std::string_view member) {
  return std::find(table.members.begin(), table.members.end(), member) != table.members.end();
}

bool is_trajectory(const Hdf5Object* o) {
  return o && o->dims.size() == 1 && has(*o, "id") && has(*o, "frame") && has(*o, "x") && has(*o, "y");
}

bool recognises(const Source& source, const ReadOptions&) {
  const auto* contents = source.hdf5();
  return contents && is_trajectory(contents->find(kTable));
}

// "pedestrian x-coordinate (meter [m])" → "m"; empty: not said.
std::string unit_of(const std::string& description) {
  const auto open = description.find('['), close = description.find(']', open);
  return open == std::string::npos || close == std::string::npos ? "" : description.substr(open + 1, close - open - 1);
}

RawTable read(const Source& source, const ReadOptions&) {
  const auto* contents = source.hdf5();
  const auto* trajectory = contents ? contents->find(kTable) : nullptr;
  if (!is_trajectory(trajectory))
    throw InputError(source.name +
                     ": there is no table /trajectory of id, frame, x and y; expected HDF5 of the Pedestrian Dynamics Data Archive");
  RawTable table;
  table.file = source.name;
  table.columns = has(*trajectory, "z") ? "id,frame,x,y,_" : "id,frame,x,y";
  if (const auto fps = trajectory->number("fps"); fps && *fps > 0) table.dt = 1 / *fps;
  table.unit = unit_of(trajectory->text("x"));
  if (unit_of(trajectory->text("y")) != table.unit)
    throw InputError(
        fmt::format("{}: x is in '{}' and y in '{}'; expected one unit", source.name, trajectory->text("x"), trajectory->text("y")));

  auto data = read_hdf5(source.name, source.bytes, {{kTable, "id"}, {kTable, "frame"}, {kTable, "x"}, {kTable, "y"}});
  add_ids(table, data[0].numbers);
  table[FileColumn::frame] = std::move(data[1].numbers);
  table[FileColumn::x] = std::move(data[2].numbers);
  table[FileColumn::y] = std::move(data[3].numbers);
  check_numbers(table);
  if (has(*trajectory, "z")) table.notes.push_back("z is the height of the head: the motion is two-dimensional");
  return table;
}

}  // namespace

const Reader kPedestrianHdf5 = {{"pedestrian-h5", "Pedestrian Dynamics Data Archive in HDF5", ".h5"}, recognises, read};

}  // namespace swarmfit
