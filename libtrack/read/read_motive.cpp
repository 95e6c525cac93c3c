// SPDX-License-Identifier: MIT
// CSV of OptiTrack's Motive: a line of facts, rows Type, Name, ID, kind and axis, then frame, seconds and numbers. Rigid bodies are the
// individuals, or markers where there are none. z is the third axis of the file, whichever points up.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "libtrack/error.h"
#include "libtrack/read/pose_columns.h"
#include "libtrack/text_scan.h"

namespace swarmfit {
namespace {

bool recognises(const Source& source, const ReadOptions& options) {
  return options.columns.empty() && looks_like_text(source) && source.bytes.starts_with("Format Version,");
}

struct Head {
  std::vector<std::string> facts, type, name, kind;
  TextHeader header;
};

Head read_head(const Source& source) {
  Head head;
  Lines lines(source.bytes);
  std::vector<std::string> before;
  bool axes = false;
  for (std::string_view line; lines.number() < 20 && lines.next(line);) {
    auto fields = split_fields(line, ',');
    if (axes) {
      head.header.first_row = std::move(fields);
      head.header.data_at = static_cast<std::size_t>(line.data() - source.bytes.data());
      head.header.lines_before = lines.number() - 1;
      break;
    }
    if (lines.number() == 1) head.facts = fields;
    if (fields.size() > 2 && fields[1] == "Type") head.type = fields;
    if (fields.size() > 2 && fields[1] == "Name") head.name = fields;
    if (fields[0] == "Frame") {
      axes = true;
      head.kind = before;
      head.header.names = fields;
      head.header.names_line = lines.number();
    }
    before = std::move(fields);
  }
  const auto n = head.header.names.size();
  if (head.header.first_row.size() != n || n < 3 || head.type.size() != n || head.name.size() != n || head.kind.size() != n)
    throw InputError(source.name + ": the rows Type, Name, kind and axis do not fit the numbers; expected an export of Motive");
  return head;
}

// "Length Units,Meters": what stands behind a word in the first line.
std::string fact(const Head& head, std::string_view word) {
  const auto hit = std::find(head.facts.begin(), head.facts.end(), word);
  return hit == head.facts.end() || hit + 1 == head.facts.end() ? std::string() : hit[1];
}

std::vector<PoseColumns> columns_of(const Head& head, std::string_view type) {
  std::vector<PoseColumns> poses;
  for (std::size_t i = 2; i < head.name.size(); ++i) {
    if (head.type[i] != type || head.kind[i] != "Position") continue;
    auto pose = std::find_if(poses.begin(), poses.end(), [&](const auto& p) { return p.individual == head.name[i]; });
    if (pose == poses.end()) pose = poses.insert(poses.end(), {.individual = head.name[i], .node = {}});
    const auto& axis = head.header.names[i];
    if (axis == "X") pose->x = i;
    if (axis == "Y") pose->y = i;
    if (axis == "Z") pose->z = i;
  }
  std::erase_if(poses, [](const auto& p) { return !p.x || !p.y || !p.z; });
  return poses;
}

RawTable read(const Source& source, const ReadOptions& options) {
  const auto head = read_head(source);
  auto poses = columns_of(head, "Rigid Body");
  if (poses.empty()) poses = columns_of(head, "Marker");
  if (poses.empty())
    throw InputError(source.name + ": there is neither a rigid body nor a marker with positions; expected an export of Motive");
  ColumnMap map{.of = std::vector<FileColumn>(head.header.names.size(), FileColumn::skip)};
  map.of[0] = FileColumn::frame;
  auto table = read_pose_rows(source, head.header, map, poses, options);
  const auto rate = fact(head, "Export Frame Rate"), unit = fact(head, "Length Units");
  double fps = 0;
  std::from_chars(rate.data(), rate.data() + rate.size(), fps);
  if (fps > 0) table.dt = 1 / fps;
  table.unit = length_unit(unit).value_or("");
  table.columns = fmt::format("{} of {} individuals", "Position", poses.size());
  return table;
}

}  // namespace

const Reader kMotive = {{"motive", "Motive (OptiTrack) CSV: rigid bodies, or markers", ".csv"}, recognises, read};

}  // namespace swarmfit
