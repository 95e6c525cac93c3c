// SPDX-License-Identifier: MIT
#include "libtrack/write/write.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <map>

#include "libtrack/file.h"
#include "libtrack/rng.h"
#include "tests/track/build.h"

namespace swarmfit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

// Bits from all over the range of doubles, holes, two dimensions or three.
Tracks awkward(int dims, bool velocity, bool kinds) {
  TrackColumns c;
  c.names = {"2", "10", "#c", "a, \"b\""};  // in the order in which every reader numbers individuals
  const Rng rng{11};
  for (std::int64_t frame = -5; frame < 40; ++frame) {
    for (std::uint32_t track = 0; track < 4; ++track) {
      if (rng.uniform(Stream::probe, static_cast<std::uint64_t>(frame + 5), track) < 0.3) continue;
      c.frame.push_back(frame);
      c.track.push_back(track);
      if (kinds) c.kind.push_back(static_cast<std::uint8_t>(track));
    }
  }
  const auto n = static_cast<Index>(c.frame.size());
  const auto fill = [&](Rows& rows, std::uint32_t draw) {
    rows = Rows::Zero(n, 3);
    for (Index i = 0; i < n; ++i)
      for (int axis = 0; axis < dims; ++axis) {
        const auto u = rng.uniform2(Stream::probe, static_cast<std::uint64_t>(i), static_cast<std::uint32_t>(axis), draw);
        rows(i, axis) = (u[0] - 0.5) * std::pow(10.0, std::floor(600 * (u[1] - 0.5)));
      }
  };
  fill(c.pos, 1);
  c.pos(0, 0) = -0.0;
  c.pos(1, 0) = std::numeric_limits<double>::denorm_min();
  c.pos(2, 0) = std::numeric_limits<double>::max();
  if (velocity) {
    fill(c.vel, 2);
    c.vel(3, 1) = std::numeric_limits<double>::quiet_NaN();
    fill(c.acc, 3);
  }
  c.episodes = {7, 20};
  TrackMeta meta;
  meta.dims = dims;
  meta.dt = 1.0 / 29.97;
  meta.t0 = 0.1234567890123456789;
  meta.unit = "mm";
  meta.from.synthetic = kinds;
  return Tracks(std::move(c), meta);
}

void expect_same_bits(const Rows& a, const Rows& b) {
  ASSERT_EQ(a.rows(), b.rows());
  for (Index i = 0; i < a.size(); ++i) {
    if (std::isnan(a.data()[i])) {
      EXPECT_TRUE(std::isnan(b.data()[i]));
    } else {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(a.data()[i]), std::bit_cast<std::uint64_t>(b.data()[i])) << a.data()[i];
    }
  }
}

TEST(WriteCsv, ReadingBackGivesTheSameBitsWithoutAnyFlag) {
  for (const int dims : {2, 3}) {
    for (const bool more : {false, true}) {
      SCOPED_TRACE(testing::Message() << dims << " " << more);
      const auto before = awkward(dims, more, more);
      const auto after = read(to_csv(before));
      ASSERT_EQ(before.rows(), after.rows());
      expect_same_bits(before.pos(), after.pos());
      expect_same_bits(before.vel(), after.vel());
      expect_same_bits(before.acc(), after.acc());
      EXPECT_TRUE(std::ranges::equal(before.frame(), after.frame()));
      EXPECT_TRUE(std::ranges::equal(before.track(), after.track()));
      EXPECT_TRUE(std::ranges::equal(before.next(), after.next()));
      EXPECT_TRUE(std::ranges::equal(before.episodes(), after.episodes()));
      for (Index i = 0; i < before.rows(); ++i) EXPECT_EQ(before.kind(i), after.kind(i));
      EXPECT_THAT(after.names(), testing::UnorderedElementsAreArray(before.names()));
      EXPECT_EQ(after.dims(), dims);
      EXPECT_EQ(after.dt(), before.dt());
      EXPECT_EQ(after.meta().t0, before.meta().t0);
      EXPECT_EQ(after.meta().unit, "mm");
      EXPECT_EQ(after.meta().from.synthetic, more);
      EXPECT_THAT(after.meta().from.notes, IsEmpty());
      EXPECT_EQ(to_csv(after), to_csv(before));
    }
  }
}

