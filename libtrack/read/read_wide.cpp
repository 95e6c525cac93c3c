// SPDX-License-Identifier: MIT
// Tables with one row per frame and a pair of columns x, y per individual: x1,y1,x2,y2 (idtracker.ai), x,y,x,y, x,y,x.1,y.1 (as pandas
// writes them), X_Arena0_Ind0 (AnimalTA). And per point of a body, with one row per individual and frame: nose.x, nose.y (SLEAP).
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "libtrack/error.h"
#include "libtrack/read/choose_id.h"
#include "libtrack/read/pose_columns.h"
#include "libtrack/read/units.h"

namespace swarmfit {
namespace {

struct Layout {
  std::vector<std::string> labels;  // in the order of the columns
  std::vector<PoseColumns> poses;   // one per label
  bool repeated = false;            // x, y, x, y: individuals in order
};

// The same names again and again, or as pandas makes them different: x, y, x.1, y.1.
bool take_repeated(const std::vector<PoseName>& parts, const std::vector<std::size_t>& columns, Layout& layout) {
  std::map<char, std::size_t> count;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!parts[i].label.empty()) return false;
    const std::size_t n = count[parts[i].part]++;
    if (n >= layout.poses.size()) layout.poses.push_back({.individual = std::to_string(n + 1), .node = {}});
    auto& pose = layout.poses[n];
    (parts[i].part == 'x' ? pose.x : parts[i].part == 'y' ? pose.y : parts[i].part == 'z' ? pose.z : pose.confidence) = columns[i];
  }
  layout.repeated = layout.poses.size() > 1;
  return layout.repeated;
}

Layout find_layout(const std::vector<std::string>& names) {
  std::vector<PoseName> parts;
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (const auto part = pose_name(column_name(names[i]).title)) {
      parts.push_back(*part);
      columns.push_back(i);
    }
  const bool plain = std::any_of(parts.begin(), parts.end(), [](const auto& p) { return p.label.empty(); });
  const bool numbered =
      std::all_of(parts.begin(), parts.end(), [](const auto& p) { return p.label.find_first_not_of("0123456789") == std::string::npos; });
  if (plain && numbered)
    for (auto& part : parts) part.label.clear();
  Layout layout;
  if (take_repeated(parts, columns, layout)) return layout;
  layout = {};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    auto at = static_cast<std::size_t>(std::find(layout.labels.begin(), layout.labels.end(), parts[i].label) - layout.labels.begin());
    if (at == layout.labels.size()) {
      layout.labels.push_back(parts[i].label);
      layout.poses.emplace_back();
    }
    auto& pose = layout.poses[at];
    (parts[i].part == 'x' ? pose.x : parts[i].part == 'y' ? pose.y : parts[i].part == 'z' ? pose.z : pose.confidence) = columns[i];
  }
  for (std::size_t k = layout.poses.size(); k-- > 0;) {
    if (layout.poses[k].x && layout.poses[k].y) continue;
    layout.poses.erase(layout.poses.begin() + static_cast<std::ptrdiff_t>(k));
    layout.labels.erase(layout.labels.begin() + static_cast<std::ptrdiff_t>(k));
  }
  if (std::find(layout.labels.begin(), layout.labels.end(), "") != layout.labels.end()) return {};  // x and y of their own: no wide table
  return layout;
}

// Frame, time and id; the positions are the layout's.
ColumnMap other_columns(std::vector<std::string> names, const Layout& layout, const std::string& place) {
  for (const auto& p : layout.poses)
    for (const auto& column : {p.x, p.y, p.z, p.confidence})
      if (column) names[*column].clear();
  auto map = map_header(names, place);
  for (auto& column : map.of)
    if (column != FileColumn::frame && column != FileColumn::t && column != FileColumn::id && column != FileColumn::date)
      column = FileColumn::skip;
  return map;
}

