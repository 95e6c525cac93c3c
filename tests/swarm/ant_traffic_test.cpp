// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "libswarm/bridge.h"
#include "libswarm/scenario/read.h"
#include "libswarm/scenario/scenario.h"
#include "tests/swarm/lane.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

constexpr double kTick = 0.1;
enum Kind : std::uint8_t { O, L, U };
constexpr double kStep[] = {0.23, 0.19, 0.23};

struct Traffic {
  Made made;
  Lane lane;
  explicit Traffic(const std::string& bridge = "narrow") : made(make("ant_traffic[bridge=" + bridge + "]")), lane(crowd(made, 0, 1, 1)) {}
  void add(Kind kind, double x, double y = 0) { lane.state.spawn(kind, {x, y, 0}, {kind == O ? 1.0 : -1.0, 0, 0}); }
  void step(std::int64_t first = 0) { run(made, {.frame_dt = kTick, .first_frame = first, .frames = 2}, lane); }
  double waiting(Index row) const { return lane.state.own(row, 2); }
};

// What an ant at x = 0 does about one of this kind, a little way ahead of it.
enum class Done { walk, stop, left, right };
Done reaction(const std::string& bridge, Kind me, Kind other, double gap = 1.45, double aside = 0) {
  Traffic traffic(bridge);
  const double ahead = me == O ? gap : -gap;
  traffic.add(me, 0, 2), traffic.add(other, ahead, 2 + aside);
  traffic.step();
  const double dx = std::abs(traffic.lane.state.pos(0, 0)), dy = traffic.lane.state.pos(0, 1) - 2;
  if (dx > 0) {
    EXPECT_NEAR(dx, kStep[me], 1e-12);
    EXPECT_EQ(dy, 0);
    return Done::walk;
  }
  if (dy == 0) return Done::stop;
  EXPECT_NEAR(std::abs(dy), kStep[me], 1e-12);
  return (dy > 0) == (me == O) ? Done::left : Done::right;
}

TEST(AntTraffic, WhoGivesWayOnANarrowBridge) {
  const std::map<std::pair<Kind, Kind>, Done> table{{{O, O}, Done::stop}, {{O, L}, Done::stop}, {{O, U}, Done::walk},
                                                    {{L, O}, Done::walk}, {{L, L}, Done::stop}, {{L, U}, Done::walk},
                                                    {{U, O}, Done::stop}, {{U, L}, Done::stop}, {{U, U}, Done::stop}};
  for (const auto& [pair, done] : table) EXPECT_EQ(reaction("narrow", pair.first, pair.second), done) << pair.first << pair.second;
  for (const Kind me : {O, L, U}) EXPECT_EQ(reaction("narrow", me, O, 1.47), Done::walk);  // too far away to matter
}

// The one that waits lets the laden ant pass and those that follow it, while its time lasts.
TEST(AntTraffic, OutboundAntsWaitForTheConvoy) {
  Traffic traffic;
  traffic.add(O, 0), traffic.add(L, 0.3), traffic.add(U, 1.2);
  traffic.step(0);  // outbound: stop, and wait for as many as are drawn
  const double drawn = traffic.waiting(0) + kTick;
  EXPECT_NEAR(drawn, std::round(drawn), 1e-9);
  EXPECT_GE(drawn, 1);
  EXPECT_LE(drawn, 15);
  traffic.step(1);
  traffic.step(2);  // laden passes at 0.3 - 2 · 0.19 < 0
  ASSERT_LT(traffic.lane.state.pos(1, 0), 0);
  EXPECT_EQ(traffic.lane.state.pos(0, 0), 0);
  EXPECT_EQ(traffic.lane.state.own(2, 3), 2);  // unladen, and led past
  const double before = traffic.lane.state.pos(2, 0);
  traffic.step(3);
  EXPECT_NEAR(traffic.lane.state.pos(2, 0), before - 0.23, 1e-12);
}

// 9000 draws: the shares of some counts to within 5 standard errors, and never 10.
TEST(AntTraffic, FollowersHaveThePublishedCounts) {
  std::map<int, double> share;
  const int pairs = 900, seeds = 10;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    Traffic traffic;
    traffic.lane.rng = {seed};
    for (int k = 0; k < pairs; ++k) traffic.add(O, 100.0 * k), traffic.add(L, 100.0 * k + 1.4);
    traffic.step();
    for (Index i = 0; i < 2 * pairs; i += 2)
      share[static_cast<int>(std::lround(traffic.waiting(i) > 0 ? traffic.waiting(i) + kTick : 0))] += 1.0 / (pairs * seeds);
  }
  const auto expect = [&](int followers, double p) { EXPECT_NEAR(share[followers], p, 5 * std::sqrt(p / (pairs * seeds))) << followers; };
  expect(0, .01), expect(1, .25), expect(2, .13), expect(4, .11), expect(9, .053), expect(15, .012);
  EXPECT_EQ(share[10], 0);
}

