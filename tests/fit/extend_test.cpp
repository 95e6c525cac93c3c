// SPDX-License-Identifier: MIT
#include "fit/synthesis/extend.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "fit/experiment/plant.h"
#include "libtrack/cut.h"
#include "libtrack/error.h"
#include "libtrack/read/read.h"
#include "libtrack/write/write.h"

namespace swarmfit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const Tracks& demo() {
  static const Tracks tracks = cut(demo_recording(), 0, 60);
  return tracks;
}

Pilot pilot(const char* model = "fastswarm") { return {parse_model(model), {}, "open", 3}; }

// Every recorded point is in the result at its very place and says so, and nobody else does.
void expect_kept(const Tracks& recording, const Tracks& out) {
  Index recorded = 0;
  for (Index row = 0; row < out.rows(); ++row) {
    if (out.kind(row) != 0) continue;
    ASSERT_LT(recorded, recording.rows());
    const auto r = static_cast<std::size_t>(row), k = static_cast<std::size_t>(recorded);
    EXPECT_EQ(out.frame()[r], recording.frame()[k]);
    EXPECT_EQ(out.names()[out.track()[r]], recording.names()[recording.track()[k]]);
    ASSERT_TRUE((out.pos().row(row) == recording.pos().row(recorded)).all()) << "row " << row;
    ++recorded;
  }
  EXPECT_EQ(recorded, recording.rows());
}

// The recorded rows in the order of frames: names may be numbered otherwise in a file.
TEST(Extend, GoesOnPastTheEndAndKeepsWhatWasRecorded) {
  const Tracks out = extend(demo(), {pilot(), {.all = 20}, {.all = 0}});
  expect_kept(demo(), out);
  EXPECT_TRUE(out.meta().from.synthetic);
  EXPECT_THAT(out.meta().kinds, ElementsAre("recorded", "synthetic"));
  EXPECT_EQ(out.frames().back().number, demo().frames().back().number + 20);
  for (std::uint32_t t = 0; t < demo().track_count(); ++t) {
    if (demo().rows_of(t).empty()) continue;
    const Index before = demo().rows_of(t).back(), after = out.rows_of(t).back();
    EXPECT_EQ(out.frame()[static_cast<std::size_t>(after)], demo().frame()[static_cast<std::size_t>(before)] + 20);
    EXPECT_EQ(out.kind(after), 1);
  }
}

// Everybody flies at velocities of the recording, so nobody jumps where a track goes on.
TEST(Extend, FliesOnFromTheLastPlace) {
  const Tracks out = extend(demo(), {pilot(), {.all = 5}, {.all = 0}});
  double fastest = 0, step = 0;
  for (Index row = 0; row < out.rows(); ++row) {
    const Index next = out.next()[static_cast<std::size_t>(row)];
    if (next < 0) continue;
    const double length = std::sqrt((out.pos().row(next) - out.pos().row(row)).square().sum());
    (out.kind(next) == 0 ? fastest : step) = std::max(out.kind(next) == 0 ? fastest : step, length);
  }
  EXPECT_GT(step, 0);
  EXPECT_LE(step, fastest);
}

Tracks with_hole(std::int64_t from, std::int64_t to) {
  TrackColumns c = demo().columns(), out;
  std::vector<Index> rows;
  for (std::size_t r = 0; r < c.frame.size(); ++r) {
    if (c.track[r] == 0 && c.frame[r] >= from && c.frame[r] < to) continue;
    rows.push_back(static_cast<Index>(r));
    out.track.push_back(c.track[r]);
    out.frame.push_back(c.frame[r]);
  }
  out.names = c.names;
  out.pos = c.pos(rows, Eigen::all);
  return {std::move(out), demo().meta()};
}

TEST(Extend, BridgesAGapSoThatTheEndsMeet) {
  const Tracks recording = with_hole(20, 32);
  for (const char* model : {"fastswarm", "langevin"}) {
    const Tracks out = extend(recording, {pilot(model), {}, {.all = 12}});
    expect_kept(recording, out);
    double longest = 0;
    std::size_t filled = 0;
    const auto rows = out.rows_of(0);
    for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
      const auto frame = out.frame()[static_cast<std::size_t>(rows[k])];
      if (frame < 19 || frame >= 32) continue;
      filled += out.kind(rows[k]) == 1;
      ASSERT_EQ(out.next()[static_cast<std::size_t>(rows[k])], rows[k + 1]) << model << " leaves a gap at frame " << frame;
      longest = std::max(longest, std::sqrt((out.pos().row(rows[k + 1]) - out.pos().row(rows[k])).square().sum()));
    }
    EXPECT_EQ(filled, 12u);
    EXPECT_LT(longest, 30) << model;  // mm, in a fiftieth of a second, at some 200 mm/s: 4 on average, and the correction
  }
}

