// SPDX-License-Identifier: MIT
// What stands beside the score, in every kind of report.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "reports/comparison/html.h"
#include "reports/comparison/json.h"
#include "reports/comparison/ranking_text.h"
#include "reports/comparison/skill_tables.h"
#include "reports/comparison/words.h"
#include "reports/write/unit_text.h"
#include "tests/reports/sample.h"

namespace swarmfit {
namespace {

using nlohmann::json;
using testing::HasSubstr;

std::vector<std::string> lines(const Comparison& c, const std::string& name) {
  for (const NamedTable& t : result_tables(c)) {
    if (t.name != name) continue;
    std::vector<std::string> out;
    std::istringstream in(t.csv);
    for (std::string line; std::getline(in, line);) out.push_back(line);
    return out;
  }
  return {};
}

TEST(SkillTables, OneRowEach) {
  const Comparison c = sample_comparison();
  const auto skill = lines(c, "skill.csv");
  ASSERT_EQ(skill.size(), 1u + 5 * 8);
  EXPECT_THAT(skill[1], testing::StartsWith("bswarm,v,true,"));
  EXPECT_THAT(skill[8], testing::StartsWith("bswarm,all,,"));
  EXPECT_THAT(skill[8], testing::EndsWith(",0.03,0.003,0.28,,,0.812,0.02"));
  EXPECT_THAT(skill[1], testing::EndsWith(",0.021,0.004,0.02,0.9,false,,"));
  EXPECT_EQ(lines(c, "leave_one_out.csv").size(), 1u + 5 * 4);
  EXPECT_EQ(lines(c, "leave_one_out.csv")[1], "bswarm,1,bswarm[noise=perlin],0.781,false");
  EXPECT_EQ(lines(c, "panel.csv").size(), 1u + 6 * c.recording.panel.items.size());
  EXPECT_EQ(lines(c, "panel.csv")[1], "recording,sd_x,mm,1.5,0.1");
  EXPECT_EQ(lines(c, "vacf.csv").size(), 1u + 4);
  for (const auto& line : skill) EXPECT_EQ(std::count(line.begin(), line.end(), ','), 11) << line;
  for (const auto& line : lines(c, "vacf.csv")) EXPECT_EQ(std::count(line.begin(), line.end(), ','), 12) << line;
}

TEST(SkillJson, EveryNumberOfTheResult) {
  Comparison c = sample_comparison();
  c.models[1].likeness.skill = {};
  const auto j = json::parse(to_json(c));
  EXPECT_EQ(j["floor"]["d"], 0.04);
  EXPECT_EQ(j["null"]["omega"], 0.73);
  EXPECT_EQ(j["informative"]["eta"], false);
  EXPECT_EQ(j["skill_scale"]["null"], 0.28);
  EXPECT_EQ(j["skill_scale"]["null_of"], "steps");
  EXPECT_EQ(j["skill_scale"]["floor_sd"], 0.003);
  EXPECT_EQ(j["places"]["omega"], 0.92);
  EXPECT_EQ(j["random_walk"]["skill"], 0);
  EXPECT_EQ(j["random_walk"]["skill_se"], 0.004);
  EXPECT_EQ(j["random_walk"]["suffices"], false);
  EXPECT_EQ(j["memory"]["p"], 0.01);
  EXPECT_EQ(j["memory"]["surrogates"], 99);
  EXPECT_EQ(j["interaction"]["p"]["eta"], 0.48);
  EXPECT_EQ(j["leave_one_out"][1]["reordered"], true);
  EXPECT_EQ(j["leave_one_out"][1]["without"], "bswarm[noise=perlin]");
  EXPECT_EQ(j["leave_one_out"][1]["ranking"].size(), 4u);
  EXPECT_EQ(j["observables"]["items"]["k_x"]["unit"], "1/s²");
  EXPECT_EQ(j["observables"]["recording"]["sd_x"]["value"], 1.5);
  EXPECT_EQ(j["observables"]["vacf_lags"].size(), 4u);
  EXPECT_NEAR(j["models"][0]["skill"].get<double>(), 0.812, 1e-12);
  EXPECT_NEAR(j["models"][0]["skill_ci"][0].get<double>(), 0.812 - 1.96 * 0.02, 1e-12);
  EXPECT_TRUE(j["models"][1]["skill"].is_null());
  EXPECT_EQ(j["models"][0]["observables"]["kurtosis"]["value"], 1.04 * c.recording.panel.recording.back().value);
  EXPECT_EQ(j["models"][0]["wasserstein"]["v"], c.models[0].likeness.wasserstein[kSpeed]);
  EXPECT_EQ(j["models"][0]["vacf"]["value"].size(), 4u);
}

TEST(SkillJson, WhatRefutesAModelAndWhichNullTheScaleHas) {
  Comparison c = sample_comparison();
  c.models[1].likeness.refuted_by = {{c.recording.panel.items[4], {NAN, NAN}, 0.4, 0.01}, {c.recording.panel.items[3], {213, 4}, 99, 2}};
  c.models[0].parameters[0].interaction = true;
  c.recording.skill.null_of = SkillNull::places;
  auto j = json::parse(to_json(c));
  EXPECT_EQ(j["models"][0]["contradicted_by"].size(), 0u);
  const auto& facts = j["models"][1]["contradicted_by"];
  EXPECT_EQ(facts[0]["key"], "vacf_zero");
  EXPECT_EQ(facts[0]["unit"], "s");
  EXPECT_TRUE(facts[0]["recording"]["value"].is_null());
  EXPECT_EQ(facts[0]["model"]["value"], 0.4);
  EXPECT_EQ(facts[1]["name"], "mean speed");
  EXPECT_EQ(facts[1]["unit"], "mm/s");
  EXPECT_EQ(facts[1]["recording"]["se"], 4);
  EXPECT_EQ(facts[1]["model"]["sd"], 2);
  EXPECT_EQ(j["models"][0]["parameters"]["gamma"]["interaction"], true);
  EXPECT_EQ(j["models"][0]["parameters"]["chi_att"]["interaction"], false);
  EXPECT_EQ(j["skill_scale"]["null_of"], "places");
  c.recording.skill.null_of = SkillNull::none;
  EXPECT_TRUE(json::parse(to_json(c))["skill_scale"]["null_of"].is_null());
}

// The random walk has a line of its own, and the legend says what 0 is.
TEST(SkillReports, TheRandomWalkStandsBesideTheModels) {
  Comparison c = sample_comparison();
  const auto legend = [&] { return ranking_text(c, {}, Detail::all); };
  EXPECT_THAT(legend(), HasSubstr("\n       random walk                                            0.00\n"));
  EXPECT_THAT(legend(), HasSubstr("0 = no better than a random\n walk of its own steps (for d and η: its tracks shifted in time)."));
  EXPECT_THAT(report_html(c), testing::AllOf(HasSubstr("<td class=\"n\">0.00</td>"), testing::Not(HasSubstr("0.00 ±"))))
      << "0 by definition";
  c.recording.skill.null_of = SkillNull::places;
  c.recording.skill.walker = {0.98, 0.01};
  EXPECT_THAT(legend(), HasSubstr("random walk                                            0.98\n"));
  EXPECT_THAT(legend(), HasSubstr("0 = no better than its own\n positions in random order."));
  const auto page = report_html(c);
  EXPECT_THAT(page, HasSubstr("0.98 ± 0.01"));
  EXPECT_THAT(page, HasSubstr("its positions in random order (null)"));
  const auto skill = lines(c, "skill.csv");
  EXPECT_THAT(skill[8], testing::EndsWith(",0.03,0.003,,0.28,,0.812,0.02"));
  c.recording.skill.walker = {};
  c.recording.skill.null_of = SkillNull::steps;  // on d and eta alone
  EXPECT_THAT(legend(), testing::Not(HasSubstr("random walk")));
  EXPECT_THAT(legend(), HasSubstr("0 = no better than its\n tracks shifted in time."));
}

TEST(SkillTerminal, SkillBesideTheScoreAndASmallPanel) {
  const auto text = ranking_text(sample_comparison(), {}, Detail::all);
  EXPECT_THAT(text, HasSubstr("skill"));
  EXPECT_THAT(text, HasSubstr("0.81"));
  EXPECT_THAT(text, HasSubstr("not fitted"));
  EXPECT_THAT(text, HasSubstr("d/Poisson"));
  auto none = sample_comparison();
  for (auto& m : none.models) m.likeness.skill = {};
  EXPECT_THAT(ranking_text(none, {}), testing::Not(HasSubstr("skill: ")));
}

TEST(SkillHtml, ThreeSectionsWithTheirNumbers) {
  const auto page = report_html(sample_comparison());
  for (const char* id : {"skill", "panel"}) EXPECT_THAT(page, HasSubstr("<section id=\"" + std::string(id) + '"'));
  EXPECT_THAT(page, HasSubstr("0.81 ± 0.02"));
  EXPECT_THAT(page, HasSubstr("nearest-neighbour distance p = 0.01, velocity difference p = 0.48"));
  EXPECT_THAT(page, HasSubstr("<td>changed</td>"));
  EXPECT_THAT(page, HasSubstr("zero of the velocity autocorrelation"));
  EXPECT_THAT(page, HasSubstr("Observables that were not fitted"));
  EXPECT_THAT(page, HasSubstr("all motion metrics in the score together p = 0.01"));
}

TEST(PanelUnit, PowersOfLengthAndTime) {
  EXPECT_EQ(panel_unit({"", "", 2, 0}, "mm"), "mm²");
  EXPECT_EQ(panel_unit({"", "", 0, 1}, "mm"), "s");
  EXPECT_EQ(panel_unit({"", "", 0, -2}, "mm"), "1/s²");
  EXPECT_EQ(panel_unit({"", "", 1, -2}, "mm"), "mm/s²");
  EXPECT_EQ(panel_unit({"", "", 0, 0}, "mm"), "");
}

}  // namespace
}  // namespace swarmfit
