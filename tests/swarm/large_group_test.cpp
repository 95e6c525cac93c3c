// SPDX-License-Identifier: MIT
// Large groups are put into the order of their places while they run: nobody may notice but by the row.
#include <gtest/gtest.h>

#include <map>

#include "tests/swarm/lane.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

constexpr Index kLarge = 2500;  // simulate.cpp sorts from 2000 on

TEST(StateOfMany, AppendedAgentsAreAtRestAndNumberedOn) {
  State state;
  state.own.resize(0, 2);
  state.spawn(3, {1, 2, 3}, {4, 5, 6}, 7);
  state.own.row(0) << 8, 9;
  EXPECT_EQ(state.append(2), 1);
  EXPECT_EQ(state.id, (std::vector<std::uint32_t>{7, 8, 9}));
  EXPECT_EQ(state.kind, (std::vector<std::uint8_t>{3, 0, 0}));
  EXPECT_EQ(state.next_id, 10u);
  EXPECT_TRUE((state.pos.row(0) == Array3d(1, 2, 3).transpose()).all() && (state.pos.bottomRows(2) == 0).all());
  EXPECT_TRUE((state.vel.row(0) == Array3d(4, 5, 6).transpose()).all() && (state.vel.bottomRows(2) == 0).all());
  EXPECT_TRUE(state.own(0, 1) == 9 && (state.own.bottomRows(2) == 0).all());
}

TEST(StateOfMany, ReorderMovesEverythingOfAnAgent) {
  State state;
  state.own.resize(0, 1);
  for (std::uint8_t k = 0; k < 4; ++k) state.own(state.spawn(k, Array3d::Constant(k), -Array3d::Constant(k), 10u + k), 0) = 100 + k;
  const std::vector<Index> order{2, 0, 3, 1};
  state.reorder(order);
  for (Index row = 0; row < 4; ++row) {
    const auto k = static_cast<std::size_t>(order[static_cast<std::size_t>(row)]);
    const auto x = static_cast<double>(k);
    const auto r = static_cast<std::size_t>(row);
    EXPECT_TRUE(state.pos(row, 1) == x && state.vel(row, 2) == -x && state.own(row, 0) == 100 + x && state.kind[r] == k &&
                state.id[r] == 10 + k)
        << row;
  }
}

std::map<std::uint32_t, Array3d> places(const State& state) {
  std::map<std::uint32_t, Array3d> at;
  for (Index i = 0; i < state.size(); ++i) at[state.id[static_cast<std::size_t>(i)]] = state.pos.row(i).transpose();
  return at;
}

// Oscillators that ignore each other move as each does in a small group, which is not sorted.
TEST(LargeGroup, AgentsAreWhoTheyWere) {
  const Made made = make("langevin");
  const Plan plan{.frame_dt = 0.01, .frames = 40};
  Lane large = crowd(made, kLarge, 20, 0.3), small = crowd(made, 100, 20, 0.3);
  run(made, plan, large);
  run(made, plan, small);
  const auto among_many = places(large.state);
  ASSERT_EQ(among_many.size(), static_cast<std::size_t>(kLarge));
  EXPECT_FALSE(std::is_sorted(large.state.id.begin(), large.state.id.end()));
  for (const auto& [id, at] : places(small.state)) EXPECT_TRUE((among_many.at(id) == at).all()) << id;
}

TEST(LargeGroup, StoppedAndGoneOnIsTheSame) {
  const Made made = make("bswarm");
  Lane whole = crowd(made, kLarge, 20, 0.3), halves = whole;
  run(made, {.frame_dt = 0.01, .frames = 37}, whole);
  run(made, {.frame_dt = 0.01, .frames = 21}, halves);
  run(made, {.frame_dt = 0.01, .first_frame = 20, .frames = 17}, halves);
  const auto once = places(whole.state), twice = places(halves.state);
  for (const auto& [id, at] : once) ASSERT_TRUE((twice.at(id) == at).all()) << id;
}

}  // namespace
}  // namespace swarmfit
