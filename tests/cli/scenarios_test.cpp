// SPDX-License-Identifier: MIT
// Scenarios as a user meets them.
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace swarmfit::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

class Scenarios : public Program {};

TEST_F(Scenarios, AFileThatIsWrittenOutPlaysTheSame) {
  const Result listed = run("scenarios --json");
  ASSERT_EQ(listed.code, 0);
  std::vector<std::string> names;
  const auto document = nlohmann::json::parse(listed.out);
  for (const auto& entry : document.at("scenarios")) names.push_back(entry.at("name"));
  EXPECT_THAT(names, Contains("escape"));
  EXPECT_THAT(run("scenarios").out, HasSubstr("A predator crosses a swarm"));
  ASSERT_EQ(run("scenarios escape >mine.toml").code, 0);
  EXPECT_EQ(content(dir_ / "mine.toml"), content(fs::path(SWARMFIT_SOURCE_DIR) / "scenarios/escape.toml"));
  const std::string few = " --agents 6 --frames 9 --warm-up 0 -o -";
  const Result by_name = run("simulate escape" + few), by_file = run("simulate mine.toml" + few);
  ASSERT_EQ(by_name.code, 0) << by_name.err;
  EXPECT_EQ(by_name.out, by_file.out);
  EXPECT_THAT(by_name.out, AllOf(HasSubstr("\n5,8,"), Not(HasSubstr("\n6,")), Not(HasSubstr(",9,")))) << "6 agents, 9 frames";
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

// Every key of a file is one of the schema's, and what it needs is there.
void expect_valid(const nlohmann::json& schema, const nlohmann::json& value, const std::string& where) {
  if (schema.contains("enum")) {
    EXPECT_THAT(schema["enum"], Contains(value)) << where;
    return;
  }
  if (schema.at("type") == "array" && schema.contains("items"))
    for (const auto& item : value) expect_valid(schema["items"], item, where);
  if (schema.at("type") != "object") return;
  for (const auto& [key, inner] : value.items()) {
    const auto& properties = schema.contains("properties") ? schema["properties"] : nlohmann::json::object();
    if (properties.contains(key)) {
      expect_valid(properties[key], inner, where + "." + key);
      continue;
    }
    ASSERT_TRUE(schema["additionalProperties"].is_object()) << where << ": " << key;
    if (schema["additionalProperties"].contains("type")) expect_valid(schema["additionalProperties"], inner, where + "." + key);
  }
  if (!schema.contains("required")) return;
  for (const auto& name : schema["required"]) {
    EXPECT_TRUE(value.contains(name)) << where << ": " << name;
  }
}

TEST_F(Scenarios, TheSchemaIsOfWhatTheReaderReads) {
  const Result printed = run("scenarios --schema");
  ASSERT_EQ(printed.code, 0) << printed.err;
  const auto schema = nlohmann::json::parse(printed.out);
  EXPECT_EQ(schema.at("required"), nlohmann::json({"title", "model"}));
  EXPECT_EQ(schema["properties"]["obstacle"]["items"]["properties"]["shape"]["enum"],
            nlohmann::json({"sphere", "box", "cylinder", "plane", "mesh"}));
  EXPECT_EQ(schema["properties"]["stimulus"]["items"]["properties"]["ring"]["properties"]["ahead"]["minimum"], -180);
  EXPECT_FALSE(schema["properties"]["group"]["items"]["properties"]["start"]["properties"].empty());
  expect_valid(schema, nlohmann::json::parse(R"({"title": "t", "model": "m", "bounds": {"shape": "box", "lower": [0, 0], "upper": [1, 1]},
    "expect": {"a": {"measure": "met", "radius": 1, "above": 0}}, "parameters": {"gain": 1}, "schedule": {"gain": [[0, 1]]}})"),
               "");
}

TEST_F(Scenarios, WallsFromAFileHoldForAModelAlone) {
  write("tank.toml",
        "[bounds]\nshape = \"box\"\nlower = [0, 0, 0]\nupper = [1, 1, 1]\n[[obstacle]]\nshape = \"mesh\"\nfile = \"stone.obj\"\n");
  write("stone.obj", "v 0.4 0.4 0.4\nv 0.6 0.4 0.4\nv 0.4 0.6 0.4\nv 0.4 0.4 0.6\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  const Result r = run("simulate brownian --world tank.toml --agents 20 --frames 40 -o -");
  ASSERT_EQ(r.code, 0) << r.err;
  std::istringstream lines(r.out);
  int rows = 0;
  for (std::string line; std::getline(lines, line);) {
    double x = 0, y = 0, z = 0;
    if (std::sscanf(line.c_str(), "%*d,%*d,%*f,%lf,%lf,%lf", &x, &y, &z) != 3) continue;
    ++rows;
    EXPECT_TRUE(x >= 0 && x <= 1 && y >= 0 && y <= 1 && z >= 0 && z <= 1) << line;
    EXPECT_FALSE(x > 0.4 && y > 0.4 && z > 0.4 && x + y + z < 1.4 - 1e-9) << line;
  }
  EXPECT_EQ(rows, 800);
  expect_refused("simulate two_blocks --world tank.toml -o a.csv", "expected a scenario without goals");
  expect_refused("simulate brownian --world no.toml -o a.csv", "no.toml");
  write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write("bad.toml", "[[obstacle]]\nshape = \"mesh\"\nfile = \"open.obj\"\n");
  expect_refused("simulate brownian --world bad.toml -o a.csv", "open.obj: the surface is open at the edge from");
}

TEST_F(Scenarios, ASeriesForParaViewHoldsBodiesAndMarks) {
  const Result r = run("simulate two_blocks --agents 5 --frames 3 --out run.pvd");
  ASSERT_EQ(r.code, 0) << r.err;
  for (const char* name : {"run.pvd", "run/frame000000.vtp", "run/frame000002.vtp", "run/bodies.vtp", "run/marks000001.vtp"})
    EXPECT_TRUE(fs::exists(dir_ / name)) << name;
  EXPECT_THAT(content(dir_ / "run/bodies.vtp"), HasSubstr("NumberOfPoints=\"16\"")) << "two blocks with eight corners";
  ASSERT_EQ(run("convert demo --frames 0:2 --to vtk -o demo.pvd").code, 0);
  EXPECT_TRUE(fs::exists(dir_ / "demo/frame000002.vtp"));
  expect_refused("convert demo --to vtk -o -", "expected a name that ends on .pvd");
}

}  // namespace
}  // namespace swarmfit::test
