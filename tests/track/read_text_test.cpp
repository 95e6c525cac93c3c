// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include "libtrack/read/text_header.h"
#include "tests/track/build.h"

namespace swarmfit {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

// Two individuals in two frames, however the text is written.
void expect_the_four_rows(const Tracks& tracks) {
  ASSERT_EQ(tracks.rows(), 4);
  EXPECT_THAT(tracks.names(), ElementsAre("1", "2"));
  EXPECT_THAT(std::vector(tracks.frame().begin(), tracks.frame().end()), ElementsAre(0, 0, 1, 1));
  EXPECT_THAT(std::vector(tracks.track().begin(), tracks.track().end()), ElementsAre(0, 1, 0, 1));
  EXPECT_EQ(tracks.dims(), 2);
  for (Index i = 0; i < 4; ++i) {
    EXPECT_EQ(tracks.pos()(i, 0), 1.5 + static_cast<double>(i));
    EXPECT_EQ(tracks.pos()(i, 1), -0.25);
    EXPECT_EQ(tracks.pos()(i, 2), 0);
  }
}

TEST(ReadText, EveryWayOfWritingTheSameRows) {
  const std::string comma = "id,frame,x,y\n1,0,1.5,-0.25\n2,0,2.5,-0.25\n1,1,3.5,-0.25\n2,1,4.5,-0.25\n";
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string out;
    for (const char c : comma) out += std::string(1, c) == from ? to : std::string(1, c);
    return out;
  };
  std::map<std::string, std::string> ways = {
      {"comma", comma},
      {"semicolon", with(",", ";")},
      {"tab", with(",", "\t")},
      {"blank", with(",", " ")},
      {"runs of blanks", with(",", "  \t ")},
      {"comma and blank", with(",", ", ")},
      {"CRLF", with("\n", "\r\n")},
      {"blank at the end of the line", with("\n", " \n")},
      {"no newline at the end", comma.substr(0, comma.size() - 1)},
      {"UTF-8 mark", "\xEF\xBB\xBF" + comma},
      {"UTF-8 mark and CRLF", "\xEF\xBB\xBF" + with("\n", "\r\n")},
      {"# comments and empty lines", "# made by hand\n\n" + with("\n", "\n# a comment\n\n")},
      {"% comments", "% made by hand\n" + with("\n", "\n  % a comment\n")},
      {"quoted header", "\"id\",\"frame\",\"x\",\"y\"" + comma.substr(12)},
      {"quoted numbers", "id,frame,x,y\n\"1\",\"0\",\"1.5\",\"-0.25\"\n2,0,2.5,-0.25\n1,1,3.5,-0.25\n2,1,\"4.5\" ,-0.25\n"},
      {"a quoted column of text",
       "id,name,frame,x,y\n1,\"a,b\",0,1.5,-.25\n2,\"a \"\"b\"\"\",0,2.5,-.25\n1,,1,3.5,-.25\n2,\"\",1,4.5,-.25\n"},
      {"capitals", "ID,Frame,X,Y" + comma.substr(12)},
      {"trackpy", "frame,particle,x,y\n0,1,1.5,-0.25\n0,2,2.5,-0.25\n1,1,3.5,-0.25\n1,2,4.5,-0.25\n"},
      {"trackpy as pandas writes it",
       ",y,x,mass,frame,particle\n0,-0.25,1.5,7,0,1.0\n1,-0.25,2.5,7,0,2.0\n2,-0.25,3.5,7,1,1.0\n3,-0.25,4.5,7,1,2.0\n"},
      {"aliases", "Track ID;Frame Number;Pos X;Pos Y\n1;0;1.5;-0.25\n2;0;2.5;-0.25\n1;1;3.5;-0.25\n2;1;4.5;-0.25\n"},
      {"exponents and signs", "id,frame,x,y\n1,0,+1.5e0,-2.5E-1\n2,0,25e-1,-.25\n1,1,3.5,-0.25\n2,1,+4.5,-0.25\n"},
      {"header in a comment", "# id frame x y\n" + with(",", " ").substr(13)},
      {"rows out of order", "id,frame,x,y\n2,1,4.5,-0.25\n1,0,1.5,-0.25\n1,1,3.5,-0.25\n2,0,2.5,-0.25\n"},
  };
  for (const auto& [name, text] : ways) {
    SCOPED_TRACE(name);
    expect_the_four_rows(read(text, flags()));
  }
}

