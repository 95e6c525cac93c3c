// SPDX-License-Identifier: MIT
// Postures with one row per individual, frame and point: frame, individual, keypoint, x, y, confidence.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "libtrack/error.h"
#include "libtrack/nan.h"
#include "libtrack/read/choose_id.h"
#include "libtrack/read/postures.h"
#include "libtrack/read/read_text.h"

namespace swarmfit {
namespace {

constexpr std::array<std::string_view, 9> kPoint = {"keypoint", "keypoints", "bodypart", "body_part", "bodyparts",
                                                    "node",     "landmark",  "joint",    "key_point"};
constexpr std::array<std::string_view, 4> kConfidence = {"confidence", "likelihood", "score", "probability"};

template <std::size_t N>
std::optional<std::size_t> find(const std::vector<std::string>& names, const std::array<std::string_view, N>& wanted) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (std::find(wanted.begin(), wanted.end(), column_name(names[i]).name) != wanted.end()) return i;
  return std::nullopt;
}

bool recognises(const Source& source, const ReadOptions& options) {
  if (!options.columns.empty() || !looks_like_text(source)) return false;
  try {
    const auto header = look_at_text(source.name, source.bytes, options);
    if (!find(header.names, kPoint)) return false;
    const auto map = map_header(header.names, source.name);
    return map.has(FileColumn::x) && map.has(FileColumn::y);
  } catch (const InputError&) {
    return false;
  }
}

// The rows in the order of individual and moment, so that those of one posture stand together.
std::vector<std::size_t> by_posture(const RawTable& rows, const std::vector<double>& moment) {
  std::vector<std::size_t> order(rows.track.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return rows.track[a] != rows.track[b] ? rows.track[a] < rows.track[b] : moment[a] < moment[b]; });
  return order;
}

RawTable read(const Source& source, const ReadOptions& options) {
  auto header = look_at_text(source.name, source.bytes, options);
  auto map = map_header(header.names, fmt::format("{}:{}", source.name, header.names_line));
  if (auto remark = choose_id(map, source.name, source.bytes, header); !remark.empty()) header.notes.push_back(std::move(remark));
  Cells cells;
  cells.words_in = find(header.names, kPoint);
  if (!cells.words_in) throw InputError(at(source.name, header.names_line, 0, "there is no column of points; expected one named keypoint"));
  if (const auto confidence = find(header.names, kConfidence)) cells.columns = {*confidence};
  RawTable rows = read_rows(source, header, map, options, &cells);
  if (!rows.has(FileColumn::x) || !rows.has(FileColumn::y) || (!rows.has(FileColumn::frame) && !rows.has(FileColumn::t)))
    throw InputError(at(source.name, header.names_line, 0, "no columns of frame (or t), x and y; expected them beside the points"));

  constexpr double none = kNaN;
  RawTable table;
  table.file = rows.file;
  table.names = rows.names;
  const auto nodes = cells.words.names();
  Postures postures(table, options, nodes);
  const bool depth = rows.has(FileColumn::z), timed = rows.has(FileColumn::t), framed = rows.has(FileColumn::frame);
  const auto& moment = rows[framed ? FileColumn::frame : FileColumn::t];
  const auto order = by_posture(rows, moment);
  std::vector<double> x, y, z, confidence;
  for (std::size_t i = 0; i < order.size();) {
    const auto row = order[i];
    x.assign(nodes.size(), none);
    y = confidence = x;
    z.assign(depth ? nodes.size() : 0, none);
    for (; i < order.size() && rows.track[order[i]] == rows.track[row] && moment[order[i]] == moment[row]; ++i) {
      const auto point = order[i], k = static_cast<std::size_t>(cells.word[point]);
      if (!std::isnan(x[k]))
        throw InputError(
            fmt::format("{}: the individual has point '{}' twice in one frame; expected each once", rows.place(point), nodes[k]));
      x[k] = rows[FileColumn::x][point];
      y[k] = rows[FileColumn::y][point];
      if (depth) z[k] = rows[FileColumn::z][point];
      if (!cells.columns.empty()) confidence[k] = cells.at(point, 0);
    }
    const std::size_t before = table.track.size();
    postures.add({rows.track[row], framed ? moment[row] : none, timed ? rows[FileColumn::t][row] : none, x, y, z, confidence});
    if (table.track.size() > before) table.line.push_back(rows.line[row]);
  }
  table.notes = std::move(rows.notes);
  postures.finish();
  table.dt = rows.dt;
  table.t0 = rows.t0;
  table.unit = rows.unit;
  return table;
}

}  // namespace

const Reader kKeypoints = {{"keypoints", "text with one row per individual, frame and point of a body", ".csv .txt"}, recognises, read};

}  // namespace swarmfit
