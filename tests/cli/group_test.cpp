// SPDX-License-Identifier: MIT
// measure and sweep as their user meets them.
#include <map>
#include <nlohmann/json.hpp>

#include "libeval/group/group_state.h"
#include "libeval/group/order_table.h"
#include "tests/cli/program.h"

namespace swarmfit::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// Every file but those of timing, by name.
std::map<std::string, std::string> files_in(const fs::path& dir) {
  std::map<std::string, std::string> out;
  for (const auto& file : fs::recursive_directory_iterator(dir))
    if (file.is_regular_file()) out[fs::relative(file.path(), dir).string()] = content(file.path());
  return out;
}

std::size_t widest_line(const std::string& text) {
  std::size_t widest = 0, width = 0;
  for (const char c : text) {
    if (c == '\n') widest = std::max(widest, width), width = 0;
    if (c != '\n' && (static_cast<unsigned char>(c) & 0xC0) != 0x80) ++width;
  }
  return widest;
}

TEST_F(Program, MeasuresARecording) {
  const Result r = run("measure demo --frames 0:80 --out m");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_THAT(r.out, AllOf(HasSubstr("polarisation"), HasSubstr("95 % interval")));
  EXPECT_LE(widest_line(r.out), 80U);
  const auto files = files_in(dir_ / "m");
  for (const char* name : {"measure.json", "config.toml", "report.html", "tables/series.csv", "tables/means.csv", "tables/states.csv",
                           "tables/events.csv", "tables/g_r.csv", "tables/vacf.csv", "figures/series.svg", "figures/curves.svg"})
    EXPECT_TRUE(files.contains(name)) << name;
  EXPECT_THAT(files.at("tables/series.csv"), StartsWith("frame,time,individuals,polarisation,"));
  EXPECT_EQ(std::count(files.at("tables/series.csv").begin(), files.at("tables/series.csv").end(), '\n'), 82);
  const auto json = nlohmann::json::parse(run("measure demo --frames 0:80 --out m --json").out);
  EXPECT_EQ(json["schema"], "swarmfit-measure/1");
  EXPECT_GT(json["groups"][0]["means"]["extent"]["mean"], 0);
  EXPECT_EQ(run("measure --config m/config.toml --out again").code, 0);
  EXPECT_EQ(files_in(dir_ / "again"), files_in(dir_ / "m"));
}

TEST_F(Program, MeasuresEveryKindByItself) {
  std::string rows = "frame,particle,x,y,kind\n";
  for (int k = 0; k < 12; ++k)
    for (int i = 0; i < 4; ++i)
      rows += std::to_string(k) + ',' + std::to_string(i) + ',' + std::to_string(i + 0.1 * k * (i == 3 ? -1 : 1)) + ',' +
              std::to_string(i * i) + (i == 3 ? ",1\n" : ",0\n");
  write("herd.csv", rows);
  const Result r = run("measure herd.csv --fps 10 --unit m --quantities polarisation,extent --out m --json");
  ASSERT_EQ(r.code, 0) << r.err;
  const auto groups = nlohmann::json::parse(r.out)["groups"];
  ASSERT_EQ(groups.size(), 3U);
  EXPECT_NEAR(groups[0]["means"]["polarisation"]["mean"].get<double>(), 0.5, 1e-9);
  bool sheep = false;
  for (const auto& g : groups) {
    if (g["name"] != "kind 0") continue;
    sheep = true;
    EXPECT_NEAR(g["means"]["polarisation"]["mean"].get<double>(), 1, 1e-9);
  }
  EXPECT_TRUE(sheep);
}

TEST_F(Program, RefusesWhatCannotBeMeasuredOrSwept) {
  expect_refused("measure demo --quantities order", "'order' is not an order parameter");
  expect_refused("measure demo --link 0", "--link");
  expect_refused("measure demo --states fish", "group or flock");
  expect_refused("sweep vicsek", "--axis");
  expect_refused("sweep vicsek --axis eta", "expected name=lo:hi:n");
  expect_refused("sweep vicsek --axis eta=2:1:3", "does not ascend");
  expect_refused("sweep vicsek --axis eta=0:1:3:log", "no logarithms");
  expect_refused("sweep vicsek --axis eta=0:1:2.5", "whole number");
  expect_refused("sweep vicsek --axis heat=0:1:3", "no such parameter");
  expect_refused("sweep vicsek --axis eta=0:1:2 --axis eta=0:2:2", "given twice");
  expect_refused("sweep vicsek --axis agents=1.5,2", "--agents");
  expect_refused("sweep vicsek --axis agents=5,9 --hysteresis", "is not a parameter of vicsek");
  expect_refused("sweep vicsek --axis eta=0:1:2 --latin 5 --hysteresis", "Latin hypercube");
  expect_refused("sweep birds --axis eta=0:1:2", "birds");
  EXPECT_FALSE(fs::exists(dir_ / "swarmfit-sweep"));
}

constexpr const char* kSmall = "--dims 2 --fps 1 --box 0 --start-radius 1 --agents 12 --frames 8 --warm-up 4 --seeds 2 -q ";