void expect_the_same(const Tracks& before, const Tracks& after) {
  ASSERT_EQ(before.rows(), after.rows());
  expect_same_bits(before.pos(), after.pos());
  expect_same_bits(before.vel(), after.vel());
  expect_same_bits(before.acc(), after.acc());
  EXPECT_TRUE(std::ranges::equal(before.frame(), after.frame()));
  EXPECT_TRUE(std::ranges::equal(before.track(), after.track()));
  EXPECT_TRUE(std::ranges::equal(before.episodes(), after.episodes()));
  for (Index i = 0; i < before.rows(); ++i) EXPECT_EQ(before.kind(i), after.kind(i));
  EXPECT_EQ(before.names(), after.names());
  EXPECT_EQ(before.dt(), after.dt());
  EXPECT_EQ(before.meta().t0, after.meta().t0);
  EXPECT_EQ(before.meta().unit, after.meta().unit);
  EXPECT_EQ(before.meta().from.notes, after.meta().from.notes);
  EXPECT_EQ(before.meta().from.synthetic, after.meta().from.synthetic);
}

TEST(Write, ContainersGiveTheSameBitsBack) {
  for (const int dims : {2, 3}) {
    for (const bool more : {false, true}) {
      const auto before = awkward(dims, more, more);
      expect_the_same(before, read(to_hdf5(before)));
      expect_the_same(before, read(to_npz(before)));
      EXPECT_EQ(to_hdf5(before), to_hdf5(before)) << "no clock in it";
      EXPECT_EQ(to_npz(before), to_npz(before));
    }
  }
}

// JuPedSim's layout holds metres in two dimensions and no velocities.
TEST(Write, JuPedSimGivesTheSameNumbersBack) {
  auto before = awkward(2, false, false);
  EXPECT_THAT([&] { to_jupedsim(before); }, testing::ThrowsMessage<InputError>(HasSubstr("is in mm; expected `scale`, as in 0.01m/mm")));
  EXPECT_THAT([&] { to_jupedsim(awkward(3, false, false)); }, testing::ThrowsMessage<InputError>(HasSubstr("two dimensions")));
  TrackMeta meta = before.meta();
  meta.unit = "m";
  meta.from.notes = {"one", "two"};
  TrackColumns columns = before.columns();
  columns.episodes.clear();
  columns.pos(0, 0) = 0;  // SQLite has no -0
  before = Tracks(std::move(columns), std::move(meta));
  expect_the_same(before, read(to_jupedsim(before)));
}

// Names, units and notes of every odd character, in every format that is written.
TEST(WriteCsv, IndividualsThatAreSeenOnceComeBack) {
  const auto tracks = read("id,frame,x,y\na,0,1,2\nb,1,1,2\nc,2,1,2\nc,2,1,2\n", {.fps = 10, .unit = "m"});
  EXPECT_THAT(read(to_csv(tracks)).names(), testing::ElementsAre("a", "b", "c"));
}

TEST(WriteCsv, TimesOfManyYearsComeBack) {
  const std::string csv = to_csv(read("id,frame,x,y\n1,0,1,2\n1,500,2,3\n1,1000,2,3\n", {.fps = 1e-9, .unit = "m"}));
  EXPECT_DOUBLE_EQ(read(csv).dt(), 5e11 / 500);
}

