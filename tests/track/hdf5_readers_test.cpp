// SPDX-License-Identifier: MIT
// Recordings in HDF5, each made here as the tracker lays it out.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "tests/track/build.h"
#include "tests/track/hdf5_make.h"

namespace swarmfit {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Two animals, three frames; animal 2 is not seen in frame 1.
void make_idtracker(MadeHdf5& file) {
  file.numbers("/trajectories", {3, 2, 2}, {0, 1, 10, 11, 2, 3, kNan, kNan, 4, 5, 12, 13})
      .numbers("/id_probabilities", {3, 2, 1}, {1, 1, 0.4, kNan, 1, 1})
      .attribute("/", "frames_per_second", 50.0)
      .attribute("/", "body_length", 57.5)
      .attribute("/", "identities_labels", std::vector<std::string>{"Ada", "Bo"});
}

TEST(IdTracker, FramesAnimalsAxes) {
  MadeHdf5 file;
  make_idtracker(file);
  const auto tracks = read(file.bytes());
  EXPECT_EQ(tracks.meta().from.format, "idtracker");
  EXPECT_THAT(tracks.names(), ElementsAre("Ada", "Bo"));
  EXPECT_EQ(tracks.dt(), 0.02);
  EXPECT_EQ(tracks.meta().unit, "px");
  EXPECT_EQ(tracks.dims(), 2);
  ASSERT_EQ(tracks.rows(), 5);
  EXPECT_THAT(std::vector(tracks.frame().begin(), tracks.frame().end()), ElementsAre(0, 0, 1, 2, 2));
  EXPECT_EQ(tracks.pos()(4, 0), 12);
  EXPECT_EQ(tracks.pos()(4, 1), 13);
  EXPECT_THAT(tracks.meta().from.notes, ElementsAre("1 of 6 postures have no position and were left out (not seen)"));
}

TEST(IdTracker, SureIdentitiesOnly) {
  MadeHdf5 file;
  make_idtracker(file);
  const auto tracks = read(file.bytes(), {.min_confidence = 0.5});
  EXPECT_EQ(tracks.rows(), 4);
  EXPECT_THAT(tracks.meta().from.notes, Contains("1 of 5 points were left out: their confidence is below 0.5"));
  EXPECT_EQ(error_of(file.bytes(), {.node = "nose"}), "`node` nose: f.csv has no such point; expected mean or one of centroid");
}

// Two tracks, two nodes, three frames; x = 100 track + 10 node + frame.
void make_sleap(MadeHdf5& file, double gap = kNan) {
  std::vector<double> values, scores;
  for (int track = 0; track < 2; ++track)
    for (int axis = 0; axis < 2; ++axis)
      for (int node = 0; node < 2; ++node)
        for (int frame = 0; frame < 3; ++frame) values.push_back(100 * track + 10 * node + frame + 1000 * axis);
  for (const std::size_t at : {0u, 6u}) values[at] = gap;              // node 0 of track 0 in frame 0
  for (int i = 0; i < 12; ++i) scores.push_back(i == 10 ? 0.2 : 0.9);  // node 1 of track 1 in frame 1
  file.numbers("/tracks", {2, 2, 2, 3}, values)
      .numbers("/point_scores", {2, 2, 3}, scores)
      .texts("/node_names", {"nose", "tail"})
      .texts("/track_names", {"red", "blue"});
}

TEST(Sleap, OnePointOfThePosture) {
  MadeHdf5 file;
  make_sleap(file);
  EXPECT_EQ(error_of(file.bytes(), {.fps = 25}), "f.csv: every individual has 2 points, nose, tail; expected `node` NAME or `node` mean");
  EXPECT_EQ(error_of(file.bytes(), {.node = "nose"}), "f.csv: the frame rate is not in the file; expected `fps`, for example `fps` 25");
  const auto tracks = read(file.bytes(), {.fps = 25, .node = "nose"});
  EXPECT_EQ(tracks.meta().from.format, "sleap");
  EXPECT_EQ(tracks.meta().unit, "px");
  EXPECT_THAT(tracks.names(), ElementsAre("blue", "red"));
  ASSERT_EQ(tracks.rows(), 5) << "red is not seen in frame 0";
  EXPECT_EQ(tracks.pos()(0, 0), 100);
  EXPECT_EQ(tracks.pos()(0, 1), 1100);
  EXPECT_EQ(tracks.pos()(4, 0), 2) << "red in frame 2";
}

TEST(Sleap, MeanOfThePosture) {
  MadeHdf5 file;
  make_sleap(file);
  const auto tracks = read(file.bytes(), {.fps = 25, .node = "mean"});
  ASSERT_EQ(tracks.rows(), 6);
  EXPECT_EQ(tracks.pos()(1, 0), 10) << "red in frame 0: only the tail is seen";
  EXPECT_EQ(tracks.pos()(4, 0), 102 + 5) << "blue in frame 2";
  EXPECT_THAT(tracks.meta().from.notes, Contains("in 1 of 6 postures some points are missing: the mean is that of the others"));
  EXPECT_EQ(read(file.bytes(), {.fps = 25, .node = "tail", .min_confidence = 0.5}).rows(), 5);
}

TEST(Sleap, NothingSeen) {
  MadeHdf5 file;
  file.numbers("/tracks", {1, 2, 1, 2}, {kNan, kNan, kNan, kNan}).texts("/node_names", {"nose"});
  EXPECT_EQ(error_of(file.bytes(), {.fps = 25}), "f.csv: no posture has a position of the point 'nose'; expected at least one");
}

TEST(PedestrianHdf5, TableWithItsAttributes) {
  MadeHdf5 file;
  file.table("/trajectory", {{"id:", {2, 2, 7}}, {"frame:", {5, 6, 5}}, {"x", {1, 2, 3}}, {"y", {4, 5, 6}}, {"z", {1.7, 1.7, 1.8}}})
      .attribute("/trajectory", "fps", 16.0)
      .attribute("/trajectory", "x", "pedestrian x-coordinate (meter [m])")
      .attribute("/trajectory", "y", "pedestrian y-coordinate (meter [m])");
  const auto tracks = read(file.bytes());
  EXPECT_EQ(tracks.meta().from.format, "pedestrian-h5");
  EXPECT_EQ(tracks.dt(), 1.0 / 16);
  EXPECT_EQ(tracks.meta().unit, "m");
  EXPECT_EQ(tracks.dims(), 2);
  EXPECT_THAT(tracks.names(), ElementsAre("2", "7"));
  EXPECT_EQ(tracks.pos()(2, 0), 2);
  EXPECT_EQ(tracks.pos()(1, 1), 6);
}

TEST(PedestrianHdf5, WhatIsNotThereIsAskedFor) {
  MadeHdf5 file;
  file.table("/trajectory", {{"id:", {2}}, {"frame:", {5}}, {"x", {1}}, {"y", {4}}});
  EXPECT_EQ(error_of(file.bytes()),
            "f.csv: neither frame rate nor length unit is in the file; expected both, for example `fps` 25 `unit` m");
  MadeHdf5 torn;
  torn.table("/trajectory", {{"id:", {2, 3}}, {"frame", {5, 5.5}}, {"x", {1, 1}}, {"y", {4, 4}}});
  EXPECT_EQ(error_of(torn.bytes(), flags()), "f.csv: row 2: the frame number 5.5 is not an integer; expected whole frames");
}

TEST(DeepLabCutHdf5, NamesWithoutUnpickling) {
  // pickle.dumps([("net", "nose", "x"), ("net", "nose", "y"), ("net", "nose", "likelihood"), ...], 0) for nose and tail
  const std::string names =
      "(lp0\n(Vnet\np1\nVnose\np2\nVx\np3\ntp4\na(g1\ng2\nVy\np5\ntp6\na(g1\ng2\nVlikelihood\np7\ntp8\na"
      "(g1\nVtail\np9\ng3\ntp10\na(g1\ng9\ng5\ntp11\na(g1\ng9\ng7\ntp12\na.";
  MadeHdf5 file;
  file.table("/df_with_missing/table", {{"index:", {0, 1}}, {"values_block_0", {1, 2, 0.9, 11, 12, 0.9, 3, 4, 0.1, 13, 14, 0.9}, 6}})
      .attribute("/df_with_missing/table", "values_block_0_kind", names);
  const auto tracks = read(file.bytes(), {.fps = 30, .node = "tail"});
  EXPECT_EQ(tracks.meta().from.format, "deeplabcut-h5");
  ASSERT_EQ(tracks.rows(), 2);
  EXPECT_EQ(tracks.pos()(1, 0), 13);
  EXPECT_EQ(tracks.pos()(1, 1), 14);
  EXPECT_EQ(read(file.bytes(), {.fps = 30, .node = "nose", .min_confidence = 0.5}).rows(), 1);
  EXPECT_THAT(error_of(file.bytes(), {.fps = 30}), HasSubstr("every individual has 2 points, nose, tail"));
}

TEST(DeepLabCutHdf5, ProgramsAreNotRun) {
  for (const std::string pickle : {"cos\nsystem\n(Vecho\ntR.", "(lp0\n.", "(Vx\n.", "g1\n.", "p1\n.", "(((((", "t", "a", ""}) {
    MadeHdf5 file;
    file.table("/df_with_missing/table", {{"index:", {0}}, {"values_block_0", {1, 2, 3}, 3}})
        .attribute("/df_with_missing/table", "values_block_0_kind", pickle);
    EXPECT_THAT(error_of(file.bytes(), {.fps = 30}), HasSubstr("the names of its columns cannot be read")) << pickle;
  }
}

void make_nwb(MadeHdf5& file, const std::string& pose, const std::vector<std::string>& points) {
  const auto path = "/processing/behavior/" + pose;
  for (const auto& point : points)
    file.numbers(path + "/" + point + "/data", {3, 2}, {1, 2, 3, 4, 5, 6})
        .numbers(path + "/" + point + "/timestamps", {3}, {0, 0.02, 0.04})
        .numbers(path + "/" + point + "/confidence", {3}, {1, 0.2, 1})
        .attribute(path + "/" + point + "/data", "unit", "meters")
        .attribute(path + "/" + point + "/data", "conversion", 10.0)
        .attribute(path + "/" + point, "neurodata_type", "PoseEstimationSeries");
  file.attribute(path, "neurodata_type", "PoseEstimation");
}

TEST(Nwb, PosesOfOneIndividual) {
  MadeHdf5 file;
  make_nwb(file, "PoseEstimation", {"paw"});
  file.attribute("/", "nwb_version", "2.9.0");
  const auto tracks = read(file.bytes());
  EXPECT_EQ(tracks.meta().from.format, "nwb");
  EXPECT_EQ(tracks.meta().unit, "m");
  EXPECT_NEAR(tracks.dt(), 0.02, 1e-12);
  EXPECT_EQ(tracks.pos()(2, 1), 60);
  EXPECT_EQ(read(file.bytes(), {.min_confidence = 0.5}).rows(), 2);
  make_nwb(file, "Other", {"paw", "tail"});
  EXPECT_EQ(error_of(file.bytes()),
            "f.csv: there are 2 PoseEstimation, Other, PoseEstimation; expected `var` NAME, one individual seen by one camera");
  EXPECT_EQ(read(file.bytes(), {.variable = "Other", .node = "tail"}).rows(), 3);
}

// Two frames of two tracked instances with one node; a person has moved the first.
void make_slp(MadeHdf5& file, const std::vector<double>& track, double format, double from = -1) {
  file.table("/frames", {{"frame_id:", {0, 1}}, {"video:", {0, 0}}, {"frame_idx:", {10, 11}}})
      .table("/instances", {{"instance_id:", {0, 1, 2, 3}},
                            {"from_predicted:", {from, -1, -1, -1}},
                            {"frame_id:", {0, 0, 0, 1}},
                            {"instance_type:", {0, 1, 1, 1}},
                            {"track:", track},
                            {"point_id_start:", {0, 0, 1, 2}},
                            {"point_id_end:", {1, 1, 2, 3}}})
      .table("/points", {{"x", {100}}, {"y", {200}}, {"visible:", {1}}})
      .table("/pred_points", {{"x", {1, 2, 3}}, {"y", {4, 5, 6}}, {"visible:", {1, 1, 1}}, {"score", {0.9, 0.9, 0.3}}})
      .texts("/tracks_json", {"[0, \"Ada\"]", "[0, \"Bo\"]"})
      .numbers("/metadata/nothing", {1}, {0})
      .attribute("/metadata", "format_id", format)
      .attribute("/metadata", "json", R"({"nodes": [{"name": "tail"}, {"name": "nose"}], "skeletons": [{"nodes": [{"id": 1}]}]})");
}

TEST(Slp, InstancesOfTracks) {
  MadeHdf5 file;
  make_slp(file, {0, 0, 1, 0}, 1.2);
  const auto tracks = read(file.bytes(), {.fps = 10, .node = "nose"});
  EXPECT_EQ(tracks.meta().from.format, "slp");
  EXPECT_THAT(tracks.names(), ElementsAre("Ada", "Bo"));
  ASSERT_EQ(tracks.rows(), 3);
  EXPECT_EQ(tracks.frame()[0], 10);
  EXPECT_EQ(tracks.pos()(0, 0), 100) << "what a person set counts";
  EXPECT_EQ(tracks.pos()(2, 0), 3);
  EXPECT_EQ(read(file.bytes(), {.fps = 10, .min_confidence = 0.5}).rows(), 2);
  MadeHdf5 old;
  make_slp(old, {0, 0, 1, 0}, 1.0);
  EXPECT_EQ(read(old.bytes(), {.fps = 10}).pos()(2, 0), 2.5) << "before 1.1 the centre of a pixel was at 0.5";
}

TEST(Slp, DetectionsAreNoIndividuals) {
  MadeHdf5 file;
  make_slp(file, {-1, -1, -1, -1}, 1.2);
  EXPECT_THAT(error_of(file.bytes(), {.fps = 10}), HasSubstr("these are detections, not individuals; expected tracked instances"));
  MadeHdf5 corrected;
  make_slp(corrected, {0, -1, 1, 0}, 1.2, 1);
  EXPECT_EQ(read(corrected.bytes(), {.fps = 10}).rows(), 3) << "the correction says which instance it replaces";
}

// ---- files that are no such recordings ----

TEST(Hdf5, UnknownLayoutSaysWhatIsThere) {
  MadeHdf5 file;
  file.numbers("/a/b", {2, 3}, std::vector<double>(6));
  EXPECT_EQ(error_of(file.bytes()),
            "f.csv: is an HDF5 file of no known layout, which holds /a/b (2 x 3); expected one that swarmfit formats lists, or `columns` "
            "and `var` for its arrays");
  EXPECT_THAT(error_of(file.bytes(), {.format = "idtracker"}), HasSubstr("expected trajectories.h5 of idtracker.ai"));
  EXPECT_THAT(error_of(file.bytes(), {.format = "sleap"}), HasSubstr("expected an analysis file of SLEAP"));
  EXPECT_THAT(error_of("id,x,y\n1,2,3\n", {.format = "pedestrian-h5"}), HasSubstr("expected HDF5 of the Pedestrian Dynamics Data Archive"));
}

TEST(Hdf5, PlainArraysAsTheUserSays) {
  MadeHdf5 file;
  file.numbers("/run/rows", {2, 4}, {7, 0, 1, 2, 7, 1, 3, 4}).numbers("/run/other", {2, 4}, std::vector<double>(8));
  const ReadOptions rows{.columns = "id,frame,x,y", .fps = 10, .unit = "m", .variable = "run/rows"};
  const auto tracks = read(file.bytes(), rows);
  EXPECT_EQ(tracks.meta().from.format, "hdf5");
  EXPECT_EQ(tracks.pos()(1, 1), 4);
  EXPECT_THAT(error_of(file.bytes(), flags("id,frame,x,y")),
              HasSubstr("several could hold positions among its arrays run/other (2 x 4), run/rows (2 x 4); expected `var` NAME"));
}

TEST(Hdf5, OtherFilesAreNotOpened) {
  MadeHdf5 linked;
  make_idtracker(linked);
  H5Lcreate_external("/etc/hostname", "/", linked.file(), "elsewhere", H5P_DEFAULT, H5P_DEFAULT);
  EXPECT_EQ(error_of(linked.bytes()), "f.csv: /elsewhere is a link to another file; expected everything in one file");

  MadeHdf5 stored;
  const hid_t plist = H5Pcreate(H5P_DATASET_CREATE);
  const hsize_t count = 8;
  H5Pset_external(plist, "/etc/passwd", 0, 64);
  const hid_t space = H5Screate_simple(1, &count, nullptr);
  H5Dclose(H5Dcreate2(stored.file(), "trajectories", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, plist, H5P_DEFAULT));
  EXPECT_EQ(error_of(stored.bytes()), "f.csv: /trajectories is stored in another file; expected everything in one file");
  H5Sclose(space);
  H5Pclose(plist);
}

TEST(Hdf5, ClaimsAreCheckedBeforeMemoryIsTaken) {
  MadeHdf5 file;
  const std::vector<hsize_t> dims = {1'000'000'000, 1'000'000, 2}, chunk = {1, 1, 2};
  const hid_t space = H5Screate_simple(3, dims.data(), nullptr), plist = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_chunk(plist, 3, chunk.data());
  H5Dclose(H5Dcreate2(file.file(), "trajectories", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, plist, H5P_DEFAULT));
  file.attribute("/", "frames_per_second", 50.0).attribute("/", "body_length", 57.5);
  EXPECT_THAT(error_of(file.bytes()), StartsWith("f.csv: /trajectories claims 1000000000 x 1000000 x 2 values, more than a file of"));
  H5Sclose(space);
  H5Pclose(plist);
}

TEST(Hdf5, CutAnywhereItIsOneLine) {
  MadeHdf5 file;
  make_sleap(file);
  const auto bytes = file.bytes();
  for (std::size_t size = 1; size < bytes.size(); size += bytes.size() / 40)
    EXPECT_THAT(error_of(bytes.substr(0, size), {.fps = 1, .format = "sleap", .node = "nose"}), StartsWith("f.csv: ")) << size;
}

}  // namespace
}  // namespace swarmfit
