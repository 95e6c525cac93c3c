// SPDX-License-Identifier: MIT
// DeepLabCut CSV: rows of names scorer, individuals (of several animals), bodyparts, coords, found by these words; then frame numbers and
// x, y, likelihood of every point, in pixels.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "libtrack/error.h"
#include "libtrack/read/pose_columns.h"
#include "libtrack/text_scan.h"

namespace swarmfit {
namespace {

bool recognises(const Source& source, const ReadOptions& options) {
  if (!options.columns.empty() || !looks_like_text(source)) return false;
  Lines lines(source.bytes);
  bool scorer = false, bodyparts = false;
  for (std::string_view line; lines.number() < 4 && lines.next(line);) {
    scorer = scorer || line.starts_with("scorer,");
    bodyparts = bodyparts || line.starts_with("bodyparts,");
  }
  return scorer && bodyparts;
}

struct Head {
  std::map<std::string, std::vector<std::string>> row;  // by its first word
  TextHeader header;
};

Head read_head(const Source& source) {
  Head head;
  Lines lines(source.bytes);
  constexpr std::array<std::string_view, 4> words = {"scorer", "individuals", "bodyparts", "coords"};
  for (std::string_view line; lines.next(line);) {
    if (!has_content(line)) continue;
    auto fields = split_fields(line, ',');
    if (std::find(words.begin(), words.end(), fields[0]) == words.end()) {
      head.header.first_row = std::move(fields);
      head.header.data_at = static_cast<std::size_t>(line.data() - source.bytes.data());
      head.header.lines_before = lines.number() - 1;
      break;
    }
    head.header.names_line = lines.number();
    head.row.emplace(fields[0], fields);
  }
  if (head.header.first_row.empty()) throw InputError(source.name + ": there is no row of numbers; expected some below DeepLabCut's names");
  for (const auto* word : {"bodyparts", "coords"})
    if (!head.row.contains(word)) throw InputError(fmt::format("{}: there is no row '{}'; expected DeepLabCut's names", source.name, word));
  for (const auto& [word, row] : head.row)
    if (row.size() != head.header.first_row.size())
      throw InputError(fmt::format("{}: the row '{}' has {} columns but the first row of numbers {}; expected as many", source.name, word,
                                   row.size(), head.header.first_row.size()));
  head.header.names = head.row.at("coords");
  return head;
}

RawTable read(const Source& source, const ReadOptions& options) {
  const auto head = read_head(source);
  const auto& parts = head.row.at("bodyparts");
  const auto& coords = head.row.at("coords");
  const auto several = head.row.find("individuals");
  std::vector<PoseColumns> poses;
  for (std::size_t i = 1; i < coords.size(); ++i) {
    const auto& individual = several == head.row.end() ? "1" : several->second[i];
    auto pose = std::find_if(poses.begin(), poses.end(), [&](const auto& p) { return p.individual == individual && p.node == parts[i]; });
    if (pose == poses.end()) pose = poses.insert(poses.end(), {.individual = individual, .node = parts[i]});
    if (coords[i] == "x") pose->x = i;
    if (coords[i] == "y") pose->y = i;
    if (coords[i] == "z") pose->z = i;
    if (coords[i] == "likelihood") pose->confidence = i;
  }
  if (std::none_of(poses.begin(), poses.end(), [](const auto& p) { return p.x && p.y; }))
    throw InputError(at(source.name, head.header.names_line, 0, "there is no point with x and y; expected DeepLabCut's coords"));
  ColumnMap map{.of = std::vector<FileColumn>(coords.size(), FileColumn::skip)};
  map.of[0] = FileColumn::frame;
  auto table = read_pose_rows(source, head.header, map, poses, options);
  const bool depth = table.has(FileColumn::z);
  if (!depth) table.unit = "px";  // of a triangulation, only who calibrated the cameras knows
  return table;
}

}  // namespace

const Reader kDeepLabCutCsv = {
    {"deeplabcut-csv", "DeepLabCut, one animal or several: rows scorer, bodyparts, coords", ".csv"}, recognises, read};

}  // namespace swarmfit