TEST(ReadText, DelimiterGivenByHand) {
  auto options = flags("id,frame,x,y");
  options.delimiter = '|';
  expect_the_four_rows(read("1|0|1.5|-0.25\n2|0|2.5|-0.25\n1|1|3.5|-0.25\n2|1|4.5|-0.25\n", options));
}

TEST(ReadText, ColumnsByPosition) {
  expect_the_four_rows(read("9,1,0,1.5,-0.25\n9,2,0,2.5,-0.25\n9,1,1,3.5,-0.25\n9,2,1,4.5,-0.25\n", flags("_,id,frame,x,y")));
  // The header is then only skipped, whatever it says.
  expect_the_four_rows(read("y,x,t,u\n1,0,1.5,-0.25\n2,0,2.5,-0.25\n1,1,3.5,-0.25\n2,1,4.5,-0.25\n", flags("id,frame,x,y")));
}

TEST(ReadText, ColumnsByName) {
  const auto tracks =
      read("object,time,XSplined,YSplined\na,0,1,2\na,0.5,3,4\n", {.columns = "id=object,t=TIME,x=xsplined,y=ysplined", .unit = "mm"});
  EXPECT_EQ(tracks.rows(), 2);
  EXPECT_THAT(tracks.names(), ElementsAre("a"));
  EXPECT_EQ(tracks.dt(), 0.5);
  EXPECT_EQ(tracks.meta().from.columns, "id=object,t=time,x=XSplined,y=YSplined");
}

TEST(ReadText, VelocityAccelerationAndKind) {
  const auto tracks = read("id,frame,x,y,z,vx,vy,vz,ax,ay,az,kind\n1,0,1,2,3,4,5,6,7,8,9,2\n", flags());
  EXPECT_EQ(tracks.dims(), 3);
  EXPECT_TRUE((tracks.pos().row(0) == Eigen::Array<double, 1, 3>(1, 2, 3)).all());
  EXPECT_TRUE((tracks.vel().row(0) == Eigen::Array<double, 1, 3>(4, 5, 6)).all());
  EXPECT_TRUE((tracks.acc().row(0) == Eigen::Array<double, 1, 3>(7, 8, 9)).all());
  EXPECT_EQ(tracks.kind(0), 2);
}

TEST(ReadText, AnIncompleteVelocityIsLeftOutWithANote) {
  const auto tracks = read("id,frame,x,y,z,vx,vy\n1,0,1,2,3,4,5\n", flags());
  EXPECT_FALSE(tracks.has_velocity());
  EXPECT_THAT(tracks.meta().from.notes, ElementsAre("the recorded velocity lacks a component and was left out"));
}

TEST(ReadText, TrackNames) {
  // Whole numbers in order of value, text behind them; 7 and 7.0 are one individual, 07 is another.
  const auto tracks =
      read("id,frame,x,y\nbob,0,1,1\n10,0,1,1\n7.0,0,1,1\n7,1,1,1\n07,0,1,1\n4294967299,0,1,1\n\"eve, 2\",0,1,1\n", flags());
  EXPECT_THAT(tracks.names(), ElementsAre("7", "07", "10", "4294967299", "bob", "eve, 2"));
  EXPECT_EQ(tracks.rows_of(0).size(), 2u);
}

TEST(ReadText, FactsInComments) {
  const auto tracks = read("# framerate: 25 fps\n# unit: mm\n# synthetic: yes\nid,frame,x,y\n1,3,1,2\n1,4,1,2\n");
  EXPECT_EQ(tracks.dt(), 0.04);
  EXPECT_EQ(tracks.meta().unit, "mm");
  EXPECT_TRUE(tracks.meta().from.synthetic);
  for (const char* no : {"no", "No", "false", "0"})
    EXPECT_FALSE(
        read(std::string("# framerate: 25 fps\n# unit: mm\n# synthetic: ") + no + "\nid,frame,x,y\n1,3,1,2\n").meta().from.synthetic)
        << no;
  EXPECT_EQ(tracks.frames().front().number, 3);
}

TEST(ReadText, UnitInTheHeader) {
  for (const auto* header : {"id,frame,x [mm],y [mm]", "id,frame,x (mm),y (mm)", "id,frame,x/mm,y/mm"})
    EXPECT_EQ(read(std::string(header) + "\n1,3,1,2\n", {.fps = 10}).meta().unit, "mm") << header;
}

