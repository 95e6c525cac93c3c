// SPDX-License-Identifier: MIT
// extend, augment, and curves, as their user runs them.
#include <string>

#include "tests/cli/program.h"

namespace {

using swarmfit::test::Program;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(Program, ExtendSaysOfEveryPointWhereItIsFrom) {
  const auto r = run("extend demo --frames 0:40 --onward 5 --onward 3=9 --bridge 2 -o out.csv --html out.html");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("points are synthetic"));
  const std::string csv = swarmfit::test::content(dir_ / "out.csv");
  EXPECT_THAT(csv, HasSubstr("# synthetic: made by a simulator\n# kinds: recorded; synthetic\n"));
  EXPECT_THAT(csv, HasSubstr("id,frame,t,x,y,z,kind\n"));
  EXPECT_THAT(swarmfit::test::content(dir_ / "out.html"), HasSubstr("\"kinds\":[\"recorded\",\"synthetic\"]"));
  EXPECT_THAT(run("describe out.csv --kind synthetic").out, HasSubstr("rows of other kinds than synthetic were left out"));
  EXPECT_EQ(run("describe out.csv --kind recorded --frames 41:60").code, 2);  // nothing recorded there
  EXPECT_EQ(run("extend demo --frames 0:40 --onward 5 --onward 3=9 --bridge 2 -o - -q").out, csv);
}

TEST_F(Program, AugmentAddsToWhatWasRecorded) {
  const auto r = run("augment demo --frames 0:30 --add 7 --set w_n=0.5 -o out.csv");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_THAT(swarmfit::test::content(dir_ / "out.csv"), HasSubstr("synthetic7,30,"));
  const auto other = run("augment demo --frames 0:30 --add 7 -m langevin -o out.csv -q");
  EXPECT_EQ(other.code, 0) << other.err;
  EXPECT_EQ(other.err, "");
}

TEST_F(Program, RefusesWhatCannotBeAdded) {
  expect_refused("extend demo", "extend: nothing to write; expected --out FILE or --html FILE");
  expect_refused("extend demo --onward 0 --bridge 0 -o x.csv", "nothing to add");
  expect_refused("extend demo --onward nobody=3 -o x.csv", "--onward nobody: no individual in demo has that name");
  expect_refused("extend demo --onward many -o x.csv", "--onward: 'many': 'many' is not a number");
  expect_refused("extend demo --onward 1.5 -o x.csv", "expected frames or NAME=frames, a whole number");
  expect_refused("extend demo -m birds -o x.csv", "model 'birds'");
  expect_refused("augment demo --add 0 -o x.csv", "--add");
  expect_refused("augment demo --set speed=1 -o x.csv", "--set speed: fastswarm has no such parameter");
  EXPECT_FALSE(std::filesystem::exists(dir_ / "x.csv"));
}

TEST_F(Program, SimulatesAlongACurve) {
  const auto r = run("simulate fastswarm --curve star --agents 20 --frames 20 -o out.csv");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("mean distance to the curve"));
  write("line.csv", "0,0,0\n100,0,nothing\n");
  expect_refused("simulate fastswarm --curve line.csv -o x.csv", "line.csv:2:7");
  expect_refused("simulate boids --curve star -o x.csv", "--curve: boids cannot be led along a curve");
  expect_refused("simulate recorded_motion --curve star -o x.csv", "--curve: recorded_motion is a scenario; expected a model alone");
  expect_refused("simulate fastswarm --curve star --box 3 -o x.csv", "--curve: agents start on the curve");
}

// Told by the distances that the command prints and `--check` measures, each in its own way.
TEST_F(Program, LedByTheCurveAgentsStayNearIt) {
  for (const std::string curve : {"heart", "star"}) {
    const std::string flight = "simulate fastswarm --curve " + curve + " --agents 60 --frames 60 --warm-up 60 -o out.csv";
    const auto distance = [](const std::string& said) {  // in distances of the key points: 20 mean steps
      const auto at = said.find(" mm, ");
      EXPECT_NE(at, std::string::npos) << said;
      return std::stod(said.substr(at + 5));
    };
    const double led = distance(run(flight).err), loose = distance(run(flight + " --set w_user=0").err);
    EXPECT_LT(led, 0.5);
    EXPECT_LT(led, 0.5 * loose);
    const auto scene = run("simulate " + curve + " --agents 60 --check --json");
    EXPECT_THAT(scene.out, HasSubstr("\"measure\": \"off_curve\""));
    EXPECT_THAT(scene.out, Not(HasSubstr("nan")));
  }
}

TEST_F(Program, SimulatesWhatLearnsFromARecordingAtItsScale) {
  const auto r = run("simulate fastswarm --agents 5 --frames 4 -o out.csv");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_THAT(swarmfit::test::content(dir_ / "out.csv"), HasSubstr("# unit: mm\n# fps: 50\n"));
  ASSERT_EQ(run("simulate fastswarm --agents 5 --frames 4 --like demo -o like.csv").code, 0);
  EXPECT_EQ(swarmfit::test::content(dir_ / "like.csv"), swarmfit::test::content(dir_ / "out.csv"));
  ASSERT_EQ(run("simulate fastswarm --agents 5 --frames 4 --like out.csv -o like.csv").code, 0);
  EXPECT_NE(swarmfit::test::content(dir_ / "like.csv"), swarmfit::test::content(dir_ / "out.csv"));
  expect_refused("simulate fastswarm --fps 100 -o x.csv", "expected 0.02 s, the recording's frame interval");
  expect_refused("simulate fastswarm --dims 2 -o x.csv", "--dims");
  expect_refused("simulate boids --like demo -o x.csv",
                 "--like: boids learns from no recording; expected a model that does: fastswarm or learned");
  expect_refused("simulate fastswarm --like nothing.csv -o x.csv", "nothing.csv");
  EXPECT_FALSE(std::filesystem::exists(dir_ / "x.csv"));
}

}  // namespace
