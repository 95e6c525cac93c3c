// SPDX-License-Identifier: MIT
#include "libtrack/clean.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "libtrack/resample.h"
#include "tests/track/build.h"

namespace swarmfit {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

// One individual along x, in rows of frame and x.
std::string line(const std::vector<std::pair<int, double>>& rows, const std::string& id = "a") {
  std::string out;
  for (const auto& [frame, x] : rows) out += id + "," + std::to_string(frame) + "," + std::to_string(x) + ",5\n";
  return out;
}

Tracks film(const std::string& rows, double fps = 10) { return read("id,frame,x,y\n" + rows, {.fps = fps, .unit = "px"}); }

std::string last_note(const Tracks& tracks) { return tracks.meta().from.notes.back(); }

std::vector<double> xs(const Tracks& tracks, std::uint32_t track = 0) {
  std::vector<double> out;
  for (const Index row : tracks.rows_of(track)) out.push_back(tracks.pos()(row, 0));
  return out;
}

std::string refusal(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Clean, ScaleTurnsPixelsIntoMillimetres) {
  const auto scale = parse_scale("0.5,2mm/px");
  EXPECT_EQ(scale.to, "mm");
  const auto out = scaled(film(line({{0, 1}, {1, 3}})), scale);
  EXPECT_THAT(xs(out), ElementsAre(0.5, 1.5));
  EXPECT_EQ(out.pos()(0, 1), 10);
  EXPECT_EQ(out.meta().unit, "mm");
  EXPECT_EQ(last_note(out), "lengths were multiplied by 0.5, 2, from px to mm");
  EXPECT_EQ(scaled(out, parse_scale("2")).meta().unit, "mm") << "a plain factor leaves the unit";
  EXPECT_THAT(refusal([&] { scaled(out, scale); }), HasSubstr("is in mm; expected mm/mm"));
  for (const char* wrong : {"", "0", "-1", "nan", "inf", "1,0", "1,2,3,4", "1mm", "1 mm/", "1/px", "mm/px"})
    EXPECT_THAT(refusal([&] { parse_scale(wrong); }), StartsWith("'" + std::string(wrong) + "' is not a scale; expected")) << wrong;
}

TEST(Clean, ScaleTakesVelocitiesAlong) {
  const auto tracks = read("id,frame,x,y,vx,vy\na,0,1,2,3,4\na,1,1,2,3,4\n", {.fps = 1, .unit = "m"});
  EXPECT_EQ(scaled(tracks, parse_scale("10")).vel()(0, 1), 40);
  EXPECT_EQ(flip_y(tracks).vel()(0, 1), -4);
  EXPECT_EQ(flip_y(tracks).pos()(0, 1), -2);
  EXPECT_EQ(flip_y(flip_y(tracks)).pos()(0, 1), 2);
}

TEST(Clean, UnwrapFollowsAcrossTheBoundary) {
  const auto out = unwrap(film(line({{0, 8}, {1, 9.5}, {2, 1}, {3, 9}, {5, 8}})), parse_box("10"));
  EXPECT_THAT(xs(out), ElementsAre(8, 9.5, 11, 9, 8));
  EXPECT_EQ(last_note(out), "periodic boundaries of a box of 10 px were undone: 2 crossings");
  EXPECT_THAT(refusal([] { parse_box("0"); }), HasSubstr("is not a box; expected its edge"));
  EXPECT_THAT(refusal([] { parse_box("10m"); }), HasSubstr("is not a box"));
}

// A random walk in a box, unwrapped, is the walk but for whole edges at its start.
TEST(Clean, UnwrapUndoesWrapping) {
  std::vector<std::pair<int, double>> inside;
  std::vector<double> walk;
  double x = 3;
  for (int k = 0; k < 200; ++k) {
    x += 2.4 * std::sin(1.7 * k * k);
    walk.push_back(x);
    inside.emplace_back(k, x - 5 * std::floor(x / 5));
  }
  const auto out = xs(unwrap(film(line(inside)), parse_box("5,1e9")));
  for (std::size_t k = 0; k < walk.size(); ++k) EXPECT_NEAR(out[k] - out[0], walk[k] - walk[0], 1e-4);
}

TEST(Clean, JumpsEndATrackAndBeginAnother) {
  const auto out = cut_jumps(film(line({{0, 0}, {1, 1}, {2, 50}, {3, 51}, {9, 60}, {10, 0}})), 20);
  EXPECT_THAT(out.names(), ElementsAre("a", "a-2", "a-3"));
  EXPECT_THAT(xs(out, 1), ElementsAre(50, 51, 60)) << "a gap of six frames gives time to move";
  EXPECT_EQ(last_note(out), "tracks were cut where they move faster than 20 px/s: 2 places");
  EXPECT_THAT(cut_jumps(film(line({{0, 0}, {1, 50}}) + line({{0, 0}}, "a-2")), 20).names(), ElementsAre("a", "a-2", "a-3"));
}

TEST(Clean, StrideKeepsTheTimes) {
  const auto tracks = film(line({{3, 3}, {4, 4}, {6, 6}, {9, 9}}));
  const auto out = thin(tracks, 3);
  EXPECT_THAT(xs(out), ElementsAre(3, 6, 9));
  EXPECT_THAT(std::vector(out.frame().begin(), out.frame().end()), ElementsAre(0, 1, 2));
  EXPECT_DOUBLE_EQ(out.dt(), 0.3);
  EXPECT_DOUBLE_EQ(out.time(2), tracks.time(9));
}

TEST(Clean, StrideKeepsEpisodesApart) {
  const auto tracks = read("# episodes: 4\nid,frame,x,y\na,0,0,0\na,2,2,0\na,4,9,0\na,6,9,0\n", {.fps = 1, .unit = "m"});
  const auto out = thin(tracks, 2);
  EXPECT_THAT(std::vector(out.episodes().begin(), out.episodes().end()), ElementsAre(2));
  EXPECT_EQ(out.next()[1], -1);
  EXPECT_EQ(out.next()[0], 1);
}

TEST(Clean, OnlySomeIndividuals) {
  const auto tracks = film(line({{0, 0}, {1, 1}}) + line({{0, 5}}, "b") + line({{0, 7}, {1, 8}, {2, 9}}, "c"));
  EXPECT_THAT(only(tracks, {"c", "a"}).names(), ElementsAre("a", "c"));
  EXPECT_THAT(xs(only(tracks, {"c"})), ElementsAre(7, 8, 9));
  EXPECT_THAT(refusal([&] { only(tracks, {"d"}); }), HasSubstr("is called 'd'; expected some of a, b, c"));
  EXPECT_THAT(longer_than(tracks, 1).names(), ElementsAre("a", "c"));
  EXPECT_EQ(last_note(longer_than(tracks, 1)), "1 individual was left out: seen in 1 frames or fewer");
  EXPECT_THAT(refusal([&] { longer_than(tracks, 3); }), HasSubstr("no individual in f.csv is seen in more than 3 frames; expected fewer"));
}

TEST(Clean, NothingAskedNothingDone) {
  const auto tracks = film(line({{0, 0}, {1, 1}}));
  EXPECT_EQ(clean(tracks, {}).meta().from.notes, tracks.meta().from.notes);
}

std::string stamped(const std::vector<double>& times, double (*x)(double)) {
  std::string out = "id,t,x,y\n";
  for (const double t : times) out += fmt::format("a,{},{},1\n", t, x(t));
  return out;
}

// What moves evenly is on its line at every moment, however irregular the times.
TEST(Resample, IrregularTimesOfEvenMotion) {
  const std::vector<double> times = {100.13, 100.71, 101.02, 101.55, 102.2, 102.9, 103.31};
  const auto bytes = stamped(times, [](double t) { return 3 * t - 300; });
  const auto out = read(bytes, {.unit = "m", .resample = 4});
  EXPECT_EQ(out.dt(), 0.25);
  ASSERT_EQ(out.rows(), 13);  // 100.25 to 103.25
  for (Index row = 0; row < out.rows(); ++row) {
    const double t = out.time(out.frame()[static_cast<std::size_t>(row)]);
    EXPECT_NEAR(t, 100.25 + 0.25 * static_cast<double>(row), 1e-12);
    EXPECT_NEAR(out.pos()(row, 0), 3 * t - 300, 1e-4) << "within the fine grid";
  }
  EXPECT_THAT(out.meta().from.notes,
              Contains(StartsWith("resampled to 4 frames per second by linear interpolation: 13 rows of 7; 0 holes")));
}

TEST(Resample, NothingIsMadeUpInHoles) {
  const auto out = read("id,frame,x,y\na,0,0,0\na,1,1,0\na,2,2,0\na,5,5,0\na,6,6,0\n", {.fps = 10, .unit = "m", .resample = 20});
  std::vector<std::int64_t> frames(out.frame().begin(), out.frame().end());
  EXPECT_THAT(frames, ElementsAre(0, 1, 2, 3, 4, 10, 11, 12));
  EXPECT_THAT(xs(out), ElementsAre(0, 0.5, 1, 1.5, 2, 5, 5.5, 6));
  EXPECT_EQ(
      read("id,frame,x,y\na,0,0,0\na,1,1,0\na,2,2,0\na,5,5,0\na,6,6,0\n", {.fps = 10, .unit = "m", .resample = 20, .fill_gaps = 5}).rows(),
      13);
}

// A chord of a sine of angular frequency w is off by at most (w d)^2 / 8 of its amplitude.
TEST(Resample, ErrorOfTheChord) {
  std::string rows;
  for (int k = 0; k <= 200; ++k) rows += fmt::format("a,{},{},0\n", k, std::sin(0.3 * k / 10.0 * 2 * std::numbers::pi));
  const auto out = read("id,frame,x,y\n" + rows, {.fps = 10, .unit = "m", .resample = 23});
  const double w = 2 * std::numbers::pi * 0.3, most = w * w * 0.01 / 8;
  double worst = 0;
  for (Index row = 0; row < out.rows(); ++row)
    worst = std::max(worst, std::abs(out.pos()(row, 0) - std::sin(w * out.time(out.frame()[static_cast<std::size_t>(row)]))));
  EXPECT_LE(worst, most * 1.001);
  EXPECT_GE(worst, most * 0.5);
}

TEST(Resample, TheSameRateChangesNothing) {
  const std::string rows = "id,frame,x,y\na,0,0.1,0\na,1,1.7,0\na,2,2,0\nb,1,3,4\nb,2,1,1\n";
  const auto plain = read(rows, {.fps = 30, .unit = "m"}), out = read(rows, {.fps = 30, .unit = "m", .resample = 30});
  EXPECT_TRUE((plain.pos() == out.pos()).all());
  EXPECT_TRUE(std::ranges::equal(plain.frame(), out.frame()));
}

TEST(Resample, NeverAcrossEpisodes) {
  const auto out = read("# episodes: 2\nid,frame,x,y\na,0,0,0\na,1,1,0\na,2,9,0\na,3,9,0\n", {.fps = 1, .unit = "m", .resample = 2});
  EXPECT_THAT(xs(out), ElementsAre(0, 0.5, 1, 9, 9, 9));
  EXPECT_THAT(std::vector(out.episodes().begin(), out.episodes().end()), ElementsAre(4));
}

TEST(Resample, RatesBeyondSenseAreRefused) {
  EXPECT_THAT(error_of("id,frame,x,y\na,0,0,0\na,1,1,0\n", {.fps = 1e-9, .unit = "m", .resample = 1e9}),
              HasSubstr("expected a lower rate"));
  EXPECT_THAT(error_of("id,t,x,y\na,0,0,0\na,1,1,0\na,1e12,1,0\n", {.unit = "m", .resample = 1e6}), HasSubstr("expected"));
  EXPECT_THAT(error_of("id,frame,x,y\na,0,0,0\n", {.fps = 1, .unit = "m", .resample = -1}), HasSubstr("expected a number above 0"));
}

TEST(Resample, TimesBeyondCountingAreNoFrames) {
  const std::string rows = "id,t,x,y\na,1,0,0\na,2,1,0\na,3,1,0\na,1e30,1,0\n";
  EXPECT_THAT(error_of(rows, {.unit = "m", .time_unit = "s"}), HasSubstr("more frames than can be counted; expected"));
  EXPECT_THAT(error_of(rows, {.unit = "m", .time_unit = "s", .resample = 1}),
              HasSubstr("too long for `resample` 1; expected a lower rate"));
}

}  // namespace
}  // namespace swarmfit
