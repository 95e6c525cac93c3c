// SPDX-License-Identifier: MIT
// What happens to rows of any format on their way to Tracks.
#include <gmock/gmock.h>

#include <cmath>

#include "tests/track/build.h"

namespace swarmfit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::int64_t> frames_of(const Tracks& tracks, std::uint32_t track = 0) {
  std::vector<std::int64_t> out;
  for (const Index row : tracks.rows_of(track)) out.push_back(tracks.frame()[static_cast<std::size_t>(row)]);
  return out;
}

const std::string kHead = "id,frame,x,y\n";

TEST(Assemble, CleanRowsNeedNoNote) { EXPECT_THAT(read(kHead + "1,5,1,2\n1,6,1,2\n", flags()).meta().from.notes, IsEmpty()); }

TEST(Assemble, Provenance) {
  const auto from = read("id,frame,x,y\n1,0,1,2\n1,1,1,2\n", flags()).meta().from;
  EXPECT_EQ(from.path, "f.csv");
  EXPECT_EQ(from.format, "text");
  EXPECT_EQ(from.columns, "id=id,frame=frame,x=x,y=y");
  // printf 'id,frame,x,y\n1,0,1,2\n1,1,1,2\n' | sha256sum
  EXPECT_EQ(from.sha256, "cf33198cca69a1b472762e2320aec8cdc21f6afe223b1f150c85faec541b8732");
  EXPECT_FALSE(from.synthetic);
}

TEST(Assemble, TheUsedMappingReadsTheFileAgain) {
  const std::string text = "object;time;XSplined;YSplined\na;0;1;2\na;0.5;3;4\n";
  const auto once = read(text, {.columns = "id=object,t=time,x=XSplined,y=YSplined", .unit = "m"});
  const auto twice = read(text, {.columns = once.meta().from.columns, .unit = "m"});
  EXPECT_TRUE((once.pos() == twice.pos()).all());
}

TEST(Assemble, FrameNumbersStayAsInTheFile) {
  const auto tracks = read(kHead + "1,-3,1,2\n1,-2,1,2\n1,0,1,2\n", flags());
  EXPECT_THAT(frames_of(tracks), ElementsAre(-3, -2, 0));
  EXPECT_EQ(tracks.dt(), 0.1);
  EXPECT_THAT(tracks.next(), ElementsAre(1, -1, -1)) << "a gap stays a gap";
}

TEST(Assemble, FrameNumbersWinOverTimesInNumbering) {
  const auto tracks = read("id,frame,t,x,y\n1,100,2.00,1,2\n1,101,2.04,1,2\n1,103,2.12,1,2\n", {.unit = "m"});
  EXPECT_THAT(frames_of(tracks), ElementsAre(100, 101, 103));
  EXPECT_EQ(tracks.dt(), 0.04);
  EXPECT_NEAR(tracks.time(100), 2, 1e-12);
}

