// SPDX-License-Identifier: MIT
#include "libtrack/read/pose_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "libtrack/error.h"
#include "libtrack/nan.h"
#include "libtrack/read/postures.h"
#include "libtrack/text_scan.h"

namespace swarmfit {
namespace {

bool is_number(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::vector<std::string> tokens(std::string_view text) {
  std::vector<std::string> out(1);
  for (const char c : text) {
    if (c == '_' || c == '.' || c == ' ' || c == '-' || c == ':')
      out.emplace_back();
    else
      out.back() += c;
  }
  std::erase_if(out, [](const std::string& t) { return t.empty(); });
  return out;
}

template <std::size_t N>
bool among(const std::array<std::string_view, N>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

constexpr std::array<std::string_view, 6> kConfidence = {"score", "likelihood", "confidence", "probability", "prob", "conf"};
constexpr std::array<std::string_view, 8> kOther = {"vel", "velocity", "acc", "acceleration", "speed", "instance", "bbox", "size"};
constexpr std::array<std::string_view, 4> kOtherLetters = {"v", "a", "w", "h"};  // a_x is an acceleration, A.x a point
constexpr std::array<std::string_view, 3> kPositionWords = {"pos", "position", "coord"};
constexpr std::array<std::string_view, 22> kIndividual = {
    "",     "ind", "id",  "individual", "animal", "particle", "agent",      "track",  "fish",  "mouse", "rat",
    "bird", "bee", "ant", "fly",        "person", "ped",      "pedestrian", "object", "arena", "tag",   "subject"};

// All individuals and nodes in the order of the columns.
template <class Get>
std::vector<std::string> distinct(const std::vector<PoseColumns>& poses, Get get) {
  std::vector<std::string> out;
  for (const auto& p : poses)
    if (std::find(out.begin(), out.end(), get(p)) == out.end()) out.push_back(get(p));
  return out;
}

// Where the parts of one individual's nodes stand among the cells of a row.
struct Body {
  std::string name;
  std::vector<std::size_t> x, y, z, confidence;  // one per node; npos: none
};

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

std::vector<Body> bodies(const std::vector<PoseColumns>& poses, const std::vector<std::string>& nodes, const Cells& cells) {
  std::vector<Body> out;
  const auto cell = [&](std::optional<std::size_t> column) {
    return column ? static_cast<std::size_t>(std::lower_bound(cells.columns.begin(), cells.columns.end(), *column) - cells.columns.begin())
                  : kNone;
  };
  for (const auto& name : distinct(poses, [](const auto& p) { return p.individual; })) {
    const std::vector<std::size_t> none(nodes.size(), kNone);
    Body body{name, none, none, none, none};
    for (const auto& p : poses) {
      if (p.individual != name) continue;
      const auto k = static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), p.node) - nodes.begin());
      body.x[k] = cell(p.x);
      body.y[k] = cell(p.y);
      body.z[k] = cell(p.z);
      body.confidence[k] = cell(p.confidence);
    }
    out.push_back(std::move(body));
  }
  return out;
}

Cells wanted_cells(const std::vector<PoseColumns>& poses) {
  Cells cells;
  for (const auto& p : poses)
    for (const auto& column : {p.x, p.y, p.z, p.confidence})
      if (column) cells.columns.push_back(*column);
  std::sort(cells.columns.begin(), cells.columns.end());
  return cells;
}

}  // namespace

std::optional<PoseName> pose_name(std::string_view name) {
  PoseName out{.label = {}, .part = 0};
  for (const auto& token : tokens(name)) {
    const auto word = lower(token);
    const bool axis = word == "x" || word == "y" || word == "z";
    const bool numbered = word.size() > 1 && word[0] >= 'x' && word[0] <= 'z' && is_number(std::string_view(word).substr(1));
    if (among(kOther, word) || among(kOtherLetters, token)) return std::nullopt;
    if (among(kPositionWords, word)) continue;
    if (axis || numbered || among(kConfidence, word)) {
      if (out.part != 0) return std::nullopt;
      out.part = axis || numbered ? word[0] : 'c';
      if (!numbered) continue;
    }
    if (!out.label.empty()) out.label += '_';
    out.label += numbered ? token.substr(1) : token;
  }
  return out.part == 0 ? std::nullopt : std::optional(out);
}

bool numbers_individuals(const std::string& label) {
  bool digits = false;
  for (const auto& token : tokens(label)) {
    auto word = lower(token);
    while (!word.empty() && is_number(std::string_view(word).substr(word.size() - 1))) {
      word.pop_back();
      digits = true;
    }
    if (!among(kIndividual, word)) return false;
  }
  return digits;
}

RawTable read_pose_rows(const Source& source, const TextHeader& header, const ColumnMap& map, const std::vector<PoseColumns>& poses,
                        const ReadOptions& options, const std::string& usual_node) {
  Cells cells = wanted_cells(poses);
  RawTable rows = read_rows(source, header, map, options, &cells);
  const auto nodes = distinct(poses, [](const auto& p) { return p.node; });
  const auto all = bodies(poses, nodes, cells);
  const bool depth = std::any_of(poses.begin(), poses.end(), [](const auto& p) { return p.z.has_value(); });
  const bool unnamed = nodes.size() == 1 && nodes[0].empty(), identified = map.has(FileColumn::id);

  RawTable table;
  table.file = rows.file;
  if (identified) table.names = rows.names;
  Postures postures(table, options, unnamed ? std::vector<std::string>{"position"} : nodes, usual_node);
  std::vector<double> x(nodes.size()), y(nodes.size()), z(depth ? nodes.size() : 0), confidence(nodes.size());
  for (std::size_t row = 0; row < rows.track.size(); ++row) {
    const auto fill = [&](std::vector<double>& to, const std::vector<std::size_t>& from) {
      for (std::size_t k = 0; k < to.size(); ++k) to[k] = from[k] == kNone ? kNaN : cells.at(row, from[k]);
    };
    for (const auto& body : all) {
      fill(x, body.x);
      fill(y, body.y);
      fill(z, body.z);
      fill(confidence, body.confidence);
      const std::size_t before = table.track.size();
      postures.add({.track = identified ? rows.track[row] : table.names.number(body.name),
                    .frame = rows.has(FileColumn::frame) ? rows[FileColumn::frame][row] : kNaN,
                    .time = rows.has(FileColumn::t) ? rows[FileColumn::t][row] : kNaN,
                    .x = x,
                    .y = y,
                    .z = z,
                    .confidence = confidence});
      if (table.track.size() > before) table.line.push_back(rows.line[row]);
    }
  }
  table.notes = std::move(rows.notes);
  postures.finish();
  if (unnamed) table.has_nodes = false;
  table.dt = rows.dt;
  table.t0 = rows.t0;
  table.unit = rows.unit;
  table.synthetic = rows.synthetic;
  table.episodes = rows.episodes;
  return table;
}

}  // namespace swarmfit