TEST(AntTraffic, WhoTurnsOnAWideBridge) {
  for (const double aside : {-0.3, 0.3}) {
    const auto away = [&](Kind me) { return (aside < 0) == (me == O) ? Done::left : Done::right; };
    EXPECT_EQ(reaction("wide", O, O, 1, aside), away(O));
    EXPECT_EQ(reaction("wide", O, L, 1, aside), away(O));
    EXPECT_EQ(reaction("wide", O, U, 1, aside), Done::walk);
    for (const Kind other : {O, L, U}) {
      EXPECT_EQ(reaction("wide", U, other, 1, aside), away(U));
      EXPECT_EQ(reaction("control", U, other, 1, aside), Done::stop);
      EXPECT_EQ(reaction("wide", L, other, 1, aside), Done::walk);
    }
    EXPECT_EQ(reaction("control", O, L, 1, aside), Done::stop);
  }
  EXPECT_EQ(reaction("wide", U, O, 1, 0.5), Done::walk);  // half an ant aside is clear
}

// Ants that are next along the way hide those behind them, however far aside they are.
TEST(AntTraffic, OnlyTheNextAntAheadCounts) {
  Traffic traffic("wide");
  traffic.add(U, 0, 2), traffic.add(U, -1, 2.1), traffic.add(U, -0.5, 4);
  traffic.step();
  EXPECT_NEAR(traffic.lane.state.pos(0, 0), -0.23, 1e-12);
}

// ---- the bridge -------------------------------------------------------------------------------------------------------------------

TEST(Bridge, ArrivalsAreAPoissonProcessAndExitsAreAtTheFarEnd) {
  Traffic traffic;
  traffic.lane.world.add(std::make_unique<Bridge>(BridgeShape{.length = 10}));
  set(traffic.made, traffic.lane, "range", 0.01);  // hardly anybody meets anybody
  const double time = 4000;
  run(traffic.made, {.frame_dt = kTick, .frames = static_cast<std::int64_t>(time / kTick)}, traffic.lane);
  EXPECT_NEAR(traffic.lane.state.next_id, 2 * time, 5 * std::sqrt(2 * time));
  EXPECT_LT(traffic.lane.state.size(), 40);  // about 10 of everybody: the rest has left
  EXPECT_GE(traffic.lane.state.pos.col(0).minCoeff(), -0.23);
  EXPECT_LE(traffic.lane.state.pos.col(0).maxCoeff(), 10.23);
}

TEST(Bridge, ItsSidesHoldAntsBack) {
  Traffic traffic("wide");
  traffic.lane.world.add(std::make_unique<Bridge>(BridgeShape{.length = 100, .width = 5, .mean_interval = 1e9}));
  traffic.add(U, 50, 0.1), traffic.add(O, 49, 0.2), traffic.add(U, 20, 4.9), traffic.add(O, 19, 4.8);
  traffic.step();
  EXPECT_EQ(traffic.lane.state.pos(0, 0), 50);
  EXPECT_EQ(traffic.lane.state.pos(0, 1), 0.25);
  EXPECT_EQ(traffic.lane.state.pos(2, 1), 4.75);
}

TEST(Bridge, IsReadFromAScenario) {
  const std::string text =
      "title = 'a bridge'\nmodel = 'ant_traffic[bridge=wide]'\nagents = 1\n"
      "[bridge]\nlength = 40\nwidth = 6\nmean_interval = 0.5\nladen = 0.2\n";
  const Scenario scene = read_scenario("bridge.toml", text);
  EXPECT_EQ(scene.dims, 2);
  const World world = world_of(scene);
  ASSERT_NE(world.part<Bridge>(), nullptr);
  const BridgeShape& shape = world.part<Bridge>()->shape();
  EXPECT_EQ(shape.length, 40);
  EXPECT_EQ(shape.width, 6);
  EXPECT_EQ(shape.entry_y, 3);  // the middle
  EXPECT_EQ(shape.mean_interval, 0.5);
  EXPECT_EQ(shape.laden, 0.2);
}

// ---- traffic ----------------------------------------------------------------------------------------------------------------------

struct Crossing {
  Kind kind;
  double y;
};

