// SPDX-License-Identifier: MIT
// Sweeps by themselves, without the program around them.
#include "fit/study/sweep.h"

#include <gmock/gmock.h>

#include <set>

#include "fit/experiment/plant.h"
#include "libtrack/error.h"

namespace swarmfit {
namespace {

using testing::ElementsAre;

Scenario vicsek(double eta, int agents = 15) {
  Scenario scene = plain_scenario(parse_model("vicsek"), 2);
  set_parameter(scene, "eta", eta);
  scene.bounds = {};
  scene.groups.front().agents = agents;
  scene.groups.front().start.radius = 1;
  scene.groups.front().start.speed = 1;
  scene.frames = 12;
  scene.warm_up = 6;
  scene.dt = 1;
  scene.substeps = 1;
  return scene;
}

SweepOptions over(const std::string& axis) {
  SweepOptions o;
  o.axes = {parse_axis(axis)};
  o.seeds = 3;
  o.measure.what = order_parameters_named({"polarisation", "extent"});
  o.scene_at = [](const std::vector<std::string>& words) { return vicsek(std::stod(words[0])); };
  return o;
}

TEST(SweepAxis, IsWhatWasAskedFor) {
  const SweepAxis line = parse_axis("c=0:1:5");
  EXPECT_EQ(line.name, "c");
  EXPECT_THAT(line.value, ElementsAre(0, 0.25, 0.5, 0.75, 1));
  EXPECT_THAT(line.words, ElementsAre("0", "0.25", "0.5", "0.75", "1"));
  EXPECT_THAT(parse_axis("c=0.1:0.7:7").words, ElementsAre("0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7"));
  EXPECT_THAT(parse_axis("c=0.01:100:5:log").value, ElementsAre(0.01, 0.1, 1, 10, 100));
  EXPECT_THAT(parse_axis("c=3:3:1").value, ElementsAre(3));
  EXPECT_THAT(parse_axis("c=1,2,8").value, ElementsAre(1, 2, 8));
  const SweepAxis words = parse_axis("noise=white,curl");
  EXPECT_FALSE(words.numeric);
  EXPECT_THAT(words.words, ElementsAre("white", "curl"));
  for (const char* bad : {"c", "c=", "=1", "c=2,1", "c=1,1", "c=1:2:0", "c=1:2:3:root", "c=1:inf:3", "c=nan:1:2", "c=1:2:100000"})
    EXPECT_THROW(parse_axis(bad), InputError) << bad;
}

// One value there and back: the way up is a plain run, and the way back goes on from it.
TEST(Sweep, HysteresisGoesOnFromWhereItWas) {
  SweepOptions o = over("eta=0.5:2:2");
  const Sweep plain = run_sweep(o);
  o.hysteresis = true;
  const Sweep loop = run_sweep(o);
  ASSERT_EQ(loop.cells.size(), 4U);
  for (std::size_t r = 0; r < 3; ++r) {
    EXPECT_EQ(loop.cells[0].runs[r].means, plain.cells[0].runs[r].means);
    EXPECT_NE(loop.cells[1].runs[r].means, plain.cells[1].runs[r].means);  // another start
    EXPECT_NE(loop.cells[2].runs[r].means, loop.cells[0].runs[r].means);   // the same value, later
  }
  EXPECT_TRUE(loop.cells[2].down && loop.cells[3].down);
  EXPECT_EQ(loop.cells[3].place[0], 2);
}

TEST(Sweep, LatinHypercubeHasEveryStripOnce) {
  SweepOptions o = over("eta=0:6:2");
  o.axes.push_back(parse_axis("agents=3:12:2"));
  o.axes.back().whole = true;
  o.scene_at = [](const std::vector<std::string>& words) { return vicsek(std::stod(words[0]), std::stoi(words[1])); };
  o.latin = 10;
  o.seeds = 1;
  const Sweep sweep = run_sweep(o);
  std::set<int> strips, agents;
  for (const SweepCell& cell : sweep.cells) {
    strips.insert(static_cast<int>(cell.place[0] / 0.6));
    agents.insert(static_cast<int>(cell.place[1]));
    EXPECT_EQ(cell.place[1], std::floor(cell.place[1]));
  }
  EXPECT_EQ(strips.size(), 10U);
  EXPECT_EQ(agents.size(), 10U);  // 3 to 12, each once
}

// What every order parameter of a cell is: the mean over the frames after the warm-up, as of the recording of the same run.
TEST(Sweep, MeasuresWhatTheRecordingShows) {
  SweepOptions o = over("eta=1:1:1");
  o.seed = 7, o.seeds = 1;
  const Sweep sweep = run_sweep(o);
  Scenario scene = vicsek(1);
  scene.seed = 7;
  const Tracks tracks = film(scene, {}).tracks;
  const OrderRecord record = order_record(tracks, moment_options(tracks), o.measure.what);
  for (std::size_t k = 0; k < 2; ++k) {
    double sum = 0, count = 0;
    for (const double x : record.values(k))
      if (std::isfinite(x)) sum += x, ++count;
    EXPECT_NEAR(sweep.cells[0].mean[k], sum / count, 1e-12);
  }
}

TEST(Sweep, StopsWithinASimulation) {
  SweepOptions one = over("eta=1");
  one.seeds = 1;
  int asked = 0;
  const Threads here([&] { return asked++ >= 5; });
  EXPECT_THROW(run_sweep(one, {}, {&here}), Interrupted);
  EXPECT_EQ(asked, 6);
}

TEST(Sweep, ARunThatDivergesIsCountedAndSpoilsNobody) {
  SweepOptions o = over("speed=1:1e300:2");
  o.scene_at = [](const std::vector<std::string>& words) {
    Scenario scene = vicsek(1);
    scene.parameters[static_cast<std::size_t>(scene.model.spec->find("speed"))] = std::stod(words[0]);
    return scene;
  };
  const Sweep sweep = run_sweep(o);
  EXPECT_FALSE(sweep.cells[0].runs[0].blew_up);
  EXPECT_TRUE(std::isfinite(sweep.cells[0].mean[0]));
  EXPECT_TRUE(sweep.cells[1].runs[0].blew_up);
  EXPECT_TRUE(std::isnan(sweep.cells[1].mean[0]));
  EXPECT_EQ(sweep.cells[1].state, "");
}

}  // namespace
}  // namespace swarmfit
