// SPDX-License-Identifier: MIT
// FastTrack's tracking.txt: head, tail and body of every individual in every image, in pixels; the body, unless --node says otherwise.

#include "libtrack/read/pose_columns.h"

namespace swarmfit {
namespace {

bool recognises(const Source& source, const ReadOptions& options) {
  if (!options.columns.empty() || !looks_like_text(source)) return false;
  const auto line = source.bytes.substr(0, source.bytes.find('\n'));
  return line.find("xHead") != std::string_view::npos && line.find("xBody") != std::string_view::npos &&
         line.find("imageNumber") != std::string_view::npos;
}

RawTable read(const Source& source, const ReadOptions& options) {
  const auto header = look_at_text(source.name, source.bytes, options);
  const auto find = [&](std::string_view column) { return column_named(column, header, source.name, "FastTrack"); };
  ColumnMap map{.of = std::vector<FileColumn>(header.names.size(), FileColumn::skip)};
  map.of[find("imageNumber")] = FileColumn::frame;
  map.of[find("id")] = FileColumn::id;
  std::vector<PoseColumns> poses;
  for (const auto* part : {"Head", "Tail", "Body"}) {
    std::string node = part;
    node[0] = static_cast<char>(node[0] - 'A' + 'a');
    poses.push_back({.individual = {}, .node = node, .x = find(std::string("x") + part), .y = find(std::string("y") + part)});
  }
  auto table = read_pose_rows(source, header, map, poses, options, "body");
  table.unit = "px";
  return table;
}

}  // namespace

const Reader kFastTrackText = {{"fasttrack-text", "FastTrack's tracking.txt: head, tail and body", ".txt"}, recognises, read};

}  // namespace swarmfit
