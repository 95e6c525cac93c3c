// SPDX-License-Identifier: MIT
#include "reports/comparison/skill_json.h"

#include <nlohmann/json.hpp>

#include "reports/comparison/words.h"
#include "reports/write/json_parts.h"
#include "reports/write/unit_text.h"

namespace swarmfit {
namespace {

using json_parts::Json;
using json_parts::per_column;

Json observables(const PanelFacts& panel, const std::vector<Estimate>& values) {
  Json out = Json::object();
  for (std::size_t k = 0; k < values.size(); ++k) out[panel.items[k].key] = {{"value", values[k].value}, {"se", values[k].se}};
  return out;
}

Json curve(const std::vector<Estimate>& values) {
  Json value = Json::array(), se = Json::array();
  for (const Estimate& e : values) value.push_back(e.value), se.push_back(e.se);
  return {{"value", std::move(value)}, {"se", std::move(se)}};
}

const char* null_name(SkillNull null) { return null == SkillNull::steps ? "steps" : null == SkillNull::places ? "places" : nullptr; }

Json refuted_by(const ModelFit& r, const std::string& length_unit) {
  Json out = Json::array();
  for (const Refutation& f : r.likeness.refuted_by)
    out.push_back({{"key", f.item.key},
                   {"name", f.item.name},
                   {"unit", panel_unit(f.item, length_unit)},
                   {"recording", {{"value", f.recording.value}, {"se", f.recording.se}}},
                   {"model", {{"value", f.model}, {"sd", f.sd}}}});
  return out;
}

Json leave_one_out(const Comparison& c) {
  Json out = Json::array();
  for (const LeftOut& w : c.ranking.without) {
    Json ranking = Json::array();
    for (const auto& [model, score] : w.ranking) ranking.push_back({{"name", model}, {"score", score}});
    out.push_back({{"without", w.model},
                   {"weights", per_column(c.recording.columns, w.weights)},
                   {"ranking", std::move(ranking)},
                   {"reordered", w.reordered},
                   {"winner_changed", w.winner_changed}});
  }
  return out;
}

}  // namespace

void add_skill(Json& top, const Comparison& c) {
  const SkillFacts& s = c.recording.skill;
  top["floor"] = per_column(c.recording.columns, s.floor);
  top["floor_sd"] = per_column(c.recording.columns, s.floor_sd);
  top["null"] = per_column(c.recording.columns, s.null);
  top["places"] = per_column(c.recording.columns, s.places);
  top["informative"] = per_column(c.recording.columns, s.informative);
  top["skill_scale"] = {{"floor", s.mean_floor},
                        {"floor_sd", s.mean_floor_sd},
                        {"null", s.mean_null},
                        {"null_of", null_name(s.null_of) ? Json(null_name(s.null_of)) : Json()},
                        {"used", per_column(c.recording.columns, s.used)}};
  top["random_walk"] = {{"skill", s.walker.value}, {"skill_se", s.walker.se}, {"suffices", c.ranking.walk_suffices}};
  top["memory"] = {{"p", s.memory_p}, {"surrogates", s.surrogates}};
  top["interaction"] = {{"p", {{"d", s.interaction_p[0]}, {"eta", s.interaction_p[1]}}}, {"surrogates", s.surrogates}};
  top["leave_one_out"] = leave_one_out(c);
  Json units = Json::object();
  for (const PanelItem& item : c.recording.panel.items)
    units[item.key] = {{"name", item.name}, {"unit", panel_unit(item, c.recording.data.unit)}};
  top["observables"] = {{"items", std::move(units)},
                        {"recording", observables(c.recording.panel, c.recording.panel.recording)},
                        {"vacf_lags", c.recording.panel.lags},
                        {"vacf", curve(c.recording.panel.recording_vacf)}};
  const ForceFacts& f = c.recording.forces;
  top["forces"] = {{"needed", f.needed}, {"attraction_p", f.attraction_p}, {"alignment_p", f.alignment_p}};
}

void add_skill(Json& model, const ModelFit& r, const Comparison& c) {
  model["skill_ci"] = {r.likeness.skill.value - 1.96 * r.likeness.skill.se, r.likeness.skill.value + 1.96 * r.likeness.skill.se};
  model["contradicted_by"] = refuted_by(r, c.recording.data.unit);
  model["observables"] = observables(c.recording.panel, r.likeness.panel);
  model["vacf"] = curve(r.likeness.vacf);
}

}  // namespace swarmfit
