// SPDX-License-Identifier: MIT
#include "reports/motion/player.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "reports/motion/film.h"
#include "reports/write/assets.h"
#include "reports/write/json_parts.h"
#include "reports/write/page.h"

namespace swarmfit {
namespace {

using json_parts::Json;

// Frame numbers as runs of consecutive ones: [first, how many].
Json clock_data(const std::vector<std::int64_t>& clock) {
  Json out = Json::array();
  for (std::size_t k = 0; k < clock.size();) {
    std::size_t end = k + 1;
    while (end < clock.size() && clock[end] == clock[end - 1] + 1) ++end;
    out.push_back({clock[k], end - k});
    k = end;
  }
  return out;
}

// What points are called by kind: "recorded", "synthetic"; nothing where all are alike.
Json kind_data(const std::vector<const Tracks*>& films) {
  Json out = Json::array();
  int kinds = 0;
  for (const Tracks* film : films) kinds = std::max(kinds, film->kinds());
  const auto& names = films.front()->meta().kinds;
  for (int k = 0; kinds > 1 && k < kinds; ++k)
    out.push_back(static_cast<std::size_t>(k) < names.size() ? names[static_cast<std::size_t>(k)] : "kind " + std::to_string(k));
  return out;
}

Json take_data(const Take& take, const std::vector<std::int64_t>& clock) {
  const PackedFilm film = pack(*take.tracks, clock);
  return {{"title", take.title}, {"series", take.series}, {"rows", film.rows},         {"runs", film.runs},
          {"lower", film.lower}, {"step", film.step},     {"data", base64(film.bytes)}};
}

Json place(const Eigen::Array3d& p) { return {p[0], p[1], p[2]}; }

Json ball_data(const Scenery::Ball& ball) { return {{"centre", place(ball.centre)}, {"radius", ball.radius}}; }

Json solid_data(const Scenery::Solid& solid) {
  Json corners = Json::array();
  for (const auto& corner : solid.corners) corners.push_back(place(corner));
  return {{"corners", corners}, {"faces", solid.faces}};
}

// Those of the frames that are played.
Tracks played(const Tracks& seen, const std::vector<std::int64_t>& clock) {
  TrackColumns some;
  std::vector<Index> rows;
  for (Index row = 0; row < seen.rows(); ++row) {
    const auto r = static_cast<std::size_t>(row);
    if (!std::binary_search(clock.begin(), clock.end(), seen.frame()[r])) continue;
    rows.push_back(row);
    some.track.push_back(seen.track()[r]);
    some.frame.push_back(seen.frame()[r]);
  }
  some.names = seen.names();
  some.pos = seen.pos()(rows, Eigen::all);
  return {std::move(some), seen.meta()};
}

Json scenery_data(const Scenery& scenery, const std::vector<std::int64_t>& clock) {
  if (!scenery.box) return nullptr;
  Json out = {
      {"lower", place(scenery.box->lower)}, {"upper", place(scenery.box->upper)}, {"balls", Json::array()}, {"solids", Json::array()}};
  for (const auto& ball : scenery.balls) out["balls"].push_back(ball_data(ball));
  for (const auto& solid : scenery.solids) out["solids"].push_back(solid_data(solid));
  if (scenery.round_arena) out["arena"] = ball_data(*scenery.round_arena);
  if (!scenery.seen) return out;
  const Tracks seen = played(*scenery.seen, clock);
  static constexpr const char* kNames[] = {"attract", "repel", "goal"};
  out["marks"] = Json::array();
  for (const std::string& name : seen.names()) {  // names are numbers of marks
    const auto& mark = scenery.marks.at(static_cast<std::size_t>(std::stoul(name)));
    out["marks"].push_back({{"kind", kNames[static_cast<std::size_t>(mark.kind)]}, {"radius", mark.radius}});
  }
  out["take"] = take_data({"", &seen}, clock);
  return out;
}

}  // namespace

Html player(const std::vector<Take>& takes, const Scenery& scenery) {
  if (takes.empty() || takes.front().tracks->rows() == 0) return {};
  std::vector<const Tracks*> films;
  for (const Take& take : takes) films.push_back(take.tracks);
  const std::vector<std::int64_t> clock = film_clock(films);
  const Tracks& first = *films.front();
  Json data = {
      {"dims", first.dims()}, {"unit", first.meta().unit}, {"dt", first.dt()}, {"clock", clock_data(clock)}, {"kinds", kind_data(films)}};
  for (const Take& take : takes) data["takes"].push_back(take_data(take, clock));
  data["scenery"] = scenery_data(scenery, clock);
  Html out = markup("<div class=\"player\">");
  out += Html{"<script type=\"application/json\">" + embedded(data.dump(-1, ' ', false, Json::error_handler_t::replace)) + "</script>"};
  out += markup("<noscript><p class=\"note\">The player needs JavaScript.</p></noscript></div>\n");
  return out;
}

std::string player_script() {
  std::string script = "\"use strict\";\n{\n";  // a block, so that the parts share names with each other and with nobody else
  for (const std::string_view part : {assets::film_js, assets::scenery_js, assets::stage_js, assets::player_js}) script += part;
  return script + "}\n";
}

}  // namespace swarmfit
