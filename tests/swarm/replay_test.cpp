// SPDX-License-Identifier: MIT
#include "libswarm/replay.h"

#include <gtest/gtest.h>

#include "tests/swarm/lane.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

// Frames first .. first + n - 1 at (x, 0, 0), (x + 1, 0, 0), ..., a unit per frame of 0.1 s.
Replay::Stretch along_x(std::int64_t first, Index n, double x, bool bridged) {
  Replay::Stretch s{first, Rows::Zero(n, 3), Rows::Zero(n, 3), bridged};
  for (Index k = 0; k < n; ++k) s.pos(k, 0) = x + static_cast<double>(k), s.vel(k, 0) = 10;
  return s;
}

Recorded flown(const Replay& replay, std::int64_t frames, int substeps = 1, Lane* end = nullptr) {
  const Made made = make("langevin");
  Lane lane = crowd(made, 5, 3, 1);
  for (std::uint32_t& id : lane.state.id) id += 100;
  lane.state.next_id = 200;
  set(made, lane, "sigma_eta", 0);
  set(made, lane, "k", 0);
  set(made, lane, "tau_v", 100);
  lane.world.add(replay.clone());
  Recorded out;
  lane.out = &out;
  run(made, {.frame_dt = 0.1, .substeps = substeps, .frames = frames}, lane);
  if (end) *end = std::move(lane);
  return out;
}

// Where individual 7 is in a frame, if it is there.
std::optional<Array3d> place(const Recorded& out, std::size_t frame) {
  const auto& m = out.moments[frame];
  for (std::size_t i = 0; i < m.id.size(); ++i)
    if (m.id[i] == 7) return Array3d(m.pos.row(static_cast<Index>(i)).transpose());
  return std::nullopt;
}

TEST(Replay, IsWhereItWasRecordedAndNowhereElse) {
  const Replay replay({{7, 0, {along_x(2, 4, 0, false), along_x(9, 3, 20, false)}, 11}}, 0.1);
  for (const int substeps : {1, 3}) {
    const auto out = flown(replay, 15, substeps);
    for (const std::size_t f : {0, 1, 6, 7, 8, 12, 13, 14}) EXPECT_FALSE(place(out, f)) << f;
    for (std::size_t f = 2; f < 6; ++f) EXPECT_EQ((*place(out, f))[0], static_cast<double>(f) - 2);
    for (std::size_t f = 9; f < 12; ++f) EXPECT_EQ((*place(out, f))[0], 11.0 + static_cast<double>(f));
    for (const auto& m : out.moments) EXPECT_GE(m.id.size(), 5u);  // the simulated ones stay
  }
}

// Without forces it flies on as fast as it was: 10 units per second and almost no friction.
TEST(Replay, FliesOnPastItsEnd) {
  const auto out = flown(Replay({{7, 0, {along_x(0, 4, 0, false)}, 6}}, 0.1), 10);
  for (std::size_t f = 4; f < 7; ++f) EXPECT_NEAR((*place(out, f))[0], static_cast<double>(f), 0.02) << f;
  EXPECT_FALSE(place(out, 7));
}

TEST(Replay, TellsWhatABridgeMisses) {
  Lane end;
  const auto out = flown(Replay({{7, 0, {along_x(0, 4, 0, true), along_x(7, 2, 9, false)}, 8}}, 0.1), 9, 1, &end);
  EXPECT_NEAR((*place(out, 5))[0], 5, 0.02);
  EXPECT_EQ((*place(out, 7))[0], 9);
  const auto& arrivals = end.world.part<Replay>()->arrivals();
  ASSERT_EQ(arrivals.size(), 1u);
  EXPECT_EQ(arrivals[0].frame, 7);
  EXPECT_NEAR(arrivals[0].missed_by[0], 2, 0.03);  // flying on would have led to 7
}

TEST(Replay, HeadsForWhereTheTrackGoesOn) {
  Replay replay({{7, 0, {along_x(0, 3, 0, true), along_x(6, 2, 9, false)}, 7}}, 0.1);
  State state;
  const World world;
  const auto at = [&](std::int64_t frame) { replay.advance({frame, 0, 0, 0.1}, world, state); };
  at(2);
  ASSERT_TRUE(replay.goal(7));
  EXPECT_EQ((*replay.goal(7))[0], 9);
  at(4);
  EXPECT_EQ((*replay.goal(7))[0], 9);
  at(7);
  EXPECT_FALSE(replay.goal(7));
  EXPECT_FALSE(replay.goal(3));
  EXPECT_FALSE(replay.goal(3000));
}

}  // namespace
}  // namespace swarmfit
