// SPDX-License-Identifier: MIT
// idtracker.ai's folder of CSV: trajectories.csv, a wide table of pixels, and attributes.json beside it with frame rate and names. A row
// is a frame of the video.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "libtrack/error.h"
#include "libtrack/file.h"
#include "libtrack/read/pose_columns.h"

namespace swarmfit {
namespace {

std::filesystem::path attributes_of(const Source& source) { return std::filesystem::path(source.name).parent_path() / "attributes.json"; }

bool recognises(const Source& source, const ReadOptions& options) {
  if (!options.columns.empty() || !looks_like_text(source)) return false;
  const auto line = source.bytes.substr(0, source.bytes.find('\n'));
  if (!line.starts_with("seconds,x1,y1") && !line.starts_with("time,x1,y1")) return false;
  std::error_code error;
  return std::filesystem::is_regular_file(attributes_of(source), error);
}

RawTable read(const Source& source, const ReadOptions& options) {
  const auto path = attributes_of(source).string();
  const auto facts = nlohmann::json::parse(read_file(path), nullptr, false);
  if (!facts.is_object()) throw InputError(path + ": no object of JSON; expected the attributes of idtracker.ai");
  const auto rate = facts.find("frames_per_second");
  if (rate == facts.end() || !rate->is_number() || !(rate->get<double>() > 0))
    throw InputError(path + ": frames_per_second is missing; expected the attributes of idtracker.ai");
  const auto header = look_at_text(source.name, source.bytes, options);
  std::vector<PoseColumns> poses;
  for (std::size_t i = 1; i < header.names.size(); ++i)
    if (header.names[i] != fmt::format("{}{}", i % 2 == 1 ? 'x' : 'y', (i + 1) / 2))
      throw InputError(
          at(source.name, header.names_line, 0, "the columns are not seconds,x1,y1,x2,y2,...; expected those of idtracker.ai"));
  if (header.names.size() < 3 || header.names.size() % 2 == 0)
    throw InputError(source.name + ": there is no pair of columns x1,y1; expected those of idtracker.ai");
  for (std::size_t i = 1; i + 1 < header.names.size(); i += 2)
    poses.push_back({.individual = std::to_string(poses.size() + 1), .node = {}, .x = i, .y = i + 1});
  const auto labels = facts.find("identities_labels");
  if (labels != facts.end() && labels->is_array() && labels->size() == poses.size())
    for (std::size_t k = 0; k < poses.size(); ++k)
      if ((*labels)[k].is_string()) poses[k].individual = (*labels)[k].get<std::string>();
  ColumnMap map{.of = std::vector<FileColumn>(header.names.size(), FileColumn::skip)};
  map.of[0] = FileColumn::t;
  auto table = read_pose_rows(source, header, map, poses, options);
  auto& frame = table[FileColumn::frame];
  for (const double t : table[FileColumn::t]) frame.push_back(std::round(t * rate->get<double>()));  // written with three decimals
  table[FileColumn::t] = {};
  table.dt = 1 / rate->get<double>();
  const auto unit = facts.find("length_unit");
  if (unit == facts.end() || !unit->is_number() || unit->get<double>() <= 0) table.unit = "px";
  table.columns = fmt::format("seconds,x1,y1,... of {} individuals", poses.size());
  return table;
}

}  // namespace

const Reader kIdtrackerCsv = {
    {"idtracker-csv", "idtracker.ai's trajectories.csv with attributes.json beside it", ".csv"}, recognises, read};

}  // namespace swarmfit
