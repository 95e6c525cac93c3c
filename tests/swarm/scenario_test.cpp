// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "libswarm/scenario/read.h"
#include "libtrack/error.h"
#include "tests/swarm/lane.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* kTop = "title = \"t\"\nmodel = \"boids\"\n";

Scenario read(const std::string& text) { return read_scenario("dir/scene.toml", text); }

std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "nothing was refused";
}

TEST(ScenarioFile, SaysAllOfIt) {
  const Scenario s = read(R"(
title = "All of it"
source = "a paper"
model = "bswarm[noise=white]"
shows = "bswarm"
frames = 50
warm_up = 20
fps = 25
seed = 7
unit = "mm"
steps = 3
[parameters]
gamma = 2
chi_res = 4.5
[bounds]
shape = "sphere"
centre = [1, 2, 3]
radius = 9
wall = "slip"
[[obstacle]]
shape = "box"
lower = [0, 0, 0]
upper = [1, 1, 1]
[[stimulus]]
kind = "attract"
path = [[0, 1, 1, 1], [10, 2, 2, 2]]
from = 1
until = 5
[[stimulus]]
kind = "repel"
ring = {radius = 4, ahead = 90}
[schedule]
gamma = [[0, 2], [1, 3]]
[[group]]
agents = 10
start = {shape = "line", lower = [0, 0, 0], upper = [1, 0, 0], speed = 2, heading = [0, 3, 0]}
[[group]]
agents = 5
arrive = 1
every = 0.5
leave = 9
[expect.order]
measure = "polarisation"
from = 3
above = 0.8
published = "0.98"
)");
  EXPECT_EQ(s.name, "scene");
  EXPECT_EQ(s.model.name, "bswarm[noise=white]");
  EXPECT_EQ(s.frames, 50);
  EXPECT_DOUBLE_EQ(s.dt, 0.04);
  EXPECT_EQ(s.steps_per_frame(), 3);
  EXPECT_EQ(s.parameters[static_cast<std::size_t>(s.model.spec->find("chi_res"))], 4.5);
  EXPECT_EQ(s.bounds.kind, Bounds::Kind::sphere);
  EXPECT_EQ(s.bounds.wall, Bounds::Wall::slip);
  EXPECT_EQ(s.obstacles.front().shape, Obstacle::Shape::box);
  EXPECT_EQ(s.stimuli[0].path[1].place[2], 2);
  EXPECT_NEAR(s.stimuli[1].ahead, std::numbers::pi / 2, 1e-15);
  EXPECT_EQ(s.schedules.front().at(0.5), 2.5);
  EXPECT_EQ(s.agents(), 15);
  EXPECT_EQ(s.groups[1].every, 0.5);
  EXPECT_EQ(s.expectations.front().arguments.front().second, std::vector<double>{3});
  EXPECT_EQ(s.expectations.front().above, 0.8);
}

