// SPDX-License-Identifier: MIT
#include "libtrack/read/columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include "libtrack/error.h"
#include "libtrack/text_scan.h"

namespace swarmfit {
namespace {

struct Name {
  std::string_view name;
  FileColumn column;
};

constexpr std::array kNames = {Name{"id", FileColumn::id},    Name{"frame", FileColumn::frame}, Name{"t", FileColumn::t},
                               Name{"x", FileColumn::x},      Name{"y", FileColumn::y},         Name{"z", FileColumn::z},
                               Name{"vx", FileColumn::vx},    Name{"vy", FileColumn::vy},       Name{"vz", FileColumn::vz},
                               Name{"ax", FileColumn::ax},    Name{"ay", FileColumn::ay},       Name{"az", FileColumn::az},
                               Name{"kind", FileColumn::kind}};

// Header names found in the wild, in lower case with '_' for any separator.
constexpr std::array kAliases = {
    Name{"particle", FileColumn::id},
    Name{"particle_id", FileColumn::id},
    Name{"track", FileColumn::id},
    Name{"track_id", FileColumn::id},
    Name{"trackid", FileColumn::id},
    Name{"traj_id", FileColumn::id},
    Name{"trajectory", FileColumn::id},
    Name{"trajectory_id", FileColumn::id},
    Name{"object", FileColumn::id},
    Name{"object_id", FileColumn::id},
    Name{"objectid", FileColumn::id},
    Name{"individual", FileColumn::id},
    Name{"individual_id", FileColumn::id},
    Name{"individual_local_identifier", FileColumn::id},
    Name{"animal", FileColumn::id},
    Name{"animal_id", FileColumn::id},
    Name{"agent", FileColumn::id},
    Name{"agent_id", FileColumn::id},
    Name{"bird", FileColumn::id},
    Name{"bird_id", FileColumn::id},
    Name{"fish", FileColumn::id},
    Name{"fish_id", FileColumn::id},
    Name{"person", FileColumn::id},
    Name{"person_id", FileColumn::id},
    Name{"persid", FileColumn::id},
    Name{"pedestrian", FileColumn::id},
    Name{"ped_id", FileColumn::id},
    Name{"identity", FileColumn::id},
    Name{"tag_id", FileColumn::id},
    Name{"frame_id", FileColumn::frame},
    Name{"frame_number", FileColumn::frame},
    Name{"frame_nr", FileColumn::frame},
    Name{"frame_no", FileColumn::frame},
    Name{"frame_idx", FileColumn::frame},
    Name{"frame_index", FileColumn::frame},
    Name{"framenumber", FileColumn::frame},
    Name{"fr", FileColumn::frame},
    Name{"time", FileColumn::t},
    Name{"time_s", FileColumn::t},
    Name{"time_sec", FileColumn::t},
    Name{"timestamp", FileColumn::t},
    Name{"datetime", FileColumn::t},
    Name{"date_time", FileColumn::t},
    Name{"seconds", FileColumn::t},
    Name{"sec", FileColumn::t},
    Name{"position_t", FileColumn::t},
    Name{"ms", FileColumn::t},
    Name{"msec", FileColumn::t},
    Name{"milliseconds", FileColumn::t},
    Name{"date", FileColumn::date},
    Name{"pos_x", FileColumn::x},
    Name{"pos_y", FileColumn::y},
    Name{"pos_z", FileColumn::z},
    Name{"x_pos", FileColumn::x},
    Name{"y_pos", FileColumn::y},
    Name{"z_pos", FileColumn::z},
    Name{"xpos", FileColumn::x},
    Name{"ypos", FileColumn::y},
    Name{"zpos", FileColumn::z},
    Name{"posx", FileColumn::x},
    Name{"posy", FileColumn::y},
    Name{"posz", FileColumn::z},
    Name{"position_x", FileColumn::x},
    Name{"position_y", FileColumn::y},
    Name{"position_z", FileColumn::z},
    Name{"x#wcentroid", FileColumn::x},
    Name{"y#wcentroid", FileColumn::y},
    Name{"easting", FileColumn::x},
    Name{"northing", FileColumn::y},
    Name{"utm_easting", FileColumn::x},
    Name{"utm_northing", FileColumn::y},
    Name{"utm_x", FileColumn::x},
    Name{"utm_y", FileColumn::y},
    Name{"v_x", FileColumn::vx},
    Name{"v_y", FileColumn::vy},
    Name{"v_z", FileColumn::vz},
    Name{"vel_x", FileColumn::vx},
    Name{"vel_y", FileColumn::vy},
    Name{"vel_z", FileColumn::vz},
    Name{"velocity_x", FileColumn::vx},
    Name{"velocity_y", FileColumn::vy},
    Name{"velocity_z", FileColumn::vz},
    Name{"a_x", FileColumn::ax},
    Name{"a_y", FileColumn::ay},
    Name{"a_z", FileColumn::az},
    Name{"acc_x", FileColumn::ax},
    Name{"acc_y", FileColumn::ay},
    Name{"acc_z", FileColumn::az},
    Name{"acceleration_x", FileColumn::ax},
    Name{"acceleration_y", FileColumn::ay},
    Name{"acceleration_z", FileColumn::az},
};

// Geographic coordinates; they are projected to metres.
constexpr std::array kDegrees = {
    Name{"lon", FileColumn::x},           Name{"long", FileColumn::x},          Name{"lng", FileColumn::x},
    Name{"longitude", FileColumn::x},     Name{"gps_lon", FileColumn::x},       Name{"gps_long", FileColumn::x},
    Name{"gps_longitude", FileColumn::x}, Name{"location_long", FileColumn::x}, Name{"location_lon", FileColumn::x},
    Name{"lat", FileColumn::y},           Name{"latitude", FileColumn::y},      Name{"gps_lat", FileColumn::y},
    Name{"gps_latitude", FileColumn::y},  Name{"location_lat", FileColumn::y}};

template <std::size_t N>
std::optional<FileColumn> find(const std::array<Name, N>& table, std::string_view name) {
  const auto hit = std::find_if(table.begin(), table.end(), [&](const Name& n) { return n.name == name; });
  return hit == table.end() ? std::nullopt : std::optional(hit->column);
}

std::string_view without_blanks(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const auto cut = text.find(separator);
    parts.push_back(without_blanks(text.substr(0, cut)));
    if (cut == std::string_view::npos) return parts;
    text.remove_prefix(cut + 1);
  }
}

std::string_view name_of(FileColumn column) {
  const auto hit = std::find_if(kNames.begin(), kNames.end(), [&](const Name& n) { return n.column == column; });
  return hit == kNames.end() ? "_" : hit->name;
}

std::string known_names() {
  std::string out;
  for (const auto& n : kNames) out += fmt::format("{}, ", n.name);
  return out + "or _ to skip a column";
}

FileColumn parse_name(std::string_view text) {
  if (text == "_") return FileColumn::skip;
  if (const auto column = find(kNames, lower(text))) return *column;
  throw InputError(fmt::format("`columns`: '{}' is not a known column; expected {}", text, known_names()));
}

// What must hold for any mapping that the user wrote.
void check_user_map(const ColumnMap& map) {
  for (const auto& n : kNames)
    if (std::count(map.of.begin(), map.of.end(), n.column) > 1)
      throw InputError(fmt::format("`columns`: '{}' is given twice; expected every column once", n.name));
  for (const FileColumn c : {FileColumn::x, FileColumn::y})
    if (!map.has(c)) throw InputError(fmt::format("`columns`: '{}' is missing; expected at least x and y", name_of(c)));
}

// Units in the header, and whether positions are degrees.
void look_at_units(ColumnMap& map, const std::vector<std::string>& names, const std::string& place) {
  std::size_t first = 0;
  for (std::size_t i = 0; i < std::min(names.size(), map.of.size()); ++i) {
    const auto header = column_name(names[i]);
    auto& column = map.of[i];
    if (column == FileColumn::x || column == FileColumn::y || column == FileColumn::z) {
      if (find(kDegrees, header.name)) map.degrees = true;
      const auto unit = length_unit(header.unit);
      if (!unit) continue;
      if (!map.unit.empty() && map.unit != *unit)
        throw InputError(fmt::format("{}: '{}' is in {} but '{}' in {}; expected one length unit for all coordinates", place,
                                     without_blanks(names[first]), map.unit, without_blanks(names[i]), *unit));
      if (map.unit.empty()) first = i;
      map.unit = *unit;
    } else if (column == FileColumn::t) {
      if (lower(header.unit).starts_with("frame")) column = FileColumn::frame;
      const std::string_view unit = header.unit.empty() ? std::string_view(header.name) : std::string_view(header.unit);
      map.time = time_unit(unit).value_or(TimeUnit{});
    }
  }
}

ColumnMap map_by_name(const std::vector<std::string_view>& entries, const std::vector<std::string>& names, std::size_t count) {
  if (names.empty())
    throw InputError(
        fmt::format("`columns`: names are given but the file has no header; expected a list by position of its {} columns", count));
  ColumnMap map{.of = std::vector<FileColumn>(count, FileColumn::skip)};
  for (const auto entry : entries) {
    const auto cut = entry.find('=');
    if (cut == std::string_view::npos)
      throw InputError(fmt::format("`columns`: '{}' has no '='; expected either a list by position or only entries like x=NAME", entry));
    const auto wanted = lower(without_blanks(entry.substr(cut + 1)));
    const auto hit = std::find_if(names.begin(), names.end(), [&](const auto& n) { return lower(without_blanks(n)) == wanted; });
    if (hit == names.end())
      throw InputError(
          fmt::format("`columns`: the file has no column '{}'; expected one of {}", without_blanks(entry.substr(cut + 1)), listed(names)));
    auto& column = map.of[static_cast<std::size_t>(hit - names.begin())];
    if (column != FileColumn::skip)
      throw InputError(fmt::format("`columns`: column '{}' is used twice; expected every column once", without_blanks(*hit)));
    column = parse_name(without_blanks(entry.substr(0, cut)));
  }
  check_user_map(map);
  look_at_units(map, names, "`columns`");
  map.spec = by_name(map, names);
  return map;
}

// Whether two columns may both claim to be this one: the rows settle who is the individual.
bool settled_by_rows(FileColumn column) { return column == FileColumn::id; }

}  // namespace

