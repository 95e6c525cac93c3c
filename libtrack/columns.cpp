// SPDX-License-Identifier: MIT
#include "libtrack/columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include "libtrack/error.h"

namespace swarmfit {
namespace {

struct Name {
  std::string_view name;
  Column column;
};

constexpr std::array kNames = {Name{"id", Column::id},    Name{"frame", Column::frame}, Name{"t", Column::t},   Name{"x", Column::x},
                               Name{"y", Column::y},      Name{"z", Column::z},         Name{"vx", Column::vx}, Name{"vy", Column::vy},
                               Name{"vz", Column::vz},    Name{"ax", Column::ax},       Name{"ay", Column::ay}, Name{"az", Column::az},
                               Name{"kind", Column::kind}};

// Header names found in the wild, in lower case with '_' for any separator.
constexpr std::array kAliases = {
    Name{"particle", Column::id},
    Name{"particle_id", Column::id},
    Name{"track", Column::id},
    Name{"track_id", Column::id},
    Name{"trackid", Column::id},
    Name{"traj_id", Column::id},
    Name{"trajectory", Column::id},
    Name{"trajectory_id", Column::id},
    Name{"object", Column::id},
    Name{"object_id", Column::id},
    Name{"objectid", Column::id},
    Name{"individual", Column::id},
    Name{"individual_id", Column::id},
    Name{"individual_local_identifier", Column::id},
    Name{"animal", Column::id},
    Name{"animal_id", Column::id},
    Name{"agent", Column::id},
    Name{"agent_id", Column::id},
    Name{"bird", Column::id},
    Name{"bird_id", Column::id},
    Name{"fish", Column::id},
    Name{"fish_id", Column::id},
    Name{"person", Column::id},
    Name{"person_id", Column::id},
    Name{"persid", Column::id},
    Name{"pedestrian", Column::id},
    Name{"ped_id", Column::id},
    Name{"identity", Column::id},
    Name{"tag_id", Column::id},
    Name{"frame_id", Column::frame},
    Name{"frame_number", Column::frame},
    Name{"frame_nr", Column::frame},
    Name{"frame_no", Column::frame},
    Name{"frame_idx", Column::frame},
    Name{"frame_index", Column::frame},
    Name{"framenumber", Column::frame},
    Name{"fr", Column::frame},
    Name{"time", Column::t},
    Name{"time_s", Column::t},
    Name{"time_sec", Column::t},
    Name{"timestamp", Column::t},
    Name{"datetime", Column::t},
    Name{"date_time", Column::t},
    Name{"seconds", Column::t},
    Name{"sec", Column::t},
    Name{"position_t", Column::t},
    Name{"date", Column::date},
    Name{"pos_x", Column::x},
    Name{"pos_y", Column::y},
    Name{"pos_z", Column::z},
    Name{"x_pos", Column::x},
    Name{"y_pos", Column::y},
    Name{"z_pos", Column::z},
    Name{"xpos", Column::x},
    Name{"ypos", Column::y},
    Name{"zpos", Column::z},
    Name{"posx", Column::x},
    Name{"posy", Column::y},
    Name{"posz", Column::z},
    Name{"position_x", Column::x},
    Name{"position_y", Column::y},
    Name{"position_z", Column::z},
    Name{"easting", Column::x},
    Name{"northing", Column::y},
    Name{"utm_easting", Column::x},
    Name{"utm_northing", Column::y},
    Name{"utm_x", Column::x},
    Name{"utm_y", Column::y},
    Name{"v_x", Column::vx},
    Name{"v_y", Column::vy},
    Name{"v_z", Column::vz},
    Name{"vel_x", Column::vx},
    Name{"vel_y", Column::vy},
    Name{"vel_z", Column::vz},
    Name{"velocity_x", Column::vx},
    Name{"velocity_y", Column::vy},
    Name{"velocity_z", Column::vz},
    Name{"a_x", Column::ax},
    Name{"a_y", Column::ay},
    Name{"a_z", Column::az},
    Name{"acc_x", Column::ax},
    Name{"acc_y", Column::ay},
    Name{"acc_z", Column::az},
    Name{"acceleration_x", Column::ax},
    Name{"acceleration_y", Column::ay},
    Name{"acceleration_z", Column::az},
};

// Geographic coordinates are recognised only to be refused with advice.
constexpr std::array kDegrees = {Name{"lon", Column::x},           Name{"long", Column::x},          Name{"lng", Column::x},
                                 Name{"longitude", Column::x},     Name{"gps_lon", Column::x},       Name{"gps_long", Column::x},
                                 Name{"gps_longitude", Column::x}, Name{"location_long", Column::x}, Name{"location_lon", Column::x},
                                 Name{"lat", Column::y},           Name{"latitude", Column::y},      Name{"gps_lat", Column::y},
                                 Name{"gps_latitude", Column::y},  Name{"location_lat", Column::y}};

template <std::size_t N>
std::optional<Column> find(const std::array<Name, N>& table, std::string_view name) {
  const auto hit = std::find_if(table.begin(), table.end(), [&](const Name& n) { return n.name == name; });
  return hit == table.end() ? std::nullopt : std::optional(hit->column);
}

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

struct HeaderName {
  std::string name;  // lower case, separators as '_', without the unit
  std::string unit;
};

// "Pos X [mm]" → {"pos_x", "mm"}; units stand in brackets or behind a slash.
HeaderName normalised(std::string_view text) {
  text = trimmed(text);
  HeaderName out;
  const auto cut = text.find_first_of("[(/");
  if (cut != std::string_view::npos && cut > 0) {
    auto unit = text.substr(cut + 1);
    if (text[cut] != '/') unit = unit.substr(0, unit.find_first_of("])"));
    out.unit = trimmed(unit);
    text = trimmed(text.substr(0, cut));
  }
  out.name = lower(text);
  for (char& c : out.name)
    if (c == ' ' || c == '-' || c == '.' || c == ':') c = '_';
  return out;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const auto cut = text.find(separator);
    parts.push_back(trimmed(text.substr(0, cut)));
    if (cut == std::string_view::npos) return parts;
    text.remove_prefix(cut + 1);
  }
}

std::string_view name_of(Column column) {
  const auto hit = std::find_if(kNames.begin(), kNames.end(), [&](const Name& n) { return n.column == column; });
  return hit == kNames.end() ? "_" : hit->name;
}

std::string known_names() {
  std::string out;
  for (const auto& n : kNames) out += fmt::format("{}, ", n.name);
  return out + "or _ to skip a column";
}

Column parse_name(std::string_view text) {
  if (text == "_") return Column::skip;
  if (const auto column = find(kNames, lower(text))) return *column;
  throw InputError(fmt::format("--columns: '{}' is not a known column; expected {}", text, known_names()));
}

// What must hold for any mapping that the user wrote.
void check_user_map(const ColumnMap& map) {
  for (const auto& n : kNames)
    if (std::count(map.of.begin(), map.of.end(), n.column) > 1)
      throw InputError(fmt::format("--columns: '{}' is given twice; expected every column once", n.name));
  for (const Column c : {Column::x, Column::y})
    if (!map.has(c)) throw InputError(fmt::format("--columns: '{}' is missing; expected at least x and y", name_of(c)));
}

std::string by_name(const ColumnMap& map, const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t i = 0; i < map.of.size(); ++i)
    if (map.of[i] != Column::skip && map.of[i] != Column::date)
      out += fmt::format("{}{}={}", out.empty() ? "" : ",", name_of(map.of[i]), trimmed(names[i]));
  return out;
}