TEST(ReadText, MissingPositionsAreDroppedAndCounted) {
  for (const auto* missing : {"", "-", "NA", "NaN", "nan", "NULL", "None", "\"\""}) {
    const auto tracks = read(std::string("id,frame,x,y\n1,0,1,2\n1,1,") + missing + ",2\n1,2,1,2\n", flags());
    EXPECT_EQ(tracks.rows(), 2) << missing;
    EXPECT_THAT(tracks.meta().from.notes, ElementsAre("1 row without a position was dropped (not seen)")) << missing;
  }
}

TEST(ReadText, RowsOfNobodyAreDroppedAndCounted) {
  const auto tracks = read("id,frame,x,y\n1,0,1,2\n,1,1,2\nNone,1,1,2\n", flags());
  EXPECT_EQ(tracks.rows(), 1);
  EXPECT_THAT(tracks.meta().from.notes, ElementsAre("2 rows without a track id were dropped"));
}

TEST(ReadText, WithoutIdAllRowsAreOneIndividual) {
  const auto tracks = read("t,x,y\n0,1,2\n1,3,4\n", {.unit = "m"});
  EXPECT_EQ(tracks.track_count(), 1u);
  EXPECT_THAT(tracks.meta().from.notes, Contains("the file has no id column: all rows are one individual"));
}

TEST(ReadText, ClockTimesAndDates) {
  const auto clock = read("id,time,x,y\n1,7:00:00,1,2\n1,07:00:01,1,2\n1,07:00:03.00,1,2\n", {.unit = "m"});
  EXPECT_EQ(clock.dt(), 1);
  EXPECT_THAT(clock.frames().front().number, 7 * 3600);
  const auto iso = read("id,timestamp,x,y\n1,1970-01-02 00:00:00,1,2\n1,1970-01-02T00:00:02Z,1,2\n", {.unit = "m"});
  EXPECT_EQ(iso.dt(), 2);
  EXPECT_EQ(iso.time(iso.frames().front().number), 86400);
  const auto split = read("id,date,time,x,y\n1,1970-01-01,23:59:59,1,2\n1,1970-01-02,00:00:00,1,2\n", {.unit = "m"});
  EXPECT_EQ(split.dt(), 1);
  EXPECT_EQ(split.frames().back().number, 86400);
}

TEST(ReadText, PlainTextCanBeForcedOnAPeTrackFile) {
  const std::string text = "# framerate: 25\n# id frame x/m y/m z/m\n1 0 1 2 1.7\n1 1 1 2 1.8\n";
  EXPECT_EQ(read(text).dims(), 2);
  EXPECT_EQ(read(text, {.format = "text"}).dims(), 3);
}

TEST(ReadPeTrack, HeightIsNotMotion) {
  const auto tracks = read("# PeTrack project: a.pet\n# framerate: 16 fps\n# id frame x/cm y/cm z/cm\n4\t7\t1\t2\t176\n4\t8\t3\t4\t176\n");
  EXPECT_EQ(tracks.dims(), 2);
  EXPECT_EQ(tracks.dt(), 1.0 / 16);
  EXPECT_EQ(tracks.meta().unit, "cm");
  EXPECT_EQ(tracks.meta().from.format, "petrack");
  EXPECT_EQ(tracks.meta().from.columns, "id,frame,x,y,_");
  EXPECT_THAT(tracks.meta().from.notes, ElementsAre(HasSubstr("z is the height of the head")));
}

TEST(ReadPeTrack, OlderFilesWithoutHeaderAreKnownByTheirShape) {
  const std::string rows = "1 27 164.8 780.8 168.9\n1 28 164.8 771.9 168.9\n1 29 163.7 762.7 168.9\n";
  EXPECT_EQ(read(rows, {.fps = 16, .unit = "cm"}).meta().from.format, "petrack");
  EXPECT_EQ(error_of(rows), "f.csv: neither frame rate nor length unit is in the file; expected both, for example `fps` 25 `unit` m");
  // Not with commas, not without consecutive frames, not when `columns` says what the columns are.
  EXPECT_THAT(error_of("1,27,1.5,2.5,3.5\n1,28,1.5,2.5,3.5\n1,29,1.5,2.5,3.5\n"), HasSubstr("the file has no header"));
  EXPECT_THAT(error_of("1 27 1.5 2.5 3.5\n2 27 1.5 2.5 3.5\n3 27 1.5 2.5 3.5\n"), HasSubstr("the file has no header"));
  EXPECT_EQ(read(rows, flags("id,frame,x,y,z")).dims(), 3);
}

}  // namespace
}  // namespace swarmfit