TEST(Write, OddCharactersComeBack) {
  const std::vector<std::string> odd = {"NA",    "-",   ".",    "nan", "a b",  "#1",  "%x",   "a,b",  "a;b",        "it's",
                                        "\"q\"", "\"",  "a\"b", "\\n", "=1+1", "0x1", "007",  "-1",   "\xC2\xB5m",  "\xF0\x9F\x90\x9F",
                                        "id",    "1e3", "True", "[0]", "{}",   "//",  "null", "12.5", "2021-01-01", "x\\x0a"};
  for (const auto& unit : odd) {
    TrackColumns c;
    std::uint32_t n = 0;
    for (const auto& name : odd) {
      c.names.push_back(name);
      for (std::int64_t frame = 0; frame < 2; ++frame) {
        c.track.push_back(n);
        c.frame.push_back(frame);
      }
      ++n;
    }
    c.pos = Rows::Random(static_cast<Index>(c.frame.size()), 3);
    c.pos.col(2) = 0;
    TrackMeta meta{.dims = 2, .dt = 0.1, .t0 = 0, .unit = unit, .from = {}};
    meta.from.notes = {"note of " + unit};
    const Tracks before(std::move(c), std::move(meta));
    for (const auto& format : written_formats()) {
      if (format.name == "jupedsim" || !format.write) continue;
      SCOPED_TRACE(unit + " as " + std::string(format.name));
      const Tracks after = read(format.write(before));
      EXPECT_EQ(after.meta().unit, unit);
      EXPECT_THAT(after.names(), testing::UnorderedElementsAreArray(odd));
      EXPECT_THAT(after.meta().from.notes, testing::Contains("note of " + unit));
      EXPECT_EQ(after.rows(), before.rows());
    }
  }
}

// A name with a control character is written otherwise, and individuals are counted by the name that is written.
TEST(Write, NamesThatCannotBeWrittenKeepTheirPlace) {
  const auto before = read("id,frame,x,y\n0-0,0,1,1\n0-\x11,0,2,2\n\"a\xFF\",0,3,3\n", {.fps = 1, .unit = "m"});
  EXPECT_THAT(before.names(), testing::ElementsAre("0-0", "0-\\x11", "a\\xff"));
  EXPECT_THAT(before.meta().from.notes, testing::Contains(StartsWith("2 names have blanks around it, control characters")));
  const auto after = read(to_csv(before));
  EXPECT_EQ(after.names(), before.names());
  expect_same_bits(before.pos(), after.pos());
}

TEST(Write, TheEndingNamesTheFormat) {
  EXPECT_EQ(written_format("", "a.h5").name, "hdf5");
  EXPECT_EQ(written_format("", "a.hdf5").name, "hdf5");
  EXPECT_EQ(written_format("", "a.sqlite").name, "jupedsim");
  EXPECT_EQ(written_format("", "a.pvd").name, "vtk");
  EXPECT_EQ(written_format("", "-").name, "csv");
  EXPECT_EQ(written_format("npz", "a.csv").name, "npz");
  EXPECT_THAT([] { written_format("xls", "a"); },
              testing::ThrowsMessage<InputError>(HasSubstr("expected csv, hdf5, npz, jupedsim or vtk")));
}

