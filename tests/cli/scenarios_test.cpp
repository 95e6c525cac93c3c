// SPDX-License-Identifier: MIT
// Scenarios as a user meets them.
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace swarmfit::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

class Scenarios : public Program {};

TEST_F(Scenarios, AFileThatIsWrittenOutPlaysTheSame) {
  const Result listed = run("scenarios --json");
  ASSERT_EQ(listed.code, 0);
  std::vector<std::string> names;
  for (const auto& entry : nlohmann::json::parse(listed.out).at("scenarios")) names.push_back(entry.at("name"));
  EXPECT_THAT(names, Contains("escape"));
  EXPECT_THAT(run("scenarios").out, HasSubstr("A predator crosses a swarm"));
  ASSERT_EQ(run("scenarios escape >mine.toml").code, 0);
  EXPECT_EQ(content(dir_ / "mine.toml"), content(fs::path(SWARMFIT_SOURCE_DIR) / "scenarios/escape.toml"));
  const std::string few = " --agents 6 --frames 9 --warm-up 0 -o -";
  const Result by_name = run("simulate escape" + few), by_file = run("simulate mine.toml" + few);
  ASSERT_EQ(by_name.code, 0) << by_name.err;
  EXPECT_EQ(by_name.out, by_file.out);
  EXPECT_EQ(std::count(by_name.out.begin(), by_name.out.end(), '\n'), 1 + 6 * 9);
  EXPECT_NE(by_name.out, run("simulate escape --seed 2" + few).out);
  EXPECT_NE(by_name.out, run("simulate escape --set gamma=1" + few).out);
  EXPECT_NE(by_name.out, run("simulate escape --start-radius 1" + few).out);
}

TEST_F(Scenarios, WhatIsExpectedIsChecked) {
  write("mine.toml",
        "title = \"t\"\nmodel = \"boids\"\nagents = 9\nframes = 5\n[expect.there]\nmeasure = \"count\"\nabove = 9\nbelow = 9\npublished = "
        "\"nine\"\n");
  const Result good = run("simulate mine.toml --check");
  EXPECT_EQ(good.code, 0) << good.err;
  EXPECT_THAT(good.out, HasSubstr("count 9, expected 9 to 9: met"));
  EXPECT_THAT(good.out, HasSubstr("nine"));
  const Result bad = run("simulate mine.toml --check --json --agents 8");
  EXPECT_EQ(bad.code, 1);
  const auto document = nlohmann::json::parse(bad.out).at("expectations").at(0);
  EXPECT_EQ(document.at("value"), "8");
  EXPECT_EQ(document.at("met"), "no");
}

TEST_F(Scenarios, FaultsAreRefusedWithTheirPlace) {
  write("mine.toml", "title = \"t\"\nmodel = \"boids\"\n[bounds]\nshape = \"cube\"\n");
  expect_refused("simulate mine.toml -o x.csv", "mine.toml:4:9: [bounds] shape = 'cube' is not allowed; expected one of open, box, sphere");
  write("mine.toml", "title = \"t\"\nmodel = \"boids\"\n[expect.joy]\nmeasure = \"joy\"\nabove = 1\n");
  expect_refused("simulate mine.toml -o x.csv", "mine.toml:4:11: measure 'joy': unknown; expected one of polarisation, rotation");
  EXPECT_FALSE(fs::exists(dir_ / "x.csv"));
  expect_refused("simulate none.toml -o x.csv", "none.toml");
  expect_refused("simulate escap -o x.csv", "a scenario: aggregation_3000, ");
  expect_refused("scenarios escap", "scenario 'escap': unknown; expected one of aggregation_3000, ");
  expect_refused("simulate phototaxis --agents 4 -o x.csv", "--agents: phototaxis has 2 groups; expected a scenario with one");
  expect_refused("simulate escape --dims 2 -o x.csv", "--dims: escape is a scene in 3 dimensions; expected 3");
  expect_refused("simulate escape --set gama=2 -o x.csv", "--set gama: bswarm has no such parameter; expected one of gamma");
  expect_refused("simulate boids --check", "--check: boids expects nothing");
  expect_refused("simulate boids", "nothing to write");
}

}  // namespace
}  // namespace swarmfit::test