// Those that cross the middle of the bridge after the first 900 s of 1500 s: a sixth of what the targets below, per run, are counted over.
std::vector<Crossing> crossings(const std::string& bridge, const BridgeShape& shape, std::uint64_t seed) {
  Traffic traffic(bridge);
  traffic.lane.rng = {seed};
  traffic.lane.world.add(std::make_unique<Bridge>(shape));
  struct Watch : FrameSink {
    std::vector<bool> beyond, known;  // by id
    std::vector<Crossing> seen;
    void frame(const Snapshot& now) override {
      for (Index row = 0; row < now.pos.rows(); ++row) {
        const std::size_t k = static_cast<std::size_t>(row), id = now.id[k];
        if (id >= known.size()) known.resize(2 * id + 1), beyond.resize(2 * id + 1);
        const bool here = now.pos(row, 0) >= 150;
        if (now.frame > 9000 && known[id] && beyond[id] != here) seen.push_back({static_cast<Kind>(now.kind[k]), now.pos(row, 1)});
        known[id] = true, beyond[id] = here;
      }
    }
  } watch;
  traffic.lane.out = &watch;
  run(traffic.made, {.frame_dt = kTick, .frames = 15000}, traffic.lane);
  return watch.seen;
}

// Runs of ants in the same direction; the last, unfinished one is left out.
std::vector<std::vector<Kind>> clusters(const std::vector<Crossing>& seen) {
  std::vector<std::vector<Kind>> all;
  for (const Crossing& c : seen) {
    if (all.empty() || (all.back().front() == O) != (c.kind == O)) all.emplace_back();
    all.back().push_back(c.kind);
  }
  all.pop_back();
  return all;
}

double mean_size(const std::vector<std::vector<Kind>>& all) {
  double sum = 0;
  for (const auto& cluster : all) sum += static_cast<double>(cluster.size());
  return sum / static_cast<double>(all.size());
}

// An independent implementation gave, as mean and standard deviation of 60 runs: 5348 ± 75 crossings, clusters of 4.26 ± 0.12 ants; 0.358
// of them of one ant, 0.140 of two; those of five led by a laden ant with probability 0.47, single ones 0.08.
TEST(AntTraffic, FlowOverANarrowBridge) {
  const auto seen = crossings("narrow", {}, 1);
  EXPECT_NEAR(6 * static_cast<double>(seen.size()), 5348, 4 * 75 * std::sqrt(6));
  const auto all = clusters(seen);
  EXPECT_NEAR(mean_size(all), 4.26, 4 * 0.12 * std::sqrt(6));
  std::map<std::size_t, double> size, inbound, led;
  for (const auto& cluster : all) {
    size[cluster.size()] += 1.0 / static_cast<double>(all.size());
    if (cluster.front() == O) continue;
    inbound[cluster.size() == 1 ? 1 : 2] += 1;
    led[cluster.size() == 1 ? 1 : 2] += cluster.front() == L;
  }
  EXPECT_NEAR(size[1], 0.358, 0.06);
  EXPECT_NEAR(size[2], 0.140, 0.04);
  EXPECT_LT(led[1] / inbound[1], 0.2);
  EXPECT_GT(led[2] / inbound[2], 0.2);  // laden ants lead larger ones
}

// Shares that cross in the middle half of the width: with turning 0.692 ± 0.019 of outbound, 0.884 ± 0.021 of laden and 0.602 ± 0.026 of
// unladen ants, clusters of 2.05 ants and 9014 crossings; without turning 0.88 of all, and 2.86 ants (same source).
TEST(AntTraffic, ThreeLanesOnAWideBridge) {
  const BridgeShape wide{.width = 5, .mean_interval = 0.8, .laden = 0.04};
  std::map<std::string, std::map<Kind, double>> share;
  for (const std::string bridge : {"wide", "control"}) {
    const auto seen = crossings(bridge, wide, 1);
    EXPECT_NEAR(6 * static_cast<double>(seen.size()), 9020, 900);
    EXPECT_NEAR(mean_size(clusters(seen)), bridge == "wide" ? 2.05 : 2.86, 0.15);
    std::map<Kind, double> total;
    for (const Crossing& c : seen) {
      total[c.kind] += 1;
      share[bridge][c.kind] += c.y >= 1.25 && c.y <= 3.75;
    }
    for (auto& [kind, inside] : share[bridge]) inside /= total[kind];
  }
  EXPECT_NEAR(share["wide"][O], 0.692, 4 * 0.019 * std::sqrt(6));
  EXPECT_NEAR(share["wide"][L], 0.884, 4 * 0.021 * std::sqrt(6));
  EXPECT_NEAR(share["wide"][U], 0.602, 4 * 0.026 * std::sqrt(6));
  for (const Kind kind : {O, L, U}) EXPECT_NEAR(share["control"][kind], 0.88, 0.06);
}

}  // namespace
}  // namespace swarmfit
