// SPDX-License-Identifier: MIT
// NumPy arrays, TRex, and recordings packed by gzip and zip.
#include <gmock/gmock.h>

#include <malloc.h>

#include <limits>

#include "tests/track/build.h"
#include "tests/track/packed_make.h"

namespace swarmfit {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

constexpr double kInf = std::numeric_limits<double>::infinity();
const std::string kCsv = "id,frame,x,y\n1,0,1,2\n1,1,3,4\n";

std::vector<std::int64_t> frames_of(const Tracks& tracks) { return {tracks.frame().begin(), tracks.frame().end()}; }

TEST(Numpy, TableOfRows) {
  const auto bytes = npy({3, 4}, {7, 0, 1.5, 4, 7, 1, 2.5, 5, 8, 0, 3.5, 6});
  const auto tracks = read(bytes, flags("id,frame,x,y"));
  EXPECT_EQ(tracks.meta().from.format, "numpy");
  EXPECT_THAT(tracks.names(), ElementsAre("7", "8"));
  EXPECT_EQ(tracks.pos()(1, 0), 3.5);
  EXPECT_THAT(error_of(bytes, flags()), HasSubstr("nothing says what the 4 columns are; expected `columns`"));
}

// Frames x individuals x axes, and the same array with the first index running fastest and in 4-byte numbers of the other byte order.
TEST(Numpy, PositionsByFrameAndIndividual) {
  const auto bytes = npy({3, 2, 2}, {0, 1, 10, 11, 2, 3, kInf, 13, 4, 5, 14, 15});
  const auto tracks = read(bytes, flags("frame,id,x,y"));
  ASSERT_EQ(tracks.rows(), 5) << "individual 1 is not seen in frame 1";
  EXPECT_THAT(frames_of(tracks), ElementsAre(0, 0, 1, 2, 2));
  EXPECT_EQ(tracks.pos()(4, 1), 15);
  const auto turned = read(bytes, flags("id,frame,x,y"));
  EXPECT_EQ(turned.track_count(), 3);
  EXPECT_EQ(turned.frames().size(), 2);
  EXPECT_THAT(error_of(bytes, flags()), HasSubstr("the array is 3 x 2 x 2; expected `columns` frame,id,x,y or id,frame,x,y"));

  std::string data;
  for (const int axis : {0, 1})
    for (const int animal : {0, 1})
      for (const int frame : {0, 1, 2}) data += {0, 0, 0, static_cast<char>(100 * axis + 10 * animal + frame)};
  const auto swapped = read(npy({3, 2, 2}, ">i4", data, true), flags("frame,id,x,y"));
  EXPECT_EQ(swapped.pos()(5, 0), 12) << "animal 1 in frame 2";
  EXPECT_EQ(swapped.pos()(5, 1), 112);
}

// What was opened before the damage was found once stayed open, and so was its memory lost.
TEST(Numpy, ADamagedArchiveIsClosed) {
  std::string bytes = zipped({{"x.npy", npy({2}, {1, 2})}, {"y.npy", npy({2}, {5, 6})}});
  bytes[bytes.rfind("PK\1\2")] = '?';
  const auto refused = [&] { return error_of(bytes, flags()); };
  EXPECT_THAT(refused(), HasSubstr("the zip archive cannot be read; expected an undamaged file"));
  const auto before = mallinfo2().uordblks;
  for (int k = 0; k < 100; ++k) static_cast<void>(refused());
  EXPECT_LT(mallinfo2().uordblks, before + 20'000);
}

TEST(Numpy, OneArrayPerColumn) {
  const auto bytes =
      zipped({{"id.npy", npy({2}, {3, 3})}, {"frame.npy", npy({2}, {0, 1})}, {"x.npy", npy({2}, {1, 2})}, {"y.npy", npy({2}, {5, 6})}});
  EXPECT_EQ(read(bytes, flags()).pos()(1, 1), 6);
  EXPECT_EQ(read(bytes, flags("id=id,frame=frame,x=y,y=x")).pos()(1, 1), 2);
  EXPECT_THAT(error_of(zipped({{"a.npy", npy({2}, {3, 3})}, {"b.npy", npy({2}, {0, 1})}}), flags()),
              HasSubstr("no array is x or y among a (2), b (2)"));
}

TEST(Numpy, ChoosingAnArray) {
  const auto bytes = zipped({{"a.npy", npy({1, 4}, {1, 0, 2, 3})}, {"b.npy", npy({2, 4}, {1, 0, 2, 3, 1, 1, 2, 3})}});
  EXPECT_THAT(error_of(bytes, flags("id,frame,x,y")),
              HasSubstr("several could hold positions among its arrays a (1 x 4), b (2 x 4); expected `var` NAME"));
  EXPECT_EQ(read(bytes, {.columns = "id,frame,x,y", .fps = 1, .unit = "m", .variable = "b"}).rows(), 2);
  EXPECT_THAT(error_of(bytes, {.columns = "id,frame,x,y", .fps = 1, .unit = "m", .variable = "c"}), HasSubstr("there is no array 'c'"));
}

TEST(Numpy, FaultsAreNamed) {
  EXPECT_THAT(error_of(zipped({{"a.npy", npy({2, 3}, "|O", "")}})), HasSubstr("is a Python pickle; expected numbers"));
  EXPECT_THAT(error_of(npy({2, 3}, "<c16", "")), HasSubstr("is of type '<c16'; expected real numbers"));
  EXPECT_THAT(error_of(npy({1'000'000'000, 1'000'000'000, 1'000'000'000}, "<f8", "12345678")), HasSubstr("more than are there"));
  EXPECT_THAT(error_of(npy({0, 4}, "<f8", ""), flags("id,frame,x,y")), HasSubstr("the array is empty"));
  const auto good = npy({2, 4}, {1, 0, 2, 3, 1, 1, 2, 3});
  for (std::size_t size = 6; size < good.size(); ++size)
    EXPECT_THAT(error_of(good.substr(0, size), flags("id,frame,x,y")), StartsWith("f.csv: ")) << size;
}

std::string trex(const std::vector<double>& time) {
  return zipped({{"frame.npy", npy({4}, {0, 1, 2, 3})},
                 {"time.npy", npy({4}, time)},
                 {"missing.npy", npy({4}, {0, 1, 0, 0})},
                 {"X.npy", npy({4}, {1, kInf, 3, 4})},
                 {"Y.npy", npy({4}, {1, kInf, 3, 4})},
                 {"X#wcentroid.npy", npy({4}, {10, kInf, 30, 40})},
                 {"Y#wcentroid.npy", npy({4}, {11, kInf, 31, 41})}});
}

TEST(Trex, OneIndividualPerFile) {
  const auto tracks = read_tracks_bytes("videos/shoal_fish7.npz", trex({0, 0.04, 0.08, 0.12}), {});
  EXPECT_EQ(tracks.meta().from.format, "trex");
  EXPECT_EQ(tracks.meta().unit, "cm");
  EXPECT_THAT(tracks.names(), ElementsAre("fish7"));
  EXPECT_NEAR(tracks.dt(), 0.04, 1e-9);
  EXPECT_THAT(frames_of(tracks), ElementsAre(0, 2, 3));
  EXPECT_EQ(tracks.pos()(2, 0), 40);
  EXPECT_EQ(read(trex({0, 0.04, 0.08, 0.12}), {.node = "head"}).pos()(2, 0), 4);
}

// The video skips ten images: frame numbers go on, times do not.
TEST(Trex, SkippedImagesAreAGap) { EXPECT_THAT(frames_of(read(trex({0, 0.04, 0.08, 0.52}))), ElementsAre(0, 2, 13)); }

TEST(Packed, GzipAndZip) {
  const auto plain = read(kCsv, flags());
  for (const auto& bytes : {gzipped(kCsv), zipped({{"data/run.csv", kCsv}}), gzipped(kCsv.substr(0, 20)) + gzipped(kCsv.substr(20))}) {
    const auto tracks = read(bytes, flags());
    EXPECT_EQ(tracks.rows(), 2);
    EXPECT_TRUE((tracks.pos() == plain.pos()).all());
    EXPECT_NE(tracks.meta().from.sha256, plain.meta().from.sha256) << "the file that was given is what was hashed";
    EXPECT_THAT(tracks.meta().from.notes, Contains(StartsWith("the file was unpacked")));
  }
}

TEST(Packed, WhichOfSeveral) {
  const auto bytes = zipped({{"a.csv", kCsv}, {"b.csv", kCsv}});
  EXPECT_EQ(error_of(bytes, flags()), "f.csv: the zip archive holds a.csv, b.csv; expected one recording, or `var` NAME to choose one");
  EXPECT_EQ(read(bytes, {.fps = 1, .unit = "m", .variable = "b.csv"}).rows(), 2);
}

TEST(Packed, BombsAndDamage) {
  const std::string zeros(80 << 20, '0');
  EXPECT_THAT(error_of(gzipped(zeros)), HasSubstr("it unpacks to more than"));
  EXPECT_THAT(error_of(zipped({{"a.csv", zeros}})), HasSubstr("it unpacks to more than"));
  EXPECT_THAT(error_of(gzipped(gzipped(kCsv))), HasSubstr("expected one, packed once"));
  for (const auto& good : {gzipped(kCsv), zipped({{"a.csv", kCsv}})})
    for (std::size_t size = 4; size + 4 < good.size(); ++size)  // zip ends with the length of a comment
      EXPECT_THAT(error_of(good.substr(0, size), flags()), StartsWith("f.csv: ")) << size;
  auto wrong = zipped({{"a.csv", kCsv}});
  wrong[45] ^= 1;  // in the packed bytes
  EXPECT_THAT(error_of(wrong, flags()), HasSubstr("cannot be unpacked"));
}

}  // namespace
}  // namespace swarmfit
