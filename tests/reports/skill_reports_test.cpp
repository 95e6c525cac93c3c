// SPDX-License-Identifier: MIT
// What stands beside the score, in every kind of report.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "reports/html.h"
#include "reports/json.h"
#include "reports/skill_tables.h"
#include "reports/terminal.h"
#include "reports/words.h"
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
  EXPECT_THAT(skill[8], testing::EndsWith(",0.03,,0.28,,0.812,0.02"));
  EXPECT_EQ(lines(c, "leave_one_out.csv").size(), 1u + 5 * 4);
  EXPECT_EQ(lines(c, "leave_one_out.csv")[1], "bswarm,1,bswarm[noise=perlin],0.781,false");
  EXPECT_EQ(lines(c, "panel.csv").size(), 1u + 6 * c.panel.items.size());
  EXPECT_EQ(lines(c, "panel.csv")[1], "recording,sd_x,mm,1.5,0.1");
  EXPECT_EQ(lines(c, "vacf.csv").size(), 1u + 4);
  for (const auto& line : skill) EXPECT_EQ(std::count(line.begin(), line.end(), ','), 10) << line;
  for (const auto& line : lines(c, "vacf.csv")) EXPECT_EQ(std::count(line.begin(), line.end(), ','), 12) << line;
}

TEST(SkillJson, EveryNumberOfTheResult) {
  Comparison c = sample_comparison();
  c.models[1].skill = {};
  const auto j = json::parse(to_json(c));
  EXPECT_EQ(j["floor"]["d"], 0.04);
  EXPECT_EQ(j["null"]["omega"], 0.73);
  EXPECT_EQ(j["informative"]["eta"], false);
  EXPECT_EQ(j["skill_scale"]["null"], 0.28);
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
  EXPECT_EQ(j["models"][0]["observables"]["kurtosis"]["value"], 1.04 * c.panel.recording.back().value);
  EXPECT_EQ(j["models"][0]["wasserstein"]["v"], c.models[0].wasserstein[kSpeed]);
  EXPECT_EQ(j["models"][0]["vacf"]["value"].size(), 4u);
}

TEST(SkillTerminal, SkillBesideTheScoreAndASmallPanel) {
  const auto text = ranking_text(sample_comparison(), {});
  EXPECT_THAT(text, HasSubstr("skill"));
  EXPECT_THAT(text, HasSubstr("0.81"));
  EXPECT_THAT(text, HasSubstr("not fitted"));
  EXPECT_THAT(text, HasSubstr("d/Poisson"));
  auto none = sample_comparison();
  for (auto& m : none.models) m.skill = {};
  EXPECT_THAT(ranking_text(none, {}), testing::Not(HasSubstr("no better than its surrogates")));
}

TEST(SkillHtml, ThreeSectionsWithTheirNumbers) {
  const auto page = report_html(sample_comparison());
  for (const char* id : {"skill", "panel"}) EXPECT_THAT(page, HasSubstr("<section id=\"" + std::string(id) + '"'));
  EXPECT_THAT(page, HasSubstr("0.81 ± 0.02"));
  EXPECT_THAT(page, HasSubstr("have p = 0.01, the velocity differences p = 0.48"));
  EXPECT_THAT(page, HasSubstr("<td>changed</td>"));
  EXPECT_THAT(page, HasSubstr("zero of the velocity autocorrelation"));
  EXPECT_THAT(page, HasSubstr("What was not fitted"));
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