TEST_F(Program, SweepsAGridWithTheSameBitsForAnyThreadsAndParts) {
  const std::string sweep = std::string("sweep vicsek --axis eta=0:6:3 --axis radius=0.5,2 ") + kSmall;
  const Result one = run(sweep + "--threads 1 --out one");
  ASSERT_EQ(one.code, 0) << one.err;
  EXPECT_THAT(one.out, AllOf(HasSubstr("6 cells, 12 runs"), HasSubstr("polarisation")));
  EXPECT_LE(widest_line(one.out), 80U);
  const auto files = files_in(dir_ / "one");
  for (const char* name : {"sweep.json", "config.toml", "report.html", "tables/cells.csv", "tables/runs.csv",
                           "figures/map_polarisation.svg", "figures/map_states.svg", "figures/curve_polarisation.svg"})
    EXPECT_TRUE(files.contains(name)) << name;
  EXPECT_THAT(files.at("tables/cells.csv"), StartsWith("eta,radius,runs,diverged,polarisation,polarisation_sd,"));
  ASSERT_EQ(run(sweep + "--threads 3 --out three").code, 0);
  EXPECT_EQ(files_in(dir_ / "three"), files);
  ASSERT_EQ(run(sweep + "--part 1/2 --out a").code, 0);
  ASSERT_EQ(run(sweep + "--part 2/2 --out b").code, 0);
  const Result whole = run("merge a b --out merged -q");
  ASSERT_EQ(whole.code, 0) << whole.err;
  EXPECT_EQ(files_in(dir_ / "merged"), files);
}

// A scenario keeps its dimensions and frames per second.
TEST_F(Program, SweepsAScenario) {
  const Result r = run("sweep mill --axis c=0.5,1 --frames 5 --warm-up 5 --seeds 1 --quantities speed -q --json --out mills");
  ASSERT_EQ(r.code, 0) << r.err;
  for (const auto& cell : nlohmann::json::parse(r.out)["cells"]) EXPECT_NEAR(cell["quantities"]["speed"]["mean"].get<double>(), 0.5, 1e-9);
}

// Order falls with noise: without any 1, with all of it that of random headings.
TEST_F(Program, SweptNoiseTakesOrderAway) {
  const Result r =
      run("sweep vicsek --axis eta=0,6.283185 --dims 2 --fps 1 --box 0 --start-radius 0.3 --agents 40 --frames 30 --warm-up 10 "
          "--seeds 3 -q --json");
  ASSERT_EQ(r.code, 0) << r.err;
  const auto cells = nlohmann::json::parse(r.out)["cells"];
  ASSERT_EQ(cells.size(), 2U);
  EXPECT_NEAR(cells[0]["quantities"]["polarisation"]["mean"].get<double>(), 1, 1e-6);
  EXPECT_LT(cells[1]["quantities"]["polarisation"]["mean"].get<double>(), 0.3);
}

TEST_F(Program, SweepsOptionsUpAndDownAndHypercubes) {
  const Result words =
      run(std::string("sweep bswarm --axis noise=none,white --axis gamma=1:2:2 --dims 3 --agents 6 --frames 4 --seeds 1 -q --out words"));
  ASSERT_EQ(words.code, 0) << words.err;
  EXPECT_THAT(content(dir_ / "words/tables/cells.csv"), AllOf(HasSubstr("\nnone,1,"), HasSubstr("\nwhite,2,")));
  const Result loop = run(std::string("sweep vicsek --hysteresis --axis eta=0:6:3 ") + kSmall + "--json --out loop");
  ASSERT_EQ(loop.code, 0) << loop.err;
  const auto cells = nlohmann::json::parse(loop.out)["cells"];
  ASSERT_EQ(cells.size(), 6U);
  EXPECT_EQ(cells[5]["way"], "down");
  EXPECT_EQ(cells[5]["place"]["eta"], 6);
  const Result cube =
      run(std::string("sweep vicsek --latin 5 --axis eta=0:6:2 --axis radius=0.5:2:2:log --axis agents=4:9:2 ") + kSmall + "--out cube");
  ASSERT_EQ(cube.code, 0) << cube.err;
  EXPECT_EQ(files_in(dir_ / "cube").count("figures/cloud_polarisation_eta_radius.svg"), 1U);
}

// The manual names every order parameter and every rule as the tables have them.
TEST_F(Program, TheManualOfGroupsIsThatOfTheTables) {
  const std::string page = content(fs::path(SWARMFIT_SOURCE_DIR) / "docs/group.md");
  for (const OrderParameter& p : order_table())
    EXPECT_THAT(page, HasSubstr("| `" + std::string(p.key) + "` | " + std::string(p.name) + " |")) << p.key;
  for (const GroupState& s : state_table()) {
    std::string rule(s.rule);  // as Markdown has it in a table
    for (auto at = rule.find('|'); at != std::string::npos; at = rule.find('|', at + 2)) rule.insert(at, 1, '\\');
    EXPECT_THAT(page, HasSubstr("| " + std::string(s.name) + " | " + rule + " |")) << s.key;
  }
}

}  // namespace
}  // namespace swarmfit::test