bool recognises(const Source& source, const ReadOptions& options) {
  if (!options.columns.empty() || !looks_like_text(source)) return false;
  try {
    const auto header = look_at_text(source.name, source.bytes, options);
    const auto layout = find_layout(header.names);
    if (layout.poses.size() >= 2) return true;
    return layout.poses.size() == 1 && !layout.repeated && !layout.labels[0].empty() && layout.poses[0].confidence;
  } catch (const InputError&) {
    return false;  // whatever is wrong is reported by the reader that takes the file in the end
  }
}

// Individuals or points? Where the rows have an id, points; where labels number individuals, these; else only the user knows.
void name_poses(Layout& layout, bool identified, const std::string& place, const ReadOptions& options) {
  if (layout.repeated) return;
  const bool numbers = std::all_of(layout.labels.begin(), layout.labels.end(), numbers_individuals);
  const bool points = identified || !options.node.empty();
  if (!points && !numbers && !options.wide)
    throw InputError(
        fmt::format("{}: there are several pairs of columns x and y: {}; expected `wide` when each is an individual, `node` NAME "
                    "or `node` mean when they are points of one",
                    place, listed(layout.labels)));
  for (std::size_t k = 0; k < layout.poses.size(); ++k) (points ? layout.poses[k].node : layout.poses[k].individual) = layout.labels[k];
  if (points && !identified)
    for (auto& pose : layout.poses) pose.individual = "1";
}

// One unit for all positions.
std::string unit_of(const Layout& layout, const std::vector<std::string>& names, const std::string& place) {
  std::string unit;
  for (const auto& p : layout.poses)
    for (const auto& column : {p.x, p.y, p.z}) {
      if (!column) continue;
      const auto found = length_unit(column_name(names[*column]).unit);
      if (!found) continue;
      if (!unit.empty() && unit != *found)
        throw InputError(fmt::format("{}: columns are in {} and in {}; expected one length unit for all coordinates", place, unit, *found));
      unit = *found;
    }
  return unit;
}

// SLEAP leaves its column `track` empty where there is one animal, and always writes pixels.
void settle_sleap(RawTable& table, const std::vector<std::string>& names) {
  if (std::find(names.begin(), names.end(), "instance.score") == names.end()) return;
  if (table.unit.empty()) table.unit = "px";
  auto frames = table[FileColumn::frame];
  const bool nobody = std::all_of(table.track.begin(), table.track.end(), [](auto track) { return track == RawTable::no_track; });
  if (!nobody || frames.empty()) return;
  std::sort(frames.begin(), frames.end());
  if (std::adjacent_find(frames.begin(), frames.end()) != frames.end())
    throw InputError(table.file +
                     ": no row has a track, and frames have several: these are detections without identities; expected tracks");
  std::fill(table.track.begin(), table.track.end(), table.names.number("1"));
  table.notes.emplace_back("no row has a track, and no frame two rows: they are one individual");
}

RawTable read(const Source& source, const ReadOptions& options) {
  auto header = look_at_text(source.name, source.bytes, options);
  const auto place = fmt::format("{}:{}", source.name, header.names_line);
  auto layout = find_layout(header.names);
  if (layout.poses.empty()) throw InputError(place + ": there are no pairs of columns x and y; expected one for every individual or point");
  auto map = other_columns(header.names, layout, place);
  if (auto remark = choose_id(map, source.name, source.bytes, header); !remark.empty()) header.notes.push_back(std::move(remark));
  const bool identified = map.has(FileColumn::id);
  name_poses(layout, identified, place, options);
  auto table = read_pose_rows(source, header, map, layout.poses, options);
  if (table.unit.empty()) table.unit = unit_of(layout, header.names, place);
  settle_sleap(table, header.names);
  if (!identified && layout.poses.size() > 1 && options.node.empty())
    table.notes.push_back(fmt::format("every pair of columns x and y is one of {} individuals{}", layout.poses.size(),
                                      layout.repeated ? ", numbered from 1 in their order" : ""));
  return table;
}

}  // namespace

const Reader kWide = {
    {"wide", "text with columns x, y for every individual (idtracker.ai, AnimalTA) or every point of a body (SLEAP)", ".csv .txt .tsv"},
    recognises,
    read};

}  // namespace swarmfit