TEST(Assemble, JitterIsReported) {
  const auto tracks = read("id,t,x,y\n1,0,1,2\n1,1.1,1,2\n1,2,1,2\n1,3,1,2\n1,4,1,2\n", {.unit = "m"});
  EXPECT_THAT(frames_of(tracks), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(tracks.meta().from.notes, ElementsAre(HasSubstr("time stamps were binned to the frame interval")));
}

TEST(Assemble, FpsWithinOnePerCentIsAccepted) {
  const auto tracks = read("id,t,x,y\n1,0,1,2\n1,0.1,1,2\n", {.fps = 10.05, .unit = "m"});
  EXPECT_EQ(tracks.dt(), 0.1) << "the time column is the better witness";
}

TEST(Assemble, OneMomentWithFps) {
  const auto tracks = read("id,t,x,y\n1,0.3,1,2\n2,0.3,1,2\n", {.fps = 10, .unit = "m"});
  EXPECT_THAT(frames_of(tracks), ElementsAre(3));
  EXPECT_NEAR(tracks.time(3), 0.3, 1e-15);
}

TEST(Assemble, ExactRepetitionsAreDroppedAndCounted) {
  const auto tracks = read(kHead + "1,0,1,2\n1,0,1,2\n1,1,1,2\n1,1,1,2\n", flags());
  EXPECT_EQ(tracks.rows(), 2);
  EXPECT_THAT(tracks.meta().from.notes, ElementsAre("2 rows are exact repetitions of an earlier one (first at f.csv:3) and were dropped"));
}

TEST(Assemble, RowsOutOfOrderWithinATrackAreSortedAndCounted) {
  const auto tracks = read(kHead + "1,0,1,2\n1,2,3,2\n1,1,2,2\n2,0,1,2\n", flags());
  EXPECT_THAT(frames_of(tracks), ElementsAre(0, 1, 2));
  EXPECT_THAT(tracks.meta().from.notes,
              ElementsAre("time goes backwards within a track at 1 place (first at f.csv:4); the rows were sorted by time"));
}

TEST(Assemble, AFileByFrameIsInOrder) {
  EXPECT_THAT(read(kHead + "1,0,1,2\n2,0,1,2\n1,1,1,2\n2,1,1,2\n", flags()).meta().from.notes, IsEmpty());
}

TEST(Assemble, FramesInStepsOfTen) {
  const auto tracks = read(kHead + "1,3,1,2\n1,13,1,2\n1,23,1,2\n1,43,1,2\n", {.fps = 100, .unit = "m"});
  EXPECT_THAT(frames_of(tracks), ElementsAre(0, 1, 2, 4));
  EXPECT_DOUBLE_EQ(tracks.dt(), 0.1);
  EXPECT_DOUBLE_EQ(tracks.time(0), 0.03);
  EXPECT_THAT(tracks.meta().from.notes, ElementsAre("frame numbers advance in steps of 10: they were divided by 10, one step being 0.1 s"));
}

const std::string kTen = [] {
  std::string text = kHead;
  for (int k = 0; k < 10; ++k) text += "1," + std::to_string(k) + "," + std::to_string(k) + ",0\n";
  return text + "2,0,1,1\n";
}();

TEST(Select, FramesAreInclusive) {
  auto options = flags();
  options.frames = Interval{3, 5};
  const auto tracks = read(kTen, options);
  EXPECT_THAT(frames_of(tracks), ElementsAre(3, 4, 5));
  EXPECT_THAT(tracks.names(), ElementsAre("1")) << "individuals outside the selection are not there";
}

TEST(Select, TimesAreInclusiveInSpiteOfRounding) {
  auto options = flags();
  options.times = Interval{0.3, 0.7};  // 3 * 0.1 > 0.3 in floating point
  EXPECT_THAT(frames_of(read(kTen, options)), ElementsAre(3, 4, 5, 6, 7));
}

TEST(Select, BothTogether) {
  auto options = flags();
  options.times = Interval{0.3, 0.7};
  options.frames = Interval{5, 100};
  EXPECT_THAT(frames_of(read(kTen, options)), ElementsAre(5, 6, 7));
}

TEST(Select, AFaultOutsideTheSelectionDoesNotMatter) {
  auto options = flags();
  options.frames = Interval{0, 5};
  EXPECT_EQ(read(kTen + "1,9,77,77\n", options).rows(), 7);
  EXPECT_THAT(error_of(kTen + "1,9,77,77\n", flags()), HasSubstr("has another row for frame 9"));
}

TEST(FillGaps, StraightLinesUpToTheLimit) {
  auto options = flags("id,frame,x,y,z,vx,vy,vz");
  options.fill_gaps = 2;
  const auto tracks = read("1,0,0,0,0,1,0,0\n1,3,3,6,9,4,0,0\n1,7,0,0,0,0,0,0\n2,9,5,5,5,0,0,0\n", options);
  EXPECT_THAT(frames_of(tracks), ElementsAre(0, 1, 2, 3, 7));
  const auto rows = tracks.rows_of(0);
  for (int k = 0; k <= 3; ++k) {
    EXPECT_DOUBLE_EQ(tracks.pos()(rows[static_cast<std::size_t>(k)], 1), 2 * k);
    EXPECT_DOUBLE_EQ(tracks.pos()(rows[static_cast<std::size_t>(k)], 2), 3 * k);
    EXPECT_DOUBLE_EQ(tracks.vel()(rows[static_cast<std::size_t>(k)], 0), 1 + k);
  }
  EXPECT_THAT(tracks.meta().from.notes, ElementsAre("2 missing rows in 1 gap of at most 2 frames were filled by linear interpolation"));
}

TEST(FillGaps, NeverAcrossEpisodes) {
  const std::string text = "# unit: m\n# fps: 10\n# episodes: 2\n" + kHead + "1,0,0,0\n1,2,2,0\n1,4,4,0\n";
  const auto tracks = read(text, {.fill_gaps = 5});
  EXPECT_THAT(frames_of(tracks), ElementsAre(0, 2, 3, 4));
}

TEST(FillGaps, NothingUnlessAsked) {
  const auto tracks = read(kHead + "1,0,0,0\n1,2,2,0\n1,3,3,0\n", flags());
  EXPECT_THAT(frames_of(tracks), ElementsAre(0, 2, 3));
}

}  // namespace
}  // namespace swarmfit