TEST(Extend, BridgesNoLongerGapThanAskedFor) {
  const Tracks out = extend(with_hole(20, 32), {pilot(), {.all = 1}, {.all = 11}});
  for (const Index row : out.rows_of(0)) {
    const auto frame = out.frame()[static_cast<std::size_t>(row)];
    EXPECT_FALSE(frame >= 20 && frame < 32) << frame;
  }
}

TEST(Extend, TakesFramesPerIndividual) {
  const std::string name = demo().names()[2];
  const Tracks out = extend(demo(), {pilot(), {.all = 0, .own = {{name, 7}}}, {.all = 0}});
  Index synthetic = 0;
  for (Index row = 0; row < out.rows(); ++row) {
    if (out.kind(row) == 0) continue;
    ++synthetic;
    EXPECT_EQ(out.names()[out.track()[static_cast<std::size_t>(row)]], name);
  }
  EXPECT_EQ(synthetic, 7);
}

TEST(Extend, RefusesWhatItCannotDo) {
  const auto error = [](const ExtendOptions& options) -> std::string {
    try {
      extend(demo(), options);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_THAT(error({pilot(), {.all = 0}, {.all = 0}}), HasSubstr("nothing to add"));
  EXPECT_THAT(error({pilot(), {.own = {{"nobody", 3}}}, {}}), HasSubstr("`onward` nobody: no individual in demo has that name"));
  Pilot wrong = pilot();
  wrong.set["speed"] = 1;
  EXPECT_THAT(error({wrong, {.all = 1}, {}}), HasSubstr("`set` speed: fastswarm has no such parameter; expected one of w_rep"));
}

TEST(Augment, AddsAgentsAndMovesNobody) {
  const Tracks out = augment(demo(), {pilot(), 15});
  expect_kept(demo(), out);
  EXPECT_EQ(out.track_count(), demo().track_count() + 15);
  for (std::uint32_t t = static_cast<std::uint32_t>(demo().track_count()); t < out.track_count(); ++t) {
    EXPECT_EQ(out.rows_of(t).size(), 60u);
    EXPECT_EQ(out.kind(out.rows_of(t).front()), 1);
  }
  EXPECT_EQ(out.names().back(), "synthetic15");
}

// Recorded agents are neighbours: who is among them flies otherwise than alone.
TEST(Augment, SimulatedAgentsMeetRecordedOnes) {
  Pilot shy = pilot();
  shy.set = {{"w_rep", 1000}, {"d_rep", 150}, {"w_n", 0}};
  const Tracks among = augment(demo(), {shy, 1}), far = [&] {
    TrackColumns c = demo().columns();
    return augment(Tracks(std::move(c), demo().meta()), {[&] {
                                                           Pilot p = shy;
                                                           p.set["w_rep"] = 0;
                                                           return p;
                                                         }(),
                                                         1});
  }();
  const Index a = among.rows_of(static_cast<std::uint32_t>(among.track_count()) - 1).back(),
              b = far.rows_of(static_cast<std::uint32_t>(far.track_count()) - 1).back();
  EXPECT_GT((among.pos().row(a) - far.pos().row(b)).abs().maxCoeff(), 1);
}

// The label survives a file.
TEST(Augment, OriginIsWrittenAndRead) {
  const Tracks out = augment(demo(), {pilot(), 2});
  const std::string csv = to_csv(out);
  EXPECT_THAT(csv, HasSubstr("# kinds: recorded; synthetic\n"));
  const Tracks again = read_tracks_bytes("file.csv", csv, {});
  EXPECT_THAT(again.meta().kinds, ElementsAre("recorded", "synthetic"));
  EXPECT_TRUE(again.meta().from.synthetic);
  ASSERT_EQ(again.rows(), out.rows());
  Index synthetic = 0;
  for (Index row = 0; row < again.rows(); ++row) {
    const bool made = again.names()[again.track()[static_cast<std::size_t>(row)]].starts_with("synthetic");
    EXPECT_EQ(again.kind(row), made ? 1 : 0);
    synthetic += made;
  }
  EXPECT_EQ(synthetic, 120);
  EXPECT_EQ(of_kind(again, 0).rows(), demo().rows());
}

}  // namespace
}  // namespace swarmfit
