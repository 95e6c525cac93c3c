// SPDX-License-Identifier: MIT
// Text of DeepLabCut, FastTrack, idtracker.ai, TRex, Motive, trackR and Movebank; files that are joined. Made by hand.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "libtrack/read/join.h"
#include "tests/track/build.h"

namespace swarmfit {
namespace {

using testing::Contains;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

namespace fs = std::filesystem;

std::vector<double> column(const Tracks& tracks, int axis) {
  std::vector<double> out;
  for (Index i = 0; i < tracks.rows(); ++i) out.push_back(tracks.pos()(i, axis));
  return out;
}

ReadOptions at_25_hertz(std::string node = {}) {
  ReadOptions options{.fps = 25};
  options.node = std::move(node);
  return options;
}

// A folder that goes with the test.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("swarmfit_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    fs::remove_all(path_);
    fs::create_directory(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { fs::remove_all(path_); }
  void add(const std::string& name, const std::string& bytes) const { std::ofstream(path_ / name, std::ios::binary) << bytes; }
  std::string path(const std::string& name = {}) const { return (name.empty() ? path_ : path_ / name).string(); }

 private:
  fs::path path_;
};

std::string error_in(const std::string& path, const ReadOptions& options) {
  try {
    read_tracks(path, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(DeepLabCutCsv, OneAnimal) {
  const std::string text =
      "scorer,net,net,net,net,net,net\nbodyparts,head,head,head,tail,tail,tail\ncoords,x,y,likelihood,x,y,likelihood\n"
      "0,1,10,0.9,3,10,0.9\n1,2,10,0.1,4,10,0.9\n";
  EXPECT_THAT(error_of(text, at_25_hertz()), HasSubstr("head, tail; expected `node` NAME or `node` mean"));
  EXPECT_THAT(column(read(text, at_25_hertz("head")), 0), ElementsAre(1, 2));
  EXPECT_EQ(read(text, at_25_hertz("head")).meta().unit, "px");
  auto options = at_25_hertz("mean");
  options.min_confidence = 0.5;
  EXPECT_THAT(column(read(text, options), 0), ElementsAre(2, 4));
}

TEST(DeepLabCutCsv, SeveralAnimalsHaveAFourthRow) {
  const std::string text =
      "scorer,net,net,net,net,net,net\nindividuals,m1,m1,m1,m2,m2,m2\nbodyparts,head,head,head,head,head,head\n"
      "coords,x,y,likelihood,x,y,likelihood\n0,1,10,0.9,3,10,0.9\n1,2,10,0.1,,,\n";
  const auto tracks = read(text, at_25_hertz());
  EXPECT_THAT(tracks.names(), ElementsAre("m1", "m2"));
  EXPECT_THAT(column(tracks, 0), ElementsAre(1, 3, 2));
}

TEST(DeepLabCutCsv, Faults) {
  EXPECT_THAT(error_of("scorer,n,n\nbodyparts,a,a\ncoords,x\n0,1,2\n", at_25_hertz()),
              HasSubstr("the row 'coords' has 2 columns but the first row of numbers 3"));
  EXPECT_THAT(error_of("scorer,n,n\nbodyparts,a,a\n0,1,2\n", at_25_hertz()), HasSubstr("there is no row 'coords'"));
  EXPECT_THAT(error_of("scorer,n,n\nbodyparts,a,a\ncoords,x,y\n", at_25_hertz()), HasSubstr("there is no row of numbers"));
}

TEST(FastTrack, BodyUnlessANodeIsNamed) {
  const std::string text =
      "xHead\tyHead\ttHead\txTail\tyTail\txBody\tyBody\timageNumber\tid\n1\t5\t0\t3\t5\t2\t5\t0\t7\n2\t5\t0\t4\t5\t3\t5\t1\t7\n";
  EXPECT_THAT(column(read(text, at_25_hertz()), 0), ElementsAre(2, 3));
  EXPECT_THAT(column(read(text, at_25_hertz("head")), 0), ElementsAre(1, 2));
  EXPECT_THAT(read(text, at_25_hertz()).names(), ElementsAre("7"));
}

TEST(IdtrackerCsv, RateUnitAndNamesFromTheAttributes) {
  const Folder folder;
  folder.add("trajectories.csv", "seconds,x1,y1,x2,y2\n0.000,1,2,3,4\n0.036,1.5,2,nan,nan\n0.071,2,2,4,4\n");
  folder.add("attributes.json", R"({"frames_per_second": 28, "identities_labels": ["Ada", "Bob"], "length_unit": -1})");
  const auto tracks = read_tracks(folder.path("trajectories.csv"));
  EXPECT_DOUBLE_EQ(tracks.dt(), 1.0 / 28);
  EXPECT_EQ(tracks.meta().unit, "px");
  EXPECT_THAT(tracks.names(), ElementsAre("Ada", "Bob"));
  EXPECT_EQ(tracks.rows(), 5);
  EXPECT_EQ(tracks.frames().size(), 3u);
  folder.add("trajectories.csv", "seconds,x1,y1,x2\n0.000,1,2,3\n0.036,1.5,2,3\n");
  EXPECT_THAT(error_in(folder.path("trajectories.csv"), {}), HasSubstr("there is no pair of columns x1,y1"));
  folder.add("trajectories.csv", "seconds,x1,y1,q,y2\n0.000,1,2,3,4\n0.036,1.5,2,3,4\n");
  EXPECT_THAT(error_in(folder.path("trajectories.csv"), {}), HasSubstr("the columns are not seconds,x1,y1,x2,y2"));
  folder.add("attributes.json", "{}");
  EXPECT_THAT(error_in(folder.path("trajectories.csv"), {}), HasSubstr("frames_per_second is missing"));
}

TEST(TrexCsv, WeightedCentroidAndTheNameOfTheFile) {
  const std::string text =
      "frame,X (cm),Y (cm),X#wcentroid (cm),Y#wcentroid "
      "(cm),frame,missing,time\n0,9,9,1,5,0,0,0\n1,9,9,inf,inf,1,1,0.1\n2,9,9,3,5,2,0,0.2\n";
  const auto tracks = read_tracks_bytes("run_fish3.csv", text);
  EXPECT_THAT(tracks.names(), ElementsAre("run_fish3"));
  EXPECT_THAT(column(tracks, 0), ElementsAre(1, 3));
  EXPECT_EQ(tracks.meta().unit, "cm");
  EXPECT_DOUBLE_EQ(tracks.dt(), 0.1);
  EXPECT_THAT(error_of("frame,X#wcentroid (cm)\n0,1\n1,2\n", at_25_hertz()), HasSubstr("there is no column Y#wcentroid"));
}

TEST(TrexCsv, ATableWithIdsIsPlainText) {
  EXPECT_EQ(read("id,frame,X#wcentroid (cm),Y#wcentroid (cm)\n0,0,1,2\n1,0,1,2\n0,1,1,2\n1,1,1,2\n", at_25_hertz()).track_count(), 2u);
}

// Every reader of text, forced upon a file of another kind, refuses it or reads it; none reaches past what is there.
TEST(Formats, ForcedUponAnyText) {
  for (const auto* text :
       {"1,2\n", "a\n1\n", "id,frame,x,y\n1,0,1,2\n1,1,1,2\n", "seconds,x1\n0,1\n1,2\n", "scorer\n0\n", "\n\n,\n", ";;;\n1;2;3;4\n"})
    for (const auto& format : formats()) {
      auto options = flags();
      options.format = std::string(format.name);
      const auto message = error_of(text, options);
      EXPECT_EQ(message.find('\n'), std::string::npos) << format.name << ": " << text;
    }
}

TEST(Motive, RigidBodies) {
  const std::string text =
      "Format Version,1.23,Export Frame Rate,100.000000,Length Units,Meters\n\n"
      ",Type,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Marker,Marker,Marker\n,Name,d1,d1,d1,d1,m,m,m\n,ID,1,1,1,1,2,2,2\n"
      ",,Rotation,Position,Position,Position,Position,Position,Position\nFrame,Time (Seconds),X,X,Y,Z,X,Y,Z\n"
      "100,1.0,0.5,1,2,3,7,7,7\n101,1.01,0.5,,,,7,7,7\n102,1.02,0.5,1.5,2,3,7,7,7\n";
  const auto tracks = read(text);
  EXPECT_EQ(tracks.dims(), 3);
  EXPECT_THAT(tracks.names(), ElementsAre("d1"));
  EXPECT_THAT(column(tracks, 0), ElementsAre(1, 1.5));
  EXPECT_THAT(column(tracks, 2), ElementsAre(3, 3));
  EXPECT_EQ(tracks.meta().unit, "m");
  EXPECT_DOUBLE_EQ(tracks.dt(), 0.01);
}

TEST(TrackR, MendedTracksWithoutTheIgnored) {
  const auto tracks =
      read("id,x,y,size,frame,track,ignore,track_fixed\n1,10,5,9,1,1,FALSE,4\n2,20,5,9,1,2,TRUE,5\n1,11,5,9,2,3,FALSE,4\n", at_25_hertz());
  EXPECT_THAT(tracks.names(), ElementsAre("4"));
  EXPECT_THAT(column(tracks, 0), ElementsAre(10, 11));
}

TEST(AnimalTa, IndividualsOfSeveralArenas) {
  const auto tracks = read("Frame;Time;Arena;Ind;X;Y\n00.00;00.00;0;0;5;1\n00.00;00.00;1;0;9;1\n01.00;00.03;0;0;6;1\n02.00;00.01;0;0;7;1\n",
                           {.fps = 25, .unit = "px"});
  EXPECT_THAT(tracks.names(), ElementsAre("Arena0_Ind0", "Arena1_Ind0"));
  EXPECT_THAT(column(tracks, 0), ElementsAre(5, 9, 6, 7));
}

// A thousandth of a degree at the equator: a * pi / 180000 along it, a (1 - e^2) * pi / 180000 across.
TEST(Degrees, MetresAtTheEquator) {
  const std::string rows = "1,0,-0.001,0\n1,1,0,0\n1,2,0.001,0\n2,0,0,-0.001\n2,1,0,0\n2,2,0,0.001\n";
  const auto tracks = read("id,frame,lon,lat\n" + rows, at_25_hertz());
  EXPECT_EQ(tracks.meta().unit, "m");
  EXPECT_THAT(column(tracks, 0),
              ElementsAre(DoubleNear(-111.31949, 1e-4), DoubleNear(0, 1e-6), 0, 0, DoubleNear(111.31949, 1e-4), DoubleNear(0, 1e-6)));
  EXPECT_NEAR(tracks.pos()(1, 1), -110.57428, 1e-4);
  EXPECT_THAT(tracks.meta().from.notes, Contains(HasSubstr("projected to metres")));
}

TEST(Degrees, AcrossTheDateLine) {
  const auto tracks = read("id,frame,lon,lat\n1,0,179.999,0\n1,1,180,0\n1,2,-179.999,0\n", at_25_hertz());
  EXPECT_THAT(column(tracks, 0), ElementsAre(DoubleNear(-111.31949, 1e-4), DoubleNear(0, 1e-6), DoubleNear(111.31949, 1e-4)));
}

TEST(Movebank, StampsDegreesAndOutliers) {
  const auto tracks = read(
      "event-id,visible,timestamp,location-long,location-lat,tag-local-identifier,individual-local-identifier\n"
      "1,true,2017-08-08 20:24:00.000,10.0,50.0,\"48\",\"Bat4\"\n2,false,2017-08-08 20:24:01.000,12.0,50.0,\"48\",\"Bat4\"\n"
      "3,true,2017-08-08 20:24:02.000,10.0,50.001,\"48\",\"Bat4\"\n4,true,2017-08-08 20:24:03.000,10.0,50.002,\"48\",\"Bat4\"\n");
  EXPECT_THAT(tracks.names(), ElementsAre("Bat4"));
  EXPECT_EQ(tracks.rows(), 3);
  EXPECT_EQ(tracks.dt(), 1);
  EXPECT_NEAR(tracks.pos()(2, 1) - tracks.pos()(0, 1), 222.458, 0.01);  // 0.002 degrees of meridian at 50 N: 111229 m per degree
}

TEST(Join, AFolderIsOneRecording) {
  const Folder folder;
  for (int k : {0, 2, 10}) folder.add("fish" + std::to_string(k) + ".csv", "frame,X (cm),Y (cm)\n0,1,2\n1," + std::to_string(k) + ",2\n");
  folder.add(".hidden", "no recording");
  auto options = at_25_hertz();
  options.join = true;
  for (const auto& path : {folder.path(), folder.path("fish*.csv"), folder.path("f?sh*")}) {
    const auto tracks = read_tracks(path, options);
    EXPECT_THAT(tracks.names(), testing::UnorderedElementsAre("fish0", "fish2", "fish10"));
    EXPECT_EQ(tracks.rows(), 6);
    EXPECT_EQ(tracks.meta().unit, "cm");
    EXPECT_THAT(tracks.meta().from.notes, ElementsAre("3 files were joined, individuals named by their files"));
  }
  EXPECT_EQ(read_tracks(folder.path("fish1*.csv"), options).track_count(), 1u);
}

TEST(Join, FilesThatAreNamedAreOneRecording) {
  const Folder folder;
  for (int k : {0, 2, 10}) folder.add("fish" + std::to_string(k) + ".csv", "frame,X (cm),Y (cm)\n0,1,2\n1," + std::to_string(k) + ",2\n");
  auto options = at_25_hertz();
  options.join = true;
  options.joined = {folder.path("fish10.csv"), folder.path("fish2.csv")};
  EXPECT_THAT(read_tracks("two fish", options).names(), ElementsAre("fish10", "fish2"));
  EXPECT_EQ(read_tracks("two fish", options).meta().from.path, "two fish");
}

TEST(Join, TheyAreCalledByWhatTheyShare) {
  EXPECT_EQ(common_pattern({"goats/1.csv", "goats/2.csv"}), "goats/*.csv");
  EXPECT_EQ(common_pattern({"goats/1.csv", "goats/2.txt"}), "goats/*");
  EXPECT_EQ(common_pattern({"a/1.csv", "b/1.csv"}), "*.csv");
}

TEST(Join, SeveralIndividualsInAFileKeepTheirNames) {
  const Folder folder;
  for (const auto* day : {"a", "b"}) folder.add(std::string(day) + ".csv", "id,frame,x,y\n1,0,1,2\n2,0,1,2\n1,1,1,2\n2,1,1,2\n");
  ReadOptions options{.fps = 25, .unit = "m"};
  options.join = true;
  EXPECT_THAT(read_tracks(folder.path(), options).names(), ElementsAre("a/1", "a/2", "b/1", "b/2"));
}

TEST(Join, Faults) {
  const Folder folder;
  auto options = at_25_hertz();
  options.join = true;
  EXPECT_THAT(error_in(folder.path(), options), HasSubstr("there is no such file; expected a folder, or a pattern"));
  folder.add("a.csv", "frame,x [cm],y [cm]\n0,1,2\n1,1,2\n");
  folder.add("b.csv", "frame,x [mm],y [mm]\n0,1,2\n1,1,2\n");
  EXPECT_THAT(error_in(folder.path(), options), HasSubstr("b.csv: the length unit is 'mm' but 'cm' in "));
  folder.add("b.csv", "t,x [cm],y [cm]\n0,1,2\n1,1,2\n");
  EXPECT_THAT(error_in(folder.path(), options), HasSubstr("b.csv: the columns are not those of "));
  folder.add("b.csv", "# fps: 30\nframe,x [cm],y [cm]\n0,1,2\n1,1,2\n");
  EXPECT_THAT(error_in(folder.path(), options), HasSubstr("b.csv: the stated frame rate is not that of "));
  folder.add("b.csv", "frame,x [cm],y [cm]\n0,1,2\n0,1,3\n");
  EXPECT_THAT(error_in(folder.path(), options), HasSubstr("b.csv:3: individual 'b' has another row for frame 0 at "));
  folder.add("c.txt", "frame,x [cm],y [cm]\n0,1,2\n1,1,2\n");
  EXPECT_THAT(error_in(folder.path(), options), HasSubstr("there are files of several endings, .csv and .txt; expected a pattern such as"));
}

const std::string kRealSpace =
    "Time (sec)\tArena\tTrack\tPos. X (mm)\tPos. Y (mm)\tLabel\n"
    "0\t1\t1\t1\t5\t1\n0.04\t1\t1\t2\t5\t0\n0.08\t1\t1\t3\t5\t2\n0.12\t1\t1\t4\t5\t1\n"
    "0\t2\t1\t7\t6\t1\n0.04\t2\t1\t8\t6\t3\n0.08\t2\t1\t9\t6\t1\n0.12\t2\t1\t9\t7\t1\n";

TEST(ToxTrac, RealSpace) {
  const auto tracks = read(kRealSpace);
  EXPECT_EQ(tracks.meta().from.format, "toxtrac");
  EXPECT_THAT(tracks.names(), ElementsAre("Arena1_Track1", "Arena2_Track1"));
  EXPECT_EQ(tracks.meta().unit, "mm");
  EXPECT_DOUBLE_EQ(tracks.dt(), 0.04);
  EXPECT_THAT(column(tracks, 0), ElementsAre(1, 7, 3, 9, 4, 9)) << "predicted and mirrored positions are not seen";
  EXPECT_THAT(tracks.meta().from.notes,
              testing::IsSupersetOf({testing::Eq("1 predicted and 1 mirrored positions were left out: the animal was not seen there"),
                                     testing::Eq("1 positions are of occluded animals"),
                                     testing::Eq("there are 2 arenas, whose animals do not meet (--tracks takes those of one)")}));
}

TEST(ToxTrac, PixelsByTheNameOfTheFile) {
  const std::string text = "360\t0\t1\t224.634\t32.2103\t1\n361\t0\t1\t225.131\t32.2103\t1\n362\t0\t1\t226.737\t32.2103\t1\n";
  const auto tracks = read_tracks_bytes("run/Tracking_0.txt", text, at_25_hertz());
  EXPECT_EQ(tracks.meta().from.format, "toxtrac");
  EXPECT_EQ(tracks.meta().unit, "px");
  EXPECT_THAT(tracks.names(), ElementsAre("Arena0_Track1"));
  EXPECT_THAT(tracks.frame(), ElementsAre(360, 361, 362));
  EXPECT_THAT(error_of(text, {.fps = 25, .unit = "px"}), HasSubstr("expected")) << "six numbers in a file of any name";
  EXPECT_THAT(error_of("1\t2\t3\n", {.format = "toxtrac"}), HasSubstr("3 columns; expected those of ToxTrac"));
}

}  // namespace
}  // namespace swarmfit