std::string by_name(const ColumnMap& map, const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t i = 0; i < map.of.size(); ++i)
    if (map.of[i] != FileColumn::skip && map.of[i] != FileColumn::date)
      out += fmt::format("{}{}={}", out.empty() ? "" : ",", name_of(map.of[i]), without_blanks(names[i]));
  return out;
}

bool ColumnMap::has(FileColumn c) const { return std::find(of.begin(), of.end(), c) != of.end(); }

std::string positional(const ColumnMap& map) {
  std::string out;
  for (const FileColumn c : map.of) out += fmt::format("{}{}", out.empty() ? "" : ",", name_of(c));
  return out;
}

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t most = 20;
  std::string out;
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i) out += fmt::format("{}{}", i > 0 ? ", " : "", names[i].substr(0, 40));
  return names.size() > most ? fmt::format("{}, ... ({} in all)", out, names.size()) : out;
}

ColumnMap map_columns(std::string_view spec, const std::vector<std::string>& names, std::size_t count) {
  const auto entries = split(spec, ',');
  if (spec.find('=') != std::string_view::npos) return map_by_name(entries, names, count);
  ColumnMap map;
  for (const auto entry : entries) map.of.push_back(parse_name(entry));
  check_user_map(map);
  if (map.of.size() != count)
    throw InputError(
        fmt::format("`columns`: {} columns are listed but the file has {}; expected one name per column, _ to skip", map.of.size(), count));
  look_at_units(map, names, "`columns`");
  map.spec = positional(map);
  return map;
}

ColumnMap map_header(const std::vector<std::string>& names, const std::string& place) {
  ColumnMap map{.of = std::vector<FileColumn>(names.size(), FileColumn::skip)};
  const auto claim = [&](const auto& table, bool exact) {
    const ColumnMap before = map;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto column = find(table, column_name(names[i]).name);
      if (!column || map.of[i] != FileColumn::skip) continue;
      if (settled_by_rows(*column)) map.id_claims.push_back(i);
      if (before.has(*column) || (settled_by_rows(*column) && map.has(*column))) continue;
      if (map.has(*column)) {
        const auto other = static_cast<std::size_t>(std::find(map.of.begin(), map.of.end(), *column) - map.of.begin());
        throw InputError(fmt::format("{}: both '{}' and '{}' could be {}; expected `columns` to say which{}", place, names[other], names[i],
                                     name_of(*column), exact ? " (by position)" : ""));
      }
      map.of[i] = *column;
    }
  };
  claim(kNames, true);
  claim(kAliases, false);
  claim(kDegrees, false);
  if (map.id_claims.size() < 2) map.id_claims.clear();
  look_at_units(map, names, place);
  map.spec = by_name(map, names);
  return map;
}

}  // namespace swarmfit
