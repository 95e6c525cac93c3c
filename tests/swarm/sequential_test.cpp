// SPDX-License-Identifier: MIT
// Models in which agents move one after the other.
#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "tests/swarm/lane.h"

namespace swarmfit {
namespace {

// People who stand in line: who moves goes to the end of it, one place behind whoever is last now. Each remembers who that was.
struct Queue : Model {
  mutable std::vector<std::vector<std::uint32_t>> moves;  // ids, by step
  mutable bool halve = false;

  Index columns() const override { return 1; }
  Step step(const State& now, State& next, const World&, const StepContext& c) const override {
    EXPECT_TRUE((next.pos == now.pos).all() && (next.vel == now.vel).all() && (next.own == now.own).all());
    EXPECT_EQ(c.order.size(), now.id.size());
    moves.emplace_back();
    for (const Index i : c.order) {
      Index last = 0;
      next.pos(i, 0) = next.pos.col(0).maxCoeff(&last) + 1;
      next.vel(i, 0) = 1;
      next.own(i, 0) = next.id[static_cast<std::size_t>(last)];
      moves.back().push_back(now.id[static_cast<std::size_t>(i)]);
    }
    return std::exchange(halve, false) ? Step::halve_dt : Step::done;
  }
};

// Registered by the test, as a user of the library would.
ModelSpec queue_spec() {
  ModelSpec spec;
  spec.name = "queue";
  spec.dims = {2, 3};
  spec.update = Update::sequential;
  spec.columns = {"behind"};
  spec.make = [](const swarmfit::Setup&) -> std::unique_ptr<Model> { return std::make_unique<Queue>(); };
  return spec;
}

struct Line {
  std::vector<ModelSpec> specs{queue_spec()};
  Made made{parse_model("queue", specs), make_model(parse_model("queue", specs), {})};
  Queue& model() const { return static_cast<Queue&>(*made.model); }
};

Lane people(std::vector<std::uint32_t> ids) {
  Lane lane;
  lane.rng = {3};
  for (const auto id : ids) lane.state.spawn(0, {0, 0, 0}, {0, 0, 0}, id);
  return lane;
}

TEST(Sequential, EachSeesWhereThoseBeforeItAreNow) {
  const Line line;
  Lane lane = people({0, 1, 2, 3, 4});
  run(line.made, {.frame_dt = 1, .frames = 2}, lane);
  const auto& moved = line.model().moves.at(0);
  ASSERT_EQ(moved.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) {
    const auto row = static_cast<Index>(moved[k]);
    EXPECT_EQ(lane.state.pos(row, 0), static_cast<double>(k + 1));
    if (k > 0) {
      EXPECT_EQ(lane.state.own(row, 0), moved[k - 1]);
    }
  }
}

TEST(Sequential, TheOrderBelongsToIdsNotToRows) {
  const Line one, other;
  Lane a = people({0, 1, 2, 3, 4, 5, 6}), b = people({5, 3, 0, 6, 1, 4, 2});
  run(one.made, {.frame_dt = 1, .frames = 20}, a);
  run(other.made, {.frame_dt = 1, .frames = 20}, b);
  EXPECT_EQ(one.model().moves, other.model().moves);
}

// 6 orders of three people, 6000 steps: each 1000 times, standard deviation 29.
TEST(Sequential, EveryOrderIsAsLikelyAsAnyOther) {
  const Line line;
  Lane lane = people({0, 1, 2});
  run(line.made, {.frame_dt = 1, .frames = 6001}, lane);
  std::map<std::vector<std::uint32_t>, int> seen;
  for (const auto& order : line.model().moves) ++seen[order];
  EXPECT_EQ(seen.size(), 6u);
  for (const auto& [order, times] : seen) EXPECT_NEAR(times, 1000, 4 * 29);
}

TEST(Sequential, AHalvedStepBeginsAgain) {
  const Line line;
  Lane lane = people({0, 1, 2, 3, 4, 5, 6, 7});
  line.model().halve = true;
  run(line.made, {.frame_dt = 1, .frames = 2}, lane);
  const auto& moves = line.model().moves;
  ASSERT_EQ(moves.size(), 3u);  // the whole step, which is thrown away, and its halves
  EXPECT_EQ(lane.state.pos.col(0).maxCoeff(), 16);
  EXPECT_NE(moves[1], moves[2]);
}

TEST(Sequential, OthersGetNoOrder) {
  struct Curious : Model {
    Step step(const State& now, State& next, const World&, const StepContext& c) const override {
      EXPECT_TRUE(c.order.empty());
      next.pos = now.pos;
      next.vel = now.vel;
      return Step::done;
    }
  };
  Lane lane = people({0, 1});
  cpu_backend().run(Curious{}, {.frame_dt = 1, .frames = 3}, {&lane, 1});
}

}  // namespace
}  // namespace swarmfit
