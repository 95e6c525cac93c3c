// SPDX-License-Identifier: MIT
// MATLAB files written by matio itself, in both versions, whole and damaged.
#include <gmock/gmock.h>
#include <matio.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <numeric>

#include "libtrack/file.h"
#include "libtrack/rng.h"
#include "tests/track/build.h"

namespace swarmfit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

struct Variable {
  std::string name;
  std::vector<std::size_t> dims;
  std::vector<double> value;
};

std::string mat_file(const std::vector<Variable>& variables, mat_ft version, matio_compression compression = MAT_COMPRESSION_ZLIB) {
  const auto path = (std::filesystem::temp_directory_path() / ("swarmfit_mat_test_" + std::to_string(getpid()) + ".mat")).string();
  mat_t* mat = Mat_CreateVer(path.c_str(), nullptr, version);
  for (auto v : variables) {
    matvar_t* var =
        Mat_VarCreate(v.name.c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE, static_cast<int>(v.dims.size()), v.dims.data(), v.value.data(), 0);
    Mat_VarWrite(mat, var, compression);
    Mat_VarFree(var);
  }
  Mat_Close(mat);
  auto bytes = read_file(path);
  std::filesystem::remove(path);
  return bytes;
}

// Three individuals, ten frames at 50 Hz: columns id, x, y, z, t, then 7 more as in the jackdaw files.
Variable jackdaws(const std::string& name, std::size_t columns = 12) {
  Variable v{name, {30, columns}, std::vector<double>(30 * columns, 0.5)};
  for (std::size_t i = 0; i < 30; ++i) {
    v.value[i] = static_cast<double>(i / 10 + 4);
    for (std::size_t c = 1; c < 4; ++c) v.value[c * 30 + i] = static_cast<double>(10 * c + i);
    v.value[4 * 30 + i] = 0.02 * static_cast<double>(i % 10 + 3);
  }
  return v;
}

class Mat : public testing::TestWithParam<mat_ft> {};
INSTANTIATE_TEST_SUITE_P(Versions, Mat, testing::Values(MAT_FT_MAT5, MAT_FT_MAT73),
                         [](const auto& p) { return p.param == MAT_FT_MAT5 ? "v5" : "v73"; });

TEST_P(Mat, TheFilteredTableIsPreferred) {
  auto raw = jackdaws("tracks", 11);
  raw.value.assign(raw.value.size(), 1);
  const auto tracks = read(mat_file({raw, jackdaws("tracks_filt")}, GetParam()), {.unit = "m"});
  EXPECT_EQ(tracks.rows(), 30);
  EXPECT_THAT(tracks.names(), ElementsAre("4", "5", "6"));
  EXPECT_EQ(tracks.dt(), 0.02);
  EXPECT_EQ(tracks.frames().front().number, 3);
  EXPECT_EQ(tracks.pos()(1, 1), 30) << "row 10 of the table is the first of individual 5";
  EXPECT_EQ(tracks.acc()(0, 0), 0.5);
  EXPECT_EQ(tracks.meta().from.format, "mat");
  EXPECT_EQ(tracks.meta().from.columns, "id,x,y,z,t,vx,vy,vz,ax,ay,az,_");
}

TEST_P(Mat, AnyTableWithColumns) {
  const Variable table{"data", {3, 4}, {7, 7, 7, 0, 1, 2, 1.5, 2.5, 3.5, 4, 5, 6}};
  const auto bytes = mat_file({table, {"note", {1, 1}, {3}}}, GetParam());
  const auto tracks = read(bytes, flags("id,frame,x,y"));
  EXPECT_EQ(tracks.rows(), 3);
  EXPECT_EQ(tracks.pos()(2, 0), 3.5);
  EXPECT_EQ(
      error_of(bytes),
      "f.csv: nothing says what the 4 columns of 'data' are; expected `columns`, such as `columns` id,x,y,z,t; the first row is 7,0,1.5,4");
}

