// SPDX-License-Identifier: MIT
// One fault per file; the whole line is compared, because the place and the advice are what the user gets.
#include <gmock/gmock.h>

#include "libtrack/rng.h"
#include "tests/track/build.h"

namespace swarmfit {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

struct Fault {
  const char* what;
  std::string bytes;
  ReadOptions options;
  std::string message;
};

std::string format_list() {
  std::string names;
  for (const auto& format : formats()) names += (names.empty() ? "" : ", ") + std::string(format.name);
  return names;
}

ReadOptions with(void (*change)(ReadOptions&)) {
  auto options = flags();
  change(options);
  return options;
}

std::vector<Fault> faults() {
  const std::string head = "id,frame,x,y\n";
  const std::string good = head + "1,0,1,2\n1,1,1,2\n";
  return {
      {"no bytes", "", {}, "f.csv: the file is empty; expected a recording"},
      {"only comments", "# nothing\n\n", {}, "f.csv: the file is empty; expected rows of numbers"},
      {"only a header", head, flags(), "f.csv:1: there is a header but no row; expected rows of numbers"},
      {"text", head + "1,0,1,2\n1,1,abc,2\n", flags(), "f.csv:3:5: 'abc' is not a number; expected a number"},
      {"text behind a number", head + "1,0,1,2x\n", flags(), "f.csv:2:7: '2x' is not a number; expected a number"},
      {"open quote", head + "1,0,1,\"2\n", flags(), "f.csv:2:7: '\"2' is not a number; expected a number"},
      {"decimal comma and point", "id;frame;x;y\n1;0;1,5;2\n1;1;1.5;2\n", flags(),
       "f.csv:3:5: a decimal point, but a decimal comma in line 2; expected one of them throughout"},
      {"decimal point and comma", "id;frame;x;y\n1;0;1.5;2\n1;1;1,5;2\n", flags(),
       "f.csv:3:5: '1,5' is not a number; expected a decimal point instead of the comma"},
      {"comma that may part thousands", "id\tframe\tx\ty\n1\t0\t1,500\t2,000\n", flags(),
       "f.csv:2: '1,500' may have a decimal comma or one between thousands; expected `decimal` comma, or numbers without commas"},
      {"infinite time", "id,t,x,y\n1,inf,1,2\n", flags(), "f.csv:2:3: the time is not finite; expected seconds"},
      {"too large", head + "1,0,1e999,2\n", flags(), "f.csv:2:5: '1e999' is too large; expected a finite number"},
      {"short row", head + "1,0,1,2\n\n1,1,1\n", flags(), "f.csv:4: 3 columns; expected 4 as in line 2"},
      {"long row", head + "1,0,1,2\n1,1,1,2,3\n", flags(), "f.csv:3: 5 columns; expected 4 as in line 2"},
      {"frame with a fraction", head + "1,0.5,1,2\n", flags(),
       "f.csv:2:3: the frame number 0.5 is not an integer; expected whole frames (a time column is called t)"},
      {"no frame", head + "1,,1,2\n", flags(), "f.csv:2:3: the frame number is missing; expected an integer"},
      {"no time", "id,t,x,y\n1,,1,2\n", flags(), "f.csv:2:3: the time is missing; expected a time in every row"},
      {"wrong clock", "id,t,x,y\n1,10:00:00,1,2\n1,10:61:00,1,2\n", flags(),
       "f.csv:3:3: '10:61:00' is not a time; expected seconds, HH:MM:SS or an ISO 8601 date and time"},
      {"two kinds of time", "id,t,x,y\n1,10:00:00,1,2\n1,7,1,2\n", flags(),
       "f.csv:3:3: the time is a bare number; expected a clock time as in the rows before"},
      {"wrong date", "id,date,t,x,y\n1,2015-02-30,10:00:00,1,2\n", flags(), "f.csv:2:3: '2015-02-30' is not a date; expected YYYY-MM-DD"},
      {"milliseconds since 1970", "id,t,x,y\n1,1600000000000,1,2\n1,1600000000040,1,2\n", flags(),
       "f.csv:2: the time 1600000000000 is too large for seconds, it may be milliseconds since 1970; expected `time-unit`, such as "
       "`time-unit` ms"},
      {"`time-unit`", "id,t,x,y\n1,1,1,2\n", with([](auto& o) { o.time_unit = "weeks"; }),
       "`time-unit`: 'weeks' is not known; expected s, ms, us, ns, min, h or d, or so many of them: 0.01s"},
      {"days", "id,t,x,y\n1,44197.5,1,2\n1,44197.5000005,1,2\n1,44197.500001,1,2\n", flags(),
       "f.csv:2: the time 44197.5 and steps of 5e-07 look like days, not seconds; expected `time-unit`, that is `time-unit` d or s"},
      {"end of summer time", "id,t,x,y\n1,02:59:58,1,2\n1,02:59:59,1,2\n1,02:00:00,1,2\n1,02:00:01,1,2\n", flags(),
       "f.csv:4: the clock falls back by an hour, as where summer time ends; expected times in UTC"},
      {"`time-unit` without effect", "id,t,x,y\n1,10:00:00,1,2\n1,10:00:01,1,2\n", with([](auto& o) { o.time_unit = "ms"; }),
       "`time-unit` ms: f.csv has no bare numbers of time; expected none given"},
      {"`time-unit` against the header", "id,t [ms],x,y\n1,1,1,2\n", with([](auto& o) { o.time_unit = "us"; }),
       "f.csv: the header states another unit of time than `time-unit` us; expected the same or none given"},
      {"two length units", "id,frame,x [mm],y [cm]\n1,0,1,2\n", flags(),
       "f.csv:1: 'x [mm]' is in mm but 'y [cm]' in cm; expected one length unit for all coordinates"},
      {"day or month first", "id,t,x,y\n1,3/4/2021 10:00:00,1,2\n1,3/4/2021 10:00:01,1,2\n", flags(),
       "f.csv:2: dates may have the day or the month first, and none in the file shows which; expected `dates` day-first or `dates` "
       "month-first"},
      {"day and month first", "id,t,x,y\n1,30/4/2021 10:00:00,1,2\n1,4/30/2021 10:00:01,1,2\n", flags(),
       "f.csv:3: the date cannot have the day first; expected dates in one order"},
      {"header and rows", "a,b,c,d\n1,2\n", flags("x=c,y=d"),
       "f.csv:1: the header has 4 names but the first row has 2 columns; expected as many"},
      {"short header", "a,b\n1,2,3,4\n", flags("x=a,y=b"),
       "f.csv:1: the header has 2 names but the first row has 4 columns; expected as many"},
      {"id new in every row", "id,frame,x,y\n1,0,1,2\n2,1,1,2\n3,2,1,2\n", flags(),
       "f.csv: the id is new in every row, so it numbers rows and not individuals; expected `columns` to name the individual "
       "(id=NAME,...)"},
      {"`missing` without effect", good, with([](auto& o) { o.missing = -7; }),
       "`missing` -7: f.csv has no position (-7, -7); expected the value that stands for not seen"},
      {"neither time nor frame", "id,x,y\n1,1,2\n", flags(), "f.csv: there is neither a frame nor a time column; expected frame or t"},
      {"no positions", "id,frame,u\n1,0,2\n", flags(),
       "f.csv:1: no position columns among id, frame, u; expected x and y (`columns` x=NAME,y=NAME,... if they have other names)"},
      {"nobody seen", head + "1,0,,2\n", flags(), "f.csv: no row has a position; expected at least one"},
      {"two claims", "particle,track,frame,x,y\n1,1,0,1,2\n1,1,1,1,2\n1,2,2,1,2\n", flags(),
       "f.csv:1: both 'particle' and 'track' could be the individual, and they disagree; expected `columns` to say which, such as "
       "`columns` "
       "id=track,x=..."},
      {"two claims on x", "id,frame,pos_x,xpos,y\n1,0,1,1,2\n", flags(),
       "f.csv:1: both 'pos_x' and 'xpos' could be x; expected `columns` to say which"},
      {"two row numbers", "id,particle,frame,x,y\n1,1,0,1,2\n2,2,1,1,2\n", flags(),
       "f.csv:1: 'id', 'particle' are new in every row, so they number rows and not individuals; expected `columns` to name the individual "
       "(id=NAME,...)"},
      {"no place on Earth", "id,frame,lon,lat\n1,0,1,2\n1,1,1,92\n", flags(),
       "f.csv:3: longitude 1, latitude 92 is not a place on Earth; expected degrees, latitudes from -90 to 90"},
      {"no header", "1,0,1,2\n1,1,1,2\n", flags(),
       "f.csv:1: the file has no header; expected `columns` to name its 4 columns, such as `columns` id,x,y,z (_ skips one); the first row "
       "is "
       "1,0,1,2"},
      {"unknown unit", good, {.fps = 10}, "f.csv: the length unit is not in the file; expected `unit`, for example `unit` mm"},
      {"unknown rate", good, {.unit = "m"}, "f.csv: the frame rate is not in the file; expected `fps`, for example `fps` 25"},
      {"another unit", "# unit: mm\n" + good, flags(),
       "f.csv: the file states the unit mm but `unit` says m; expected the same or none given"},
      {"another rate", "# fps: 25\n" + good, flags(),
       "f.csv: the file states 25 frames per second but `fps` says 10; expected the same within 1 %, or none given"},
      {"time against `fps`", "id,t,x,y\n1,0,1,2\n1,0.2,1,2\n", flags(),
       "f.csv: the time stamps say 5 frames per second but `fps` says 10; expected the same within 1 %, or none given"},
      {"time against the stated rate",
       "# fps: 10\nid,t,x,y\n1,0,1,2\n1,0.2,1,2\n",
       {.unit = "m"},
       "f.csv: the time stamps say 0.2 s per frame but the file states 0.1 s; expected the same within 1 %"},
      {"one moment",
       "id,t,x,y\n1,7,1,2\n2,7,1,2\n",
       {.unit = "m"},
       "f.csv: all rows have the same time; expected `fps`, for example `fps` 25"},
      {"conflicting rows", head + "1,0,1,2\n2,0,1,2\n1,0,1,3\n", flags(),
       "f.csv:4: individual '1' has another row for frame 0 at f.csv:2; expected one row per individual and frame"},
      {"kind", "id,frame,x,y,kind\n1,0,1,2,256\n", flags(), "f.csv:2: kind 256 is not allowed; expected an integer from 0 to 255"},
      {"`fps` 0", good, with([](auto& o) { o.fps = 0; }), "`fps`: 0 is not a frame rate; expected a number above 0"},
      {"`fill-gaps` -1", good, with([](auto& o) { o.fill_gaps = -1; }), "`fill-gaps`: -1 is negative; expected a number of frames"},
      {"`format`", good, with([](auto& o) { o.format = "xyz"; }), "`format`: 'xyz' is not known; expected one of " + format_list()},
      {"`frames`", good, with([](auto& o) {
         o.frames = Interval{5, 9};
       }),
       "`frames`: no row lies in that range of frames of f.csv; the recording has frames 0 to 1, times 0 to 0.1 s"},
      {"`times`", good, with([](auto& o) {
         o.times = Interval{5, 9};
       }),
       "`times`: no row lies in that range of times of f.csv; the recording has frames 0 to 1, times 0 to 0.1 s"},
      {"`columns`: unknown", good, flags("id,frame,x,q"),
       "`columns`: 'q' is not a known column; expected id, frame, t, x, y, z, vx, vy, vz, ax, ay, az, kind, or _ to skip a column"},
      {"`columns`: twice", good, flags("id,x,x,y"), "`columns`: 'x' is given twice; expected every column once"},
      {"`columns`: no y", good, flags("id,frame,x,_"), "`columns`: 'y' is missing; expected at least x and y"},
      {"`columns`: count", good, flags("id,frame,x,y,z"),
       "`columns`: 5 columns are listed but the file has 4; expected one name per column, _ to skip"},
      {"`columns`: no such name", good, flags("id=id,x=X,y=Y2"), "`columns`: the file has no column 'Y2'; expected one of id, frame, x, y"},
      {"`columns`: names without header", "1,0,1,2\n1,1,1,2\n", flags("id=id,x=x,y=y"),
       "`columns`: names are given but the file has no header; expected a list by position of its 4 columns"},
      {"`columns`: mixed", good, flags("id=id,x,y"),
       "`columns`: 'x' has no '='; expected either a list by position or only entries like x=NAME"},
      {"`columns`: column twice", good, flags("x=x,y=x"), "`columns`: column 'x' is used twice; expected every column once"},
  };
}

TEST(ReadErrors, EveryFaultHasItsLine) {
  for (const auto& fault : faults()) EXPECT_EQ(error_of(fault.bytes, fault.options), fault.message) << fault.what;
}

TEST(ReadErrors, EveryMessageIsOneLine) {
  for (const auto& fault : faults()) EXPECT_EQ(error_of(fault.bytes, fault.options).find('\n'), std::string::npos) << fault.what;
}

TEST(ReadErrors, IrregularTimes) {
  std::string text = "id,t,x,y\n";
  double t = 0;
  for (std::uint32_t i = 0; i < 500; ++i) text += "1," + std::to_string(t += 0.1 + Rng{1}.uniform(Stream::probe, i, 0)) + ",1,2\n";
  EXPECT_THAT(error_of(text, {.unit = "m"}), StartsWith("f.csv: the times have no constant interval: "));
}

TEST(ReadErrors, FilesThatAreNoRecordings) {
  using std::string_literals::operator""s;
  const auto refused = [](const std::string& name, const std::string& bytes, const std::string& part) {
    EXPECT_THAT(error_of(bytes, {}, name), HasSubstr(name + ": " + part)) << name;
  };
  refused("a.npy", "\x80\x04\x95 pickled",
          "is a Python pickle that ends early; expected numbers, texts, tuples, lists, dicts and arrays of NumPy (in Python:");
  refused("a.rtf", "{\\rtf1\\ansi", "is a formatted document (RTF)");
  refused("a.md", "# title\n", "is a Markdown document");
  refused("a.h5", "\x89HDF\r\n\x1a\n", "the HDF5 file cannot be read; expected an undamaged file");
  refused("a.xlsx", "PK\x03\x04zip", "the zip archive cannot be read; expected an undamaged file");
  refused("a.csv.gz", "\x1f\x8b\x08", "gzip cannot unpack it; expected an undamaged file");
  refused("a.bin", "\x01\x02\x00\x03"s, "the format is not known; expected one of " + format_list());
}

TEST(ReadErrors, NoSuchFileAndFolder) {
  const auto message = [](const std::string& path) {
    try {
      read_tracks(path);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(message("/no/such/file.csv"), "/no/such/file.csv: no such file; expected the path of a recording");
  EXPECT_EQ(message("/tmp"), "/tmp: is a folder; expected a file, or `join` to read the files in it as one recording");
}

TEST(ParseInterval, BothEndsMayBeOpen) {
  EXPECT_EQ(parse_interval("frames", "3:7").first, 3);
  EXPECT_EQ(parse_interval("frames", "3:7").last, 7);
  EXPECT_FALSE(parse_interval("times", ":2.5").contains(2.6));
  EXPECT_TRUE(parse_interval("times", ":2.5").contains(-1e300));
  EXPECT_TRUE(parse_interval("frames", "3:").contains(1e300));
}

TEST(ParseInterval, Faults) {
  for (const auto* text : {"", ":", "3", "a:b", "3:7:9", "nan:", "1:x"}) {
    EXPECT_THAT(
        [&] { parse_interval("frames", text); },
        testing::ThrowsMessage<InputError>(std::string("`frames`: '") + text + "' is not a range; expected first:last, first: or :last"));
  }
  EXPECT_THAT([] { parse_interval("times", "7:3"); },
              testing::ThrowsMessage<InputError>("`times`: '7:3' is empty; expected the smaller number first"));
}

}  // namespace
}  // namespace swarmfit
