// SPDX-License-Identifier: MIT
// Small oddities of files that must not be read wrongly without a word. Each is a kind; the files are made by hand.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "libtrack/read/plain_text.h"
#include "libtrack/read/units.h"
#include "tests/track/build.h"

namespace swarmfit {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::int64_t> frames_of(const Tracks& tracks) { return {tracks.frame().begin(), tracks.frame().end()}; }

const std::string kHead = "id,frame,x,y\n";

// Two individuals in the frames 0 to n - 1, at (10 id + frame, id); row(id, frame) writes one.
template <class Row>
std::string rows(int n, Row&& row) {
  std::string out;
  for (int id = 1; id <= 2; ++id)
    for (int frame = 0; frame < n; ++frame) out += row(id, frame);
  return out;
}

std::string plain_row(int id, int frame) { return fmt::format("{},{},{},{}\n", id, frame, 10 * id + frame, id); }

void expect_two_tracks(const Tracks& tracks, int n) {
  ASSERT_EQ(tracks.rows(), 2 * n);
  EXPECT_EQ(tracks.track_count(), 2u);
  for (Index i = 0; i < tracks.rows(); ++i) {
    const auto id = static_cast<double>(tracks.track()[static_cast<std::size_t>(i)]) + 1;
    EXPECT_EQ(tracks.pos()(i, 0), 10 * id + static_cast<double>(tracks.frame()[static_cast<std::size_t>(i)]));
    EXPECT_EQ(tracks.pos()(i, 1), id);
  }
}

TEST(ReadRightly, UnitsOfTimeInTheHeader) {
  const auto dt = [](const std::string& name, double step) {
    const auto text = "id," + name + ",x,y\n" + rows(5, [&](int id, int f) { return fmt::format("{},{},1,2\n", id, f * step); });
    return read(text, {.unit = "m"}).dt();
  };
  for (const auto* name : {"t", "time [s]", "Time (sec)", "seconds"}) EXPECT_DOUBLE_EQ(dt(name, 0.04), 0.04) << name;
  for (const auto* name : {"t [ms]", "Time (msec)", "time [milliseconds]", "time_ms", "timestamp/ms"})
    EXPECT_DOUBLE_EQ(dt(name, 40), 0.04) << name;
  for (const auto* name : {"t [us]", "time [\xC2\xB5s]", "time [\xB5s]", "time (microseconds)"})
    EXPECT_DOUBLE_EQ(dt(name, 40e3), 0.04) << name;
  EXPECT_DOUBLE_EQ(dt("timestamp [ns]", 40e6), 0.04);
  EXPECT_DOUBLE_EQ(dt("time (minutes)", 2), 120);
  EXPECT_DOUBLE_EQ(dt("t [h]", 2), 7200);
}

TEST(ReadRightly, TimeUnitByFlag) {
  const auto text = "id,t,x,y\n" + rows(5, [](int id, int f) { return fmt::format("{},{},1,2\n", id, 1600000000000 + 40LL * f); });
  EXPECT_NEAR(read(text, {.unit = "m", .time_unit = "ms"}).dt(), 0.04, 1e-9);
}

TEST(ReadRightly, TimeUnitsThatAreMultiples) {
  const auto dt = [&](int step, const std::string& unit) {
    const std::string table = fmt::format("t,x,y\n{},1,2\n{},1,3\n{},1,2\n", 1747200, 1747200 + step, 1747200 + 2 * step);
    return read(table, {.unit = "m", .time_unit = unit}).dt();
  };
  EXPECT_DOUBLE_EQ(dt(20, "0.01s"), 0.2);
  EXPECT_DOUBLE_EQ(dt(20, "10 ms"), 0.2);
  EXPECT_DOUBLE_EQ(dt(1, "0.5 min"), 30);
  EXPECT_DOUBLE_EQ(dt(1, "1e-3 s"), 0.001);
  for (const auto* wrong : {"0s", "-1s", "infs", "nans", "1e300s", "5", "5 mm"}) EXPECT_FALSE(scaled_time_unit(wrong)) << wrong;
}

TEST(ReadRightly, DaysByFlag) {
  const std::string text = "id,t,x,y\n1,44197.5,1,2\n1,44197.50001,1,2\n1,44197.50002,1,2\n";
  EXPECT_NEAR(read(text, {.unit = "m", .time_unit = "d"}).dt(), 0.864, 1e-5);
}

TEST(ReadRightly, UnitsOfLengthInTheHeader) {
  const auto unit = [](const std::string& x, const std::string& y) {
    return read("id,frame," + x + "," + y + "\n1,0,1,2\n1,1,1,2\n", {.fps = 10}).meta().unit;
  };
  EXPECT_EQ(unit("x_cm", "y_cm"), "cm");
  EXPECT_EQ(unit("X (CM)", "Y (CM)"), "cm");
  EXPECT_EQ(unit("x (metres)", "y (metres)"), "m");
  EXPECT_EQ(unit("x in cm", "y in cm"), "cm");
  EXPECT_EQ(unit("x/mm", "y/mm"), "mm");
  EXPECT_EQ(unit("X#wcentroid (cm)", "Y#wcentroid (cm)"), "cm");
  EXPECT_EQ(unit("Position X [\xB5m]", "Position Y [\xB5m]"), "um");
  EXPECT_EQ(unit("POSITION_X (micron)", "POSITION_Y (micron)"), "um");
  EXPECT_EQ(unit("x [pixels]", "y [pixels]"), "px");
}

TEST(ReadRightly, WordsThatAreNoUnits) {
  EXPECT_EQ(column_name("x_min").name, "x_min");  // of a bounding box
  EXPECT_EQ(column_name("x_in").name, "x_in");
  EXPECT_EQ(column_name("track_id").name, "track_id");
  EXPECT_EQ(column_name("track_min").name, "track_min");
  EXPECT_EQ(column_name("t_s").unit, "");
  EXPECT_FALSE(length_unit("quality"));
  EXPECT_FALSE(time_unit("mm"));
}

TEST(ReadRightly, TheSameUnitInOtherWords) {
  EXPECT_EQ(read("id,frame,x [micron],y [micron]\n1,0,1,2\n1,1,1,2\n", {.fps = 10, .unit = "\xC2\xB5m"}).meta().unit, "\xC2\xB5m");
}

TEST(ReadRightly, AnIdThatIsNewInEveryRowIsNoIndividual) {
  int n = 0;
  const auto text =
      "id,frame,track_id,x,y\n" + rows(4, [&](int id, int f) { return fmt::format("{},{},{},{},{}\n", ++n, f, id, 10 * id + f, id); });
  const auto tracks = read(text, flags());
  expect_two_tracks(tracks, 4);
  EXPECT_THAT(tracks.meta().from.notes, Contains("'track_id' is the individual: 'id' is new in every row and numbers the rows"));
}

TEST(ReadRightly, TwoNamesOfTheSameIndividuals) {
  const auto text =
      "tag_id,bird,frame,x,y\n" + rows(4, [&](int id, int f) { return fmt::format("t{},{},{},{},{}\n", id, id, f, 10 * id + f, id); });
  EXPECT_EQ(read(text, flags()).names(), (std::vector<std::string>{"t1", "t2"}));
}

TEST(ReadRightly, EveryCodeForNotSeen) {
  for (const auto* code : {"inf", "-inf", "NaN", "#N/A", ".", "", "NA", "null", "None", "-"}) {
    const auto tracks = read(kHead + "1,0,1,2\n1,1," + code + "," + code + "\n1,2,1,2\n", flags());
    EXPECT_THAT(frames_of(tracks), ElementsAre(0, 2)) << code;
    EXPECT_THAT(tracks.meta().from.notes, ElementsAre(HasSubstr("1 row without a position"))) << code;
  }
}

TEST(ReadRightly, NumbersThatMayStandForNotSeen) {
  for (const auto* code : {"-1", "0", "-999"}) {
    const auto row = [&](int frame) { return fmt::format("1,{},{},{}\n", frame, code, code); };
    const auto text = kHead + "1,0,1,2\n" + row(1) + "1,2,1,2\n" + row(3) + row(4) + "1,5,1,2\n";
    const auto noted = read(text, flags());
    EXPECT_EQ(noted.rows(), 6);
    EXPECT_THAT(noted.meta().from.notes, Contains(HasSubstr(fmt::format("if that stands for not seen, add --missing {}", code))));
    auto options = flags();
    options.missing = std::stod(code);
    const auto cured = read(text, options);
    EXPECT_THAT(frames_of(cured), ElementsAre(0, 2, 5));
  }
  EXPECT_TRUE(read(kHead + "1,0,0,0\n1,1,0,0\n1,2,1,2\n", flags()).meta().from.notes.empty()) << "twice is no code";
}

TEST(ReadRightly, DecimalCommas) {
  for (const auto* text : {"id;frame;x;y\n1;0;1,5;-0,25\n1;1;2;3\n", "id\tframe\tx\ty\n1\t0\t1,5\t-0,25\n1\t1\t2\t3\n",
                           "id,frame,x,y\n1,0,\"1,5\",\"-0,25\"\n1,1,2,3\n"}) {
    const auto tracks = read(text, flags());
    EXPECT_EQ(tracks.pos()(0, 0), 1.5) << text;
    EXPECT_EQ(tracks.pos()(0, 1), -0.25) << text;
  }
  auto options = flags();
  options.decimal = "comma";
  EXPECT_EQ(read("id\tframe\tx\ty\n1\t0\t1,500\t2,000\n1\t1\t1\t1\n", options).pos()(0, 0), 1.5);
  EXPECT_EQ(read("id\tframe\tx\ty\n1\t0\t1,500\t0,250\n1\t1\t1\t1\n", flags()).pos()(0, 1), 0.25) << "thousands begin with no zero";
}

TEST(ReadRightly, RowNamesOfR) {
  for (const char d : {' ', '\t', ','}) {
    int n = 0;
    auto text = std::string("\"id\" \"frame\" \"x\" \"y\"\n") +
                rows(4, [&](int id, int f) { return fmt::format("\"{}\" {} {} {} {}\n", ++n, id, f, 10 * id + f, id); });
    std::replace(text.begin(), text.end(), ' ', d);
    const auto tracks = read(text, flags());
    expect_two_tracks(tracks, 4);
    EXPECT_THAT(tracks.meta().from.notes, Contains(HasSubstr("row names")));
  }
}

TEST(ReadRightly, TrailingDelimiters) {
  expect_two_tracks(read("id,frame,x,y,\n" + rows(4, plain_row), flags()), 4);
  const auto ended = [](int id, int f) {
    auto row = plain_row(id, f);
    return row.insert(row.size() - 1, ",");
  };
  expect_two_tracks(read(kHead + rows(4, ended), flags()), 4);
  expect_two_tracks(read("id,frame,x,y,\n" + rows(4, ended), flags()), 4);
}

TEST(ReadRightly, LineEndsAndEncodings) {
  const auto text = kHead + rows(4, plain_row);
  std::string cr = text;
  std::replace(cr.begin(), cr.end(), '\n', '\r');
  expect_two_tracks(read(cr, flags()), 4);
  expect_two_tracks(read(text + '\x1A', flags()), 4);
  std::string little = "\xFF\xFE", big = "\xFE\xFF";
  for (const char c : text) {
    little += {c, '\0'};
    big += {'\0', c};
  }
  expect_two_tracks(read(little, flags()), 4);
  expect_two_tracks(read(big, flags()), 4);
}

TEST(ReadRightly, Utf16BeyondTheFirstPlane) {
  using std::string_literals::operator""s;
  EXPECT_EQ(plain_bytes("\xFF\xFE\xB5\x00\x3D\xD8\x00\xDE"s), "\xC2\xB5\xF0\x9F\x98\x80");
  EXPECT_EQ(plain_bytes("\xFF\xFE\x3D\xD8\x41\x00"s), "\xEF\xBF\xBD\x41") << "half of a pair";
}

TEST(ReadRightly, TitleLinesAndRepeatedHeaders) {
  const auto tracks = read("\xEF\xBB\xBF\n Experiment 3 \n =====\n" + kHead + rows(2, plain_row) + kHead + "3,0,1,2\n3,1,1,2\n", flags());
  EXPECT_EQ(tracks.track_count(), 3u);
  EXPECT_THAT(tracks.meta().from.notes, Contains("2 lines of a title above the column names were passed over"));
  EXPECT_THAT(tracks.meta().from.notes, Contains("the header is repeated (first at line 9): the parts were read as one table"));
}

TEST(ReadRightly, ARowOfUnits) {
  const auto tracks = read("\"t\",\"id\",\"name\",\"x\",\"y\"\n\"ms\",\"\",\"\",\"cm\",\"cm\"\n0,1,a,1,2\n40,1,a,1,2\n80,1,a,1,2\n");
  EXPECT_DOUBLE_EQ(tracks.dt(), 0.04);
  EXPECT_EQ(tracks.meta().unit, "cm");
}

TEST(ReadRightly, ClockOverMidnight) {
  const auto text = "id,time,x,y\n" + rows(6, [](int id, int f) {
                      const int s = (86397 + f) % 86400;
                      return fmt::format("{},{:02}:{:02}:{:02},{},{}\n", id, s / 3600, s / 60 % 60, s % 60, 10 * id + f, id);
                    });
  const auto tracks = read(text, {.unit = "m"});
  EXPECT_EQ(tracks.dt(), 1);
  EXPECT_EQ(tracks.frames().size(), 6u);
  EXPECT_EQ(tracks.time(tracks.frames().back().number), 86402);
  EXPECT_THAT(tracks.meta().from.notes, Contains(HasSubstr("the clock passes midnight (first at f.csv:5)")));
}

TEST(ReadRightly, TwoMidnightsNeedADate) {
  std::string text = "id,time,x,y\n";
  for (int hour = 10; hour < 60; hour += 5) text += fmt::format("1,{:02}:00:00,1,2\n", hour % 24);
  EXPECT_THAT(error_of(text, {.unit = "m"}), HasSubstr("the clock times fall back by more than half a day; expected times with a date"));
}

TEST(ReadRightly, HalfDaysZonesAndDates) {
  const auto start = [](const std::string& first, const std::string& second) {
    const auto tracks = read("id,time,x,y\n1," + first + ",1,2\n1," + second + ",1,2\n", {.unit = "m"});
    EXPECT_EQ(tracks.dt(), 1);
    return tracks.time(tracks.frames()[0].number);
  };
  constexpr double noon = 43200, day = 1612051200;  // 2021-01-31
  EXPECT_EQ(start("11:59:59 AM", "12:00:00 PM"), noon - 1);
  EXPECT_EQ(start("12:00:00 am", "12:00:01 am"), 0);
  EXPECT_EQ(start("2021-01-31 12:00:00 UTC", "2021-01-31 12:00:01 UTC"), day + noon);
  EXPECT_EQ(start("20210131T120000Z", "20210131T120001Z"), day + noon);
  EXPECT_EQ(start("31/01/2021 12:00:00", "31/01/2021 12:00:01"), day + noon);
  EXPECT_EQ(start("1/31/2021 12:00:00 PM", "1/31/2021 12:00:01 PM"), day + noon);
  EXPECT_EQ(start("3.1.2021 12:00:00", "3.1.2021 12:00:01"), day - 28 * 86400 + noon) << "dots have the day first";
  EXPECT_THAT(error_of("id,time,x,y\n1,13:00:00 PM,1,2\n", {.unit = "m"}), HasSubstr("is not a time"));
}

TEST(ReadRightly, DatesByFlag) {
  const auto at = [](const char* order) {
    const auto tracks = read("id,time,x,y\n1,3/4/2021 0:00:00,1,2\n1,3/4/2021 0:00:01,1,2\n", {.unit = "m", .dates = order});
    return tracks.time(tracks.frames()[0].number);
  };
  EXPECT_EQ(at("day-first"), 1617408000);
  EXPECT_EQ(at("month-first"), 1614816000);
}

TEST(ReadRightly, DatesInAColumnOfTheirOwn) {
  const auto tracks = read("id,date,time,x,y\n1,31/01/2021,23:59:59,1,2\n1,01/02/2021,0:00:00,1,2\n", {.unit = "m"});
  EXPECT_EQ(tracks.dt(), 1);
  EXPECT_EQ(tracks.time(tracks.frames()[0].number), 1612137599);
}

std::string at_60_hertz(int frames, int without) {
  return "id,t,x,y\n" + rows(frames, [&](int id, int f) {
           return f == without ? std::string() : fmt::format("{},{:.2f},{},{}\n", id, f / 60.0, 10 * id + f, id);
         });
}

TEST(ReadRightly, SixtyHertzWithTwoDecimals) {
  const auto tracks = read(at_60_hertz(60, -1), {.unit = "m"});
  EXPECT_NEAR(tracks.dt(), 1.0 / 60, 1e-6);
  expect_two_tracks(tracks, 60);
}

TEST(ReadRightly, SixtyHertzWithTwoDecimalsAndAHole) {
  EXPECT_THAT(error_of(at_60_hertz(60, 20), {.unit = "m"}),
              HasSubstr("times are written in steps of 0.01 s, too coarsely to tell the frame interval; expected `fps`"));
  const auto tracks = read(at_60_hertz(60, 20), {.fps = 60, .unit = "m"});
  EXPECT_EQ(tracks.frames().size(), 59u);
  EXPECT_EQ(frames_of(tracks).back(), 59);
}

TEST(ReadRightly, HundredHertzWithTwoDecimals) {
  const auto text = "id,t,x,y\n" + rows(50, [&](int id, int f) {
                      return f % 7 == 3 ? std::string() : fmt::format("{},{:.2f},{},{}\n", id, f / 100.0, 10 * id + f, id);
                    });
  EXPECT_DOUBLE_EQ(read(text, {.unit = "m"}).dt(), 0.01) << "a seventh of the frames dropped: gaps stay gaps";
}

TEST(ReadRightly, WholeSecondsBesideFrames) {
  const auto text = "id,frame,time,x,y\n" +
                    rows(60, [](int id, int f) { return fmt::format("{},{},10:00:{:02},{},{}\n", id, f, f / 25, 10 * id + f, id); });
  const auto tracks = read(text, {.fps = 25, .unit = "m"});
  EXPECT_DOUBLE_EQ(tracks.dt(), 0.04);
  expect_two_tracks(tracks, 60);
  EXPECT_THAT(tracks.meta().from.notes, Contains(HasSubstr("the frame numbers count")));
}

TEST(ReadRightly, IrregularTimesOnFramesOfAGivenRate) {
  std::string text = "id,t,x,y\n";
  for (int i = 0; i < 40; ++i) text += fmt::format("1,{},{},2\n", std::pow(i, 1.5), i);
  EXPECT_THAT(error_of(text, {.unit = "m"}), HasSubstr("expected time stamps at a constant interval (`fps` puts them on one)"));
  const auto tracks = read(text, {.fps = 2, .unit = "m"});
  for (Index i = 0; i < 40; ++i) EXPECT_EQ(tracks.frame()[static_cast<std::size_t>(i)], std::llround(2 * std::pow(i, 1.5)));
  EXPECT_THAT(tracks.meta().from.notes, Contains(HasSubstr("rows were put on the nearest frame of 0.5 s, by up to 0.2")));
}

TEST(ReadRightly, EverySecondFrameInTwoPhases) {
  const auto text = kHead + rows(6, [](int id, int f) { return plain_row(id, 2 * f + (id - 1)); });
  EXPECT_THAT(read(text, flags()).meta().from.notes, Contains(HasSubstr("every individual is seen in every 2. frame only")));
}

TEST(ReadRightly, RepeatedPairsOfColumns) {
  for (const auto* head : {"frame,x,y,x,y\n", "frame,x,y,x.1,y.1\n", "frame,x1,y1,x2,y2\n",
                           "frame,X_Arena0_Ind1,Y_Arena0_Ind1,X_Arena0_Ind2,Y_Arena0_Ind2\n"}) {
    std::string text = head;
    for (int f = 0; f < 4; ++f) text += fmt::format("{},{},1,{},2\n", f, 10 + f, 20 + f);
    expect_two_tracks(read(text, flags()), 4);
  }
}

TEST(ReadRightly, PairsThatMayBeIndividualsOrPoints) {
  const std::string text = "frame,nose_x,nose_y,tail_x,tail_y\n0,11,1,21,2\n1,12,1,22,2\n";
  EXPECT_EQ(
      error_of(text, flags()),
      "f.csv:1: there are several pairs of columns x and y: nose, tail; expected `wide` when each is an individual, `node` NAME or `node` "
      "mean when they are points of one");
  auto options = flags();
  options.wide = true;
  EXPECT_EQ(read(text, options).track_count(), 2u);
  options = flags();
  options.node = "mean";
  const auto mean = read(text, options);
  EXPECT_EQ(mean.track_count(), 1u);
  EXPECT_EQ(mean.pos()(0, 0), 16);
}

}  // namespace
}  // namespace swarmfit