// Line and column of the fault, and what may stand there.
TEST(ScenarioFile, FaultsAreNamedWithTheirPlace) {
  const std::pair<std::string, const char*> faults[] = {
      {"", "dir/scene.toml:1:1: no model; expected model = ..."},
      {"title = \"t\nmodel = 3", "dir/scene.toml:1:"},
      {"title = \"t\"\nmodel = \"birds\"", "dir/scene.toml:2:9: model 'birds': unknown; expected one of bswarm, boids"},
      {"title = 3\nmodel = \"boids\"", "dir/scene.toml:1:9: title is not text; expected text in quotes"},
      {std::string(kTop) + "frams = 3", "dir/scene.toml:3:9: 'frams' is not known; expected one of model, title"},
      {std::string(kTop) + "frames = 0", ":3:10: frames = 0 is not allowed; expected a whole number from 1 to 10000000"},
      {std::string(kTop) + "fps = nan", ":3:7: fps  is not allowed; expected a number from 1e-06 to 1e+09"},
      {std::string(kTop) + "dims = 4", ":3:8: dims = 4 is not allowed; expected a whole number from 2 to 3"},
      {std::string(kTop) + "[parameters]\ntau = -1", ":4:7: [parameters] tau=-1: is not allowed; expected a number greater than 0"},
      {std::string(kTop) + "[parameters]\nradios = 1", ":4:10: [parameters] radios: boids has no such parameter; expected one of "},
      {std::string(kTop) + "[bounds]\nshape = \"cube\"",
       ":4:9: [bounds] shape = 'cube' is not allowed; expected one of open, box, sphere, "},
      {std::string(kTop) + "[bounds]\nshape = \"box\"\nlower = [0, 0]", ":5:9: [bounds] lower is not allowed; expected [x, y, z]"},
      {std::string(kTop) + "[bounds]\nshape = \"box\"\nlower = [0, 0, 0]\nupper = [1, 0, 1]", "upper is 0 on axis y, where lower is 0"},
      {std::string(kTop) + "[[obstacle]]\nradius = 3", ":3:1: [[obstacle]] has no shape; expected shape = ..."},
      {std::string(kTop) + "[[stimulus]]\nkind = \"repel\"", "[[stimulus]] is nowhere; expected one of at, path, lead, ring, wander"},
      {std::string(kTop) + "[[stimulus]]\nkind = \"repel\"\npath = [[1, 0, 0, 0], [1, 1, 1, 1]]", "goes from 1 to 1 s; expected times in"},
      {std::string(kTop) + "agents = 3\n[[group]]\nagents = 4", ":3:10: agents is given together with [[group]]"},
      {std::string(kTop) + "[[group]]\nagents = 4\nkind = \"dog\"",
       ":5:8: [[group]] kind is given, but boids has one kind of agents; expected no kind"},
      {std::string(kTop) + "[expect.x]\nmeasure = \"y\"", "[expect.x] bounds nothing; expected above, below or both"},
      {"title = \"t\"\nmodel = \"bswarm\"\n[parameters]\nchi_res = 3", "chi_res=3: would do nothing, as there are no stimuli here"},
  };
  for (const auto& [text, message] : faults) EXPECT_THAT(refusal(text), HasSubstr(message)) << text;
}

TEST(ScenarioFile, NothingElseThanAnInputErrorComesOfHalfAFile) {
  for (const ScenarioFile& file : scenario_files())
    for (std::size_t length = 0; length < file.text.size(); length += 7) {
      try {
        read(std::string(file.text.substr(0, length)));
      } catch (const InputError& e) {
        EXPECT_THAT(e.what(), StartsWith("dir/scene.toml")) << file.text.substr(0, length);
      }
    }
}

TEST(ScenarioFile, EveryOneOfTheProgramIsReadAndHasANameOfItsOwn) {
  std::map<std::string, int> shown;
  ASSERT_GT(scenario_files().size(), 5u);
  for (const ScenarioFile& file : scenario_files()) {
    const Scenario s = read_scenario(std::string(file.name) + ".toml", std::string(file.text));
    EXPECT_EQ(s.name, file.name);
    if (!s.shows.empty()) ++shown[s.shows];
    for (const ModelSpec& spec : models()) EXPECT_NE(spec.name, s.name) << "simulate takes both";
  }
  for (const auto& [model, times] : shown) EXPECT_EQ(times, 1) << model;
}

struct Kept : FrameSink {
  std::vector<std::vector<std::uint32_t>> ids;
  std::vector<std::vector<Array3d>> places;
  void frame(const Snapshot& now) override {
    ids.emplace_back(now.id.begin(), now.id.end());
    places.emplace_back();
    for (Index i = 0; i < now.pos.rows(); ++i) places.back().push_back(now.pos.row(i).transpose());
  }
};

// Agents are still in a model without forces whose noise is off: only the scene moves them.
Scenario still(const std::string& more) {
  return read("title = \"t\"\nmodel = \"bswarm[noise=none,interaction=off,avoidance=none]\"\nfps = 10\nframes = 31\n" + more);
}

