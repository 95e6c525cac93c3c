// SPDX-License-Identifier: MIT
#include "reports/motion/player.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "reports/motion/film.h"
#include "reports/write/assets.h"
#include "reports/write/page.h"

namespace swarmfit {
namespace {

using Json = nlohmann::ordered_json;

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

}  // namespace

Html player(const std::vector<Take>& takes) {
  if (takes.empty() || takes.front().tracks->rows() == 0) return {};
  std::vector<const Tracks*> films;
  for (const Take& take : takes) films.push_back(take.tracks);
  const std::vector<std::int64_t> clock = film_clock(films);
  const Tracks& first = *films.front();
  Json data = {
      {"dims", first.dims()}, {"unit", first.meta().unit}, {"dt", first.dt()}, {"clock", clock_data(clock)}, {"kinds", kind_data(films)}};
  for (const Take& take : takes) data["takes"].push_back(take_data(take, clock));
  Html out = markup("<div class=\"player\">");
  out += Html{"<script type=\"application/json\">" + embedded(data.dump(-1, ' ', false, Json::error_handler_t::replace)) + "</script>"};
  out += markup("<noscript><p class=\"note\">The player needs JavaScript.</p></noscript></div>\n");
  return out;
}

std::string player_script() {
  std::string script = "\"use strict\";\n{\n";  // a block, so that the parts share names with each other and with nobody else
  for (const std::string_view part : {assets::film_js, assets::stage_js, assets::player_js}) script += part;
  return script + "}\n";
}

}  // namespace swarmfit