bool is_length_unit(std::string_view unit) {
  constexpr std::array units = {"nm", "um", "µm", "μm", "mm", "cm", "dm", "m", "km", "in", "inch", "ft", "px", "pixel", "pixels", "bl"};
  return std::find(units.begin(), units.end(), unit) != units.end();
}

// Units in the header, and whether positions are degrees. Times must be in seconds.
void look_at_units(ColumnMap& map, const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto header = normalised(names[i]);
    const Column column = map.of[i];
    if (column == Column::x || column == Column::y || column == Column::z) {
      if (find(kDegrees, header.name)) map.degrees = true;
      if (map.unit.empty() && is_length_unit(header.unit)) map.unit = header.unit;
    } else if (column == Column::t && (header.unit == "ms" || header.unit == "min" || header.unit == "h" || header.unit == "us")) {
      throw InputError(fmt::format("the time column '{}' is in {}; expected seconds", names[i], header.unit));
    }
  }
}

ColumnMap map_by_name(const std::vector<std::string_view>& entries, const std::vector<std::string>& names, std::size_t count) {
  if (names.empty())
    throw InputError(
        fmt::format("--columns: names are given but the file has no header; expected a list by position of its {} columns", count));
  ColumnMap map{.of = std::vector<Column>(count, Column::skip)};
  for (const auto entry : entries) {
    const auto cut = entry.find('=');
    if (cut == std::string_view::npos)
      throw InputError(fmt::format("--columns: '{}' has no '='; expected either a list by position or only entries like x=NAME", entry));
    const auto wanted = lower(trimmed(entry.substr(cut + 1)));
    const auto hit = std::find_if(names.begin(), names.end(), [&](const auto& n) { return lower(trimmed(n)) == wanted; });
    if (hit == names.end())
      throw InputError(
          fmt::format("--columns: the file has no column '{}'; expected one of {}", trimmed(entry.substr(cut + 1)), listed(names)));
    auto& column = map.of[static_cast<std::size_t>(hit - names.begin())];
    if (column != Column::skip)
      throw InputError(fmt::format("--columns: column '{}' is used twice; expected every column once", trimmed(*hit)));
    column = parse_name(trimmed(entry.substr(0, cut)));
  }
  check_user_map(map);
  look_at_units(map, names);
  map.spec = by_name(map, names);
  return map;
}

}  // namespace

bool ColumnMap::has(Column c) const { return std::find(of.begin(), of.end(), c) != of.end(); }

std::string positional(const ColumnMap& map) {
  std::string out;
  for (const Column c : map.of) out += fmt::format("{}{}", out.empty() ? "" : ",", name_of(c));
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
        fmt::format("--columns: {} columns are listed but the file has {}; expected one name per column, _ to skip", map.of.size(), count));
  if (!names.empty()) look_at_units(map, names);
  map.spec = positional(map);
  return map;
}

ColumnMap map_header(const std::vector<std::string>& names, const std::string& place) {
  ColumnMap map{.of = std::vector<Column>(names.size(), Column::skip)};
  const auto claim = [&](const auto& table, bool exact) {
    const ColumnMap before = map;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto column = find(table, normalised(names[i]).name);
      if (!column || map.of[i] != Column::skip || before.has(*column)) continue;
      if (map.has(*column)) {
        const auto other = static_cast<std::size_t>(std::find(map.of.begin(), map.of.end(), *column) - map.of.begin());
        throw InputError(fmt::format("{}: both '{}' and '{}' could be {}; expected --columns to say which{}", place, names[other], names[i],
                                     name_of(*column), exact ? " (by position)" : ""));
      }
      map.of[i] = *column;
    }
  };
  claim(kNames, true);
  claim(kAliases, false);
  claim(kDegrees, false);
  look_at_units(map, names);
  map.spec = by_name(map, names);
  return map;
}

}  // namespace swarmfit