TEST(WriteVtk, AFileForEveryFrameAndAListOfThem) {
  TrackColumns c;
  c.names = {"a", "b"};
  c.track = {0, 1, 0};
  c.frame = {0, 0, 1};
  c.pos = Rows::Zero(3, 3);
  c.pos.row(0) << 1, 2, 0;
  c.pos.row(1) << 0.1, 0, 0;
  c.pos.row(2) << 1.5, 2, 0;
  const Tracks tracks(std::move(c), {.dims = 2, .dt = 0.5, .t0 = 10, .unit = "m", .from = {}});
  const std::vector<Polyhedron> bodies{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, {{{5, 0, 0}, {6, 0, 0}, {5, 1, 0}}, {{0, 1, 2}}}};
  std::vector<std::string> names;
  std::map<std::string, std::string> files;
  to_vtk({tracks, bodies}, "out/a&b.pvd",
         [&](const std::string& path, const std::string& bytes) { names.push_back(path), files[path] = bytes; });
  EXPECT_THAT(names, ElementsAre("out/a&b/frame000000.vtp", "out/a&b/frame000001.vtp", "out/a&b/bodies.vtp", "out/a&b.pvd"));
  EXPECT_THAT(files["out/a&b.pvd"], HasSubstr("<DataSet timestep=\"10.5\" part=\"0\" file=\"a&amp;b/frame000001.vtp\"/>"));
  EXPECT_THAT(files["out/a&b.pvd"], HasSubstr("<DataSet timestep=\"10\" part=\"1\" file=\"a&amp;b/bodies.vtp\"/>"));
  const std::string& first = files["out/a&b/frame000000.vtp"];
  for (const char* said :
       {"NumberOfPoints=\"2\" NumberOfVerts=\"2\"", "Name=\"position\" NumberOfComponents=\"3\" format=\"ascii\">\n1 2 0 0.1 0 0 \n",
        "Name=\"velocity\" NumberOfComponents=\"3\" format=\"ascii\">\n1 0 0 0 0 0 \n",
        "Name=\"offsets\" NumberOfComponents=\"1\" format=\"ascii\">\n1 2 \n"})
    EXPECT_THAT(first, HasSubstr(said));
  EXPECT_THAT(files["out/a&b/frame000001.vtp"], HasSubstr("\n1 0 0 \n")) << "the last velocity is that of the frame before";
  EXPECT_THAT(files["out/a&b/bodies.vtp"], HasSubstr("\n0 1 2 3 4 5 \n"));
  EXPECT_THAT(files["out/a&b/bodies.vtp"], HasSubstr("\n3 6 \n"));
  EXPECT_THAT([&] { to_vtk({tracks}, "-", [](const std::string&, const std::string&) {}); },
              testing::ThrowsMessage<InputError>(HasSubstr("expected a name that ends on .pvd")));
}

TEST(WriteCsv, TheTextItself) {
  TrackColumns c;
  c.names = {"5"};
  c.track = {0, 0};
  c.frame = {2, 3};
  c.pos = Rows::Zero(2, 3);
  c.pos(1, 0) = 0.1;
  EXPECT_EQ(to_csv(Tracks(c, {.dims = 2, .dt = 0.25, .t0 = 0, .unit = "m", .from = {}})),
            "# unit: m\n# fps: 4\n# frame interval: 0.25 s\n# time of frame 0: 0 s\nid,frame,t,x,y\n5,2,0.5,0,0\n5,3,0.75,0.1,0\n");
}

class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / ("swarmfit_write_test_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string file(const std::string& name) const { return (path_ / name).string(); }
  long entries() const { return std::distance(std::filesystem::directory_iterator(path_), {}); }

 private:
  std::filesystem::path path_;
};

TEST(WriteFile, ReplacesTheWholeFileAndLeavesNothingElse) {
  const Folder folder;
  write_file_atomically(folder.file("a"), "a long first content");
  write_file_atomically(folder.file("a"), "short");
  EXPECT_EQ(read_file(folder.file("a")), "short");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(WriteFile, AFailureKeepsTheOldFileAndLeavesNothingElse) {
  const Folder folder;
  std::filesystem::create_directories(folder.file("a"));
  std::filesystem::create_directories(folder.file("b"));
  EXPECT_THAT([&] { write_file_atomically(folder.file("a"), "x"); }, testing::ThrowsMessage<RunError>(HasSubstr("cannot be written")));
  EXPECT_THAT([&] { write_file_atomically(folder.file("no/such/folder"), "x"); },
              testing::ThrowsMessage<RunError>(HasSubstr("No such file")));
  EXPECT_EQ(folder.entries(), 2);
}

TEST(WriteFile, DevicesAreWrittenDirectly) {
  write_file_atomically("/dev/null", "x");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  EXPECT_THAT([] { write_file_atomically("/dev/full", "x"); },
              testing::ThrowsMessage<RunError>(StartsWith("/dev/full: cannot be written: No space")));
}

// FIPS 180-4 examples.
TEST(Sha256, KnownAnswers) {
  EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

}  // namespace
}  // namespace swarmfit