TEST_P(Mat, ChoosingAVariable) {
  const auto bytes = mat_file({jackdaws("a"), jackdaws("b")}, GetParam());
  EXPECT_EQ(error_of(bytes), "f.csv: there are several tables among its variables a (30 x 12), b (30 x 12); expected `var` NAME");
  EXPECT_EQ(error_of(bytes, {.variable = "c"}), "`var`: f.csv has no variable 'c'; expected one of a (30 x 12), b (30 x 12)");
  EXPECT_EQ(read(bytes, {.columns = "id,x,y,z,t,_,_,_,_,_,_,_", .unit = "m", .variable = "b"}).rows(), 30);
  EXPECT_EQ(error_of(mat_file({{"n", {1, 1}, {3}}}, GetParam())),
            "f.csv: there is no table of rows among its variables n (1 x 1); expected `var` NAME");
}

TEST_P(Mat, FaultsHaveTheirRow) {
  auto table = jackdaws("tracks_filt");
  table.value[2 * 30 + 4] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(error_of(mat_file({table}, GetParam()), {.unit = "m"}),
            "f.csv: variable 'tracks_filt' row 5: the value is infinite; expected a finite number");
  table = jackdaws("tracks_filt");
  table.value[4 * 30 + 4] = std::nan("");
  EXPECT_EQ(error_of(mat_file({table}, GetParam()), {.unit = "m"}),
            "f.csv: variable 'tracks_filt' row 5: the time is missing; expected a time in every row");
  table = jackdaws("tracks_filt");
  table.value[4 * 30 + 4] = table.value[4 * 30 + 3];
  EXPECT_EQ(error_of(mat_file({table}, GetParam()), {.unit = "m"}),
            "f.csv: variable 'tracks_filt' row 5: individual '4' has another row for frame 6 at f.csv: variable 'tracks_filt' row 4; "
            "expected one "
            "row per individual and frame");
}

TEST_P(Mat, MissingPositionsAreGaps) {
  auto table = jackdaws("tracks_filt");
  table.value[1 * 30 + 4] = std::nan("");
  const auto tracks = read(mat_file({table}, GetParam()), {.unit = "m"});
  EXPECT_EQ(tracks.rows(), 29);
  EXPECT_THAT(tracks.meta().from.notes, ElementsAre("1 row without a position was dropped (not seen)"));
}

// Two events of two individuals; the first has two drives, frames 3-5 and 9-10, the second (number 4) one, frames 2-3.
std::vector<Variable> drives() {
  std::vector<double> first(2 * 2 * 5), second(2 * 2 * 2);
  std::iota(first.begin(), first.end(), 0.0);
  std::iota(second.begin(), second.end(), 100.0);
  return {{"dt", {1, 1}, {0.1}},    {"events", {1, 2}, {1, 4}}, {"ev_st_1", {1, 2}, {3, 9}},    {"ev_et_1", {1, 2}, {5, 10}},
          {"ev_st_4", {1, 1}, {2}}, {"ev_et_4", {1, 1}, {3}},   {"pos_ev_1", {2, 2, 5}, first}, {"pos_ev_2", {2, 2, 2}, second}};
}

TEST_P(Mat, DrivesAreEpisodes) {
  const auto tracks = read(mat_file(drives(), GetParam()), {.unit = "m"});
  EXPECT_EQ(tracks.rows(), 14);
  std::vector<std::int64_t> frames;
  for (const auto& f : tracks.frames()) frames.push_back(f.number);
  EXPECT_THAT(frames, ElementsAre(103, 104, 105, 109, 110, 402, 403));
  EXPECT_THAT(tracks.episodes(), ElementsAre(109, 402));
  EXPECT_THAT(tracks.names(), ElementsAre("1", "2"));
  EXPECT_EQ(tracks.dt(), 0.1);
  // Individual 2 in the second frame of the first drive: pos_ev_1(2, 1, 2) and pos_ev_1(2, 2, 2) in MATLAB's counting.
  EXPECT_EQ(tracks.pos()(3, 0), 5);
  EXPECT_EQ(tracks.pos()(3, 1), 7);
}