TEST(Scenario, WhatLearnsFromARecordingTakesItsFramesAsSteps) {
  Scenario scene = read("title = \"t\"\nmodel = \"fastswarm\"\nfps = 50\nframes = 3\nagents = 4\n");
  Kept kept;
  EXPECT_THROW(play(scene, kept), InputError) << "no recording";
  TrackMeta meta = any_flight(3).meta();
  meta.dt = 0.02;
  scene.reference = std::make_shared<const Tracks>(any_flight(3).columns(), meta);
  EXPECT_EQ(scene.steps_per_frame(), 1);
  EXPECT_EQ(play(scene, kept).agent_steps, 2u * 4u);
  EXPECT_EQ(kept.ids.size(), 3u);
  scene.substeps = 2;
  EXPECT_THROW(play(scene, kept), InputError) << "steps are not the recording's";
}

TEST(Scenario, AgentsComeAndGoWhenItSays) {
  for (const char* warm_up : {"warm_up = 0\n", "warm_up = 15\n"}) {
    Kept kept;
    play(still(std::string(warm_up) + R"(
[start]
speed = 0
[[group]]
agents = 2
[[group]]
agents = 3
arrive = 1
every = 0.5
leave = 2.5
)"),
         kept);
    ASSERT_EQ(kept.ids.size(), 31u);
    EXPECT_THAT(kept.ids[9], ElementsAre(0, 1));
    EXPECT_THAT(kept.ids[10], ElementsAre(0, 1, 2));
    EXPECT_THAT(kept.ids[15], ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(kept.ids[20], ElementsAre(0, 1, 2, 3, 4));
    EXPECT_THAT(kept.ids[24], ElementsAre(0, 1, 2, 3, 4));
    EXPECT_THAT(kept.ids[25], ElementsAre(0, 1));
  }
}

TEST(Scenario, StimuliAreWhereItSays) {
  for (const char* warm_up : {"warm_up = 0\n", "warm_up = 15\n"}) {
    Kept agents, stimuli;
    play(still(std::string(warm_up) + R"(
agents = 4
[start]
shape = "grid"
lower = [-1, -1, 4]
upper = [1, 1, 6]
speed = 0
[[stimulus]]
kind = "repel"
at = [1, 0, 0]
velocity = [0, 2, 0]
from = 0
until = 2
[[stimulus]]
kind = "attract"
path = [[1, 0, 0, 0], [2, 4, 0, 0]]
[[stimulus]]
kind = "attract"
lead = [0, 0, 20]
[[stimulus]]
kind = "attract"
wander = {centre = [5, 5, 5], radius = 2, scale = 1, speed = 3}
)"),
         agents, &stimuli);
    EXPECT_THAT(stimuli.ids[0], ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(stimuli.ids[20], ElementsAre(1, 2, 3));
    EXPECT_NEAR(stimuli.places[10][0][1], 2, 1e-12);
    EXPECT_EQ(stimuli.places[5][1][0], 0);
    EXPECT_NEAR(stimuli.places[15][1][0], 2, 1e-12);
    EXPECT_EQ(stimuli.places[30][0][0], 4);
    EXPECT_NEAR(stimuli.places[0][2][2], 25, 1e-12);
    for (std::size_t f = 1; f < 20; ++f) {
      const Array3d step = stimuli.places[f][3] - stimuli.places[f - 1][3];
      EXPECT_GT(std::sqrt(step.square().sum()), 0.1) << "frame " << f;
      EXPECT_LE(std::sqrt(step.square().sum()), 0.3 + 1e-12) << "a path bends, and is never longer than speed times time";
      EXPECT_LE(std::sqrt((stimuli.places[f][3] - 5).square().sum()), 2 + 0.3);
    }
  }
}

TEST(Scenario, ARingStimulusIsAheadOfEveryAgent) {
  const Stimulus ring{.kind = Stimulus::Kind::attract, .start = {1, 2, 3}, .motion = Stimulus::Motion::ring, .radius = 4, .ahead = 0.5};
  const Stimuli stimuli({ring});
  for (const double angle : {0.0, 1.0, 3.0, -2.0}) {
    const Array3d agent = ring.start + Array3d(3 * std::cos(angle), 0.5, 3 * std::sin(angle));
    const Array3d target = ring.start + Array3d(4 * std::cos(angle + 0.5), 0, 4 * std::sin(angle + 0.5));
    const auto near = stimuli.nearest(agent, {}, 100);
    const Array3d from = (agent - target) / std::sqrt((agent - target).square().sum());
    EXPECT_LT((near.from - from).abs().maxCoeff(), 1e-12) << angle;
  }
}

TEST(Scenario, AgentsBeginWhereAndAsFastAsRecorded) {
  const auto file = std::filesystem::path(::testing::TempDir()) / fmt::format("swarmfit_start_{}.csv", getpid());
  std::ofstream(file) << "# unit: m\nid,t,x,y,z\na,0,0,0,0\nb,0,1,2,3\na,0.5,1,0,0\nb,0.5,1,1,3\na,1,3,0,0\n";
  const std::string top = kTop + std::string("dims = 3\n"), start = "[start]\nshape = \"recorded\"\nfile = \"" + file.string() + "\"\n";
  const Scenario s = read(top + start);
  ASSERT_EQ(s.agents(), 2);
  const State state = start_of(s);
  EXPECT_EQ(Array3d(state.pos.row(1).transpose()).matrix(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(Array3d(state.vel.row(0).transpose()).matrix(), Eigen::Vector3d(2, 0, 0));
  EXPECT_EQ(Array3d(state.vel.row(1).transpose()).matrix(), Eigen::Vector3d(0, -2, 0));
  EXPECT_EQ(start_of(read(top + start + "frame = 1\n")).vel(0, 0), 4);
  EXPECT_EQ(read(top + "agents = 1\n" + start).agents(), 1);
  EXPECT_THAT(refusal(top + "agents = 3\n" + start), HasSubstr("agents = 3, but 2 were recorded"));
  EXPECT_THAT(refusal(top + start + "frame = 7\n"), HasSubstr("frame = 7 has nobody in"));
  EXPECT_THAT(refusal(top + start + "speed = 7\n"), HasSubstr("speed"));
  EXPECT_THAT(refusal(kTop + std::string("dims = 2\n") + start), HasSubstr("has 3 dimensions, the scene 2"));
  Scenario more = s;
  more.groups.front().agents = 3;  // as --agents does
  EXPECT_THROW(start_of(more), InputError);
  std::filesystem::remove(file);
}

TEST(Scenario, ACurveIsAsLargeAsItSaysAndAgentsBeginByIt) {
  const Scenario s = read(
      "title = \"t\"\nmodel = \"fastswarm\"\nagents = 50\n[parameters]\nw_user = 1\n"
      "[curve]\nfile = \"star\"\nspacing = 8\nat = [1, 2, 3]\n[start]\nshape = \"curve\"\n");
  const Curve& curve = s.curve->curve;
  EXPECT_NEAR(curve.spacing(), 8, 1e-12);
  EXPECT_DOUBLE_EQ(s.curve->reach, 2);
  Array3d middle = Array3d::Zero();
  for (const Array3d& p : curve.points) middle += p / static_cast<double>(curve.points.size());
  EXPECT_NEAR((middle - Array3d(1, 2, 3)).abs().maxCoeff(), 0, 1e-12);
  const State start = start_of(s);
  for (Index i = 0; i < start.size(); ++i) {
    double nearest = 1e9;
    for (const Array3d& p : curve.points) nearest = std::min(nearest, std::sqrt((start.pos.row(i).transpose() - p).square().sum()));
    EXPECT_LT(nearest, 2);
  }
  EXPECT_THAT(refusal("title = \"t\"\nmodel = \"fastswarm\"\n[parameters]\nw_user = 1\n"), HasSubstr("there are no curves here"));
  EXPECT_THAT(refusal(kTop + std::string("[start]\nshape = \"curve\"\n")), HasSubstr("is a curve that is not there; expected [curve]"));
  EXPECT_THAT(refusal(kTop + std::string("[curve]\nfile = \"heart\"\n")), HasSubstr("spacing"));
  EXPECT_THAT(refusal(kTop + std::string("[curve]\nfile = \"nowhere.csv\"\n")), HasSubstr("dir/nowhere.csv"));
}

// Agents that fly side by side keep their density, so what follows it is multiplied by the same factor every time, up to four.
TEST(Scenario, WhatFollowsTheDensityIsMultipliedByItsRoot) {
  Scenario s = plain_scenario(parse_model("boids"));
  s.bounds = {};
  s.groups.front().agents = 8;
  s.groups.front().start = {.shape = Start::Shape::grid, .lower = {0, 0, 0}, .upper = {2, 2, 2}, .heading = {1, 0, 0}};
  set_parameter(s, "speed", 1);
  set_parameter(s, "radius", 0.01);
  s.frames = 41;
  s.dt = 0.1;
  // Corners of a cube of side 1: variance 1/4 along every axis, so the ellipsoid has the radius 1, and 8 / (4/3 pi) of them are in a unit.
  const double density = 8 / (4 * std::numbers::pi / 3);
  s.feedback = DensityFeedback{{parameter_row(*s.model.spec, "speed")}, density / std::pow(1.5, 3), 10};
  TrackCollector seen;
  play(s, seen);
  const Tracks tracks = seen.take(meta_of(s));
  const auto rows = tracks.rows_of(0);
  const auto way = [&](std::size_t from) { return tracks.pos()(rows[from + 1], 0) - tracks.pos()(rows[from], 0); };
  EXPECT_NEAR(way(5), 0.1, 1e-9);
  EXPECT_NEAR(way(15), 0.15, 1e-9);
  EXPECT_NEAR(way(25), 0.225, 1e-9);
  EXPECT_NEAR(way(35), 0.3375, 1e-9);
  s.feedback->density = density / 1e6;
  TrackCollector again;
  play(s, again);
  const Tracks fast = again.take(meta_of(s));
  EXPECT_NEAR(fast.pos()(fast.rows_of(0)[16], 0) - fast.pos()(fast.rows_of(0)[15], 0), 0.4, 1e-9);
}

TEST(Scenario, StartsAreAsTold) {
  const auto first = [](const std::string& start, int dims = 3) {
    Scenario s = still("agents = 60\n" + std::string(dims == 2 ? "dims = 2\n" : "") + "[start]\nspeed = 2\n" + start);
    return start_of(s);
  };
  const State line = first("shape = \"line\"\nlower = [0, 0, 0]\nupper = [59, 0, 0]\nheading = [0, 0, 9]");
  const State ring = first("shape = \"ring\"\nradius = 5\ncentre = [1, 1, 1]");
  const State box = first("shape = \"box\"\nlower = [0, 0, 0]\nupper = [1, 10, 100]");
  const State grid = first("shape = \"grid\"\nlower = [0, 0]\nupper = [6, 10]", 2);
  const State ball = first("radius = 3\ncentre = [7, 0, 0]");
  Array3d mean = Array3d::Zero();
  for (Index i = 0; i < 60; ++i) {
    EXPECT_NEAR(line.pos(i, 0), static_cast<double>(i), 1e-12);
    EXPECT_EQ(line.vel(i, 2), 2);
    EXPECT_NEAR(std::hypot(ring.pos(i, 0) - 1, ring.pos(i, 2) - 1), 5, 1e-12);
    EXPECT_EQ(ring.pos(i, 1), 1);
    EXPECT_NEAR(std::sqrt(box.vel.row(i).square().sum()), 2, 1e-12);
    mean += box.pos.row(i).transpose() / 60;
    EXPECT_NEAR(grid.pos(i, 0), 0.5 + static_cast<double>(i % 6), 1e-12) << "ten rows of six, sides as they are";
    EXPECT_LE(std::hypot(ball.pos(i, 0) - 7, ball.pos(i, 1), ball.pos(i, 2)), 3);
  }
  EXPECT_LT(((mean - Array3d(0.5, 5, 50)) / Array3d(1, 10, 100)).abs().maxCoeff(), 3 * 0.289 / std::sqrt(60.0));
}

}  // namespace
}  // namespace swarmfit