TEST_P(Mat, DrivesWithFaults) {
  const auto fails = [&](std::size_t which, const Variable& with) {
    auto variables = drives();
    variables[which] = with;
    return error_of(mat_file(variables, GetParam()), {.unit = "m"});
  };
  EXPECT_EQ(fails(0, {"dt", {1, 1}, {-1}}), "f.csv: the frame interval dt is -1; expected a positive time");
  EXPECT_EQ(fails(1, {"events", {1, 1}, {1}}), "f.csv: events lists 1 events; expected one for pos_ev_2");
  EXPECT_EQ(fails(2, {"other", {1, 1}, {1}}), "f.csv: variable 'ev_st_1' is missing; expected it beside pos_ev_k");
  EXPECT_EQ(fails(3, {"ev_et_1", {1, 2}, {5, 8}}), "f.csv: drive 2 of event 1 ends before it starts; expected ev_st <= ev_et");
  EXPECT_EQ(fails(3, {"ev_et_1", {1, 2}, {5, 11}}), "f.csv: pos_ev_1 has 5 frames; expected the 6 of its drives");
  EXPECT_EQ(fails(3, {"ev_et_1", {1, 1}, {5}}), "f.csv: ev_st_1 and ev_et_1 differ in length; expected one end per start");
}

// Damage of every kind must end in tracks or in an InputError, never in a crash, a hang or a huge allocation.
TEST_P(Mat, DamagedFilesAreSurvived) {
  const auto good = mat_file({jackdaws("tracks_filt")}, GetParam());
  const auto survive = [](const std::string& bytes) {
    try {
      read(bytes, {.unit = "m"});
    } catch (const InputError&) {
    }
  };
  for (std::size_t n = 0; n < good.size(); n += std::max<std::size_t>(1, good.size() / 60)) survive(good.substr(0, n));
  const Rng rng{1};
  for (std::uint32_t round = 0; round < 120; ++round) {
    auto bytes = good;
    for (std::uint32_t k = 0; k <= round % 4; ++k) {
      const auto u = rng.uniform2(Stream::probe, round, k);
      bytes[static_cast<std::size_t>(u[0] * static_cast<double>(bytes.size()))] ^= static_cast<char>(1 << static_cast<int>(8 * u[1]));
    }
    survive(bytes);
  }
}

TEST(MatFile, ASizeThatTheFileCannotHoldIsRefusedBeforeMemoryIsTaken) {
  auto bytes = mat_file({jackdaws("tracks_filt")}, MAT_FT_MAT5, MAT_COMPRESSION_NONE);
  // 128 bytes header, matrix tag 8, array flags 16, dimensions tag 8: then the two 32-bit dimensions.
  for (const std::size_t at : {160u, 164u}) bytes.replace(at, 4, std::string("\xff\xff\xff\x7f"));
  EXPECT_THAT(error_of(bytes, {.unit = "m"}), HasSubstr("'tracks_filt' claims 2147483647 x 2147483647 values, more than a file of"));
}

TEST(MatFile, DamageIsNamed) {
  const auto plain = mat_file({jackdaws("tracks_filt")}, MAT_FT_MAT5, MAT_COMPRESSION_NONE);
  EXPECT_EQ(error_of(plain.substr(0, plain.size() / 2)), "f.csv: the file is cut off; expected an undamaged MATLAB file");
  EXPECT_EQ(error_of(plain.substr(0, 100)), "f.csv: the file is cut off in its header; expected an undamaged MATLAB file");
  auto packed = mat_file({jackdaws("tracks_filt")}, MAT_FT_MAT5);
  packed[packed.size() / 2] ^= 1;
  EXPECT_EQ(error_of(packed), "f.csv: element 1 at byte 136 does not unpack; expected an undamaged MATLAB file");
  packed[128] ^= 16;
  EXPECT_EQ(error_of(packed), "f.csv: element 1 at byte 128 is of no known type; expected an undamaged MATLAB file");
  const auto hdf5 = mat_file({jackdaws("tracks_filt")}, MAT_FT_MAT73);
  EXPECT_EQ(error_of(hdf5.substr(0, hdf5.size() / 2)),
            "f.csv: the MATLAB file cannot be read; expected an undamaged file of version 5 or 7.3");
}

}  // namespace
}  // namespace swarmfit
