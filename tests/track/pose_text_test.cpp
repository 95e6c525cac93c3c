// SPDX-License-Identifier: MIT
// Text of trackers that name points of bodies, and tables with layouts of their own. The files are made by hand.
#include <gmock/gmock.h>

#include "tests/track/build.h"

namespace swarmfit {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<double> column(const Tracks& tracks, int axis) {
  std::vector<double> out;
  for (Index i = 0; i < tracks.rows(); ++i) out.push_back(tracks.pos()(i, axis));
  return out;
}

ReadOptions pixels(std::string node = {}) {
  ReadOptions options{.fps = 25, .unit = "px"};
  options.node = std::move(node);
  return options;
}

const std::string kSleap =
    "track,frame_idx,instance.score,nose.x,nose.y,nose.score,tail.x,tail.y,tail.score\n"
    "a,0,0.9,1,10,0.9,3,10,0.9\n"
    "b,0,0.9,5,20,0.2,7,20,0.9\n"
    "a,1,0.9,2,10,0.9,,,0\n"
    "b,1,0.9,6,20,0.9,8,20,0.9\n";

TEST(PoseText, SleapNeedsAPoint) {
  EXPECT_EQ(error_of(kSleap, pixels()), "f.csv: every individual has 2 points, nose, tail; expected `node` NAME or `node` mean");
}

TEST(PoseText, SleapPointAndMean) {
  const auto nose = read(kSleap, pixels("nose"));
  EXPECT_THAT(nose.names(), ElementsAre("a", "b"));
  EXPECT_THAT(column(nose, 0), ElementsAre(1, 5, 2, 6));
  EXPECT_THAT(column(read(kSleap, pixels("tail")), 0), ElementsAre(3, 7, 8)) << "an empty field is not seen";
  EXPECT_THAT(column(read(kSleap, pixels("mean")), 0), ElementsAre(2, 6, 2, 7));
}

TEST(PoseText, SleapNeedsNoUnitAndNoTrackOfOneAnimal) {
  const std::string head = "track,frame_idx,instance.score,A.x,A.y,A.score\n";
  const auto tracks = read(head + ",0,nan,1,10,0.9\n,1,nan,2,10,0.9\n", {.fps = 25});
  EXPECT_EQ(tracks.meta().unit, "px");
  EXPECT_THAT(tracks.names(), ElementsAre("1"));
  EXPECT_THAT(column(tracks, 0), ElementsAre(1, 2));
  EXPECT_EQ(error_of(head + ",0,nan,1,10,0.9\n,0,nan,2,10,0.9\n", {.fps = 25}),
            "f.csv: no row has a track, and frames have several: these are detections without identities; expected tracks");
}

TEST(PoseText, RowNumbersAreNoIndividualsHereEither) {
  const auto tracks =
      read("id,track,frame,nose.x,nose.y,tail.x,tail.y\n1,a,0,1,2,3,4\n2,b,0,1,2,3,4\n3,a,1,1,2,3,4\n4,b,1,1,2,3,4\n", pixels("nose"));
  EXPECT_THAT(tracks.names(), ElementsAre("a", "b"));
}

TEST(PoseText, NamesOfPointsKeepTheirCase) {
  EXPECT_THAT(error_of("track,frame_idx,A.x,A.y,leftEar.x,leftEar.y\na,0,1,2,3,4\na,1,1,2,3,4\n", pixels()), HasSubstr("A, leftEar;"));
}

TEST(PoseText, ConfidenceLeavesOut) {
  auto options = pixels("nose");
  options.min_confidence = 0.5;
  const auto sure = read(kSleap, options);
  EXPECT_THAT(column(sure, 0), ElementsAre(1, 2, 6));
  EXPECT_THAT(sure.meta().from.notes, Contains(HasSubstr("1 of 4 points were left out: their confidence is below 0.5")));
}

TEST(PoseText, KeypointsInRows) {
  const std::string text =
      "frame,individual,keypoint,x,y,confidence\n"
      "0,m,nose,1,10,0.9\n0,m,tail,3,10,0.9\n1,m,nose,2,10,0.1\n1,m,tail,4,10,0.9\n";
  EXPECT_THAT(error_of(text, pixels()), HasSubstr("nose, tail; expected `node` NAME or `node` mean"));
  EXPECT_THAT(column(read(text, pixels("tail")), 0), ElementsAre(3, 4));
  EXPECT_THAT(column(read(text, pixels("mean")), 0), ElementsAre(2, 3));
  auto options = pixels("mean");
  options.min_confidence = 0.5;
  EXPECT_THAT(column(read(text, options), 0), ElementsAre(2, 4));
  EXPECT_THAT(error_of(text + "1,m,tail,4,10,0.9\n", pixels("tail")),
              HasSubstr("f.csv:6: the individual has point 'tail' twice in one frame"));
}

TEST(PoseText, NodeWithoutPoints) {
  EXPECT_THAT(error_of("id,frame,x,y\n1,0,1,2\n1,1,1,2\n", pixels("nose")), HasSubstr("`node` nose: f.csv (text) has no named points"));
}

TEST(TrackMateCsv, FourRowsOfNames) {
  const std::string head =
      "LABEL,ID,TRACK_ID,QUALITY,POSITION_X,POSITION_Y,POSITION_Z,POSITION_T,FRAME\n"
      "Label,Spot ID,Track ID,Quality,X,Y,Z,T,Frame\n"
      "Label,Spot ID,Track ID,Quality,X,Y,Z,T,Frame\n"
      ",,,(quality),(micron),(micron),(micron),(sec),\n";
  const auto tracks = read(head + "a,10,0,1,1.5,2,0,0.0,0\nb,11,,1,9,9,0,0.0,0\nc,12,0,1,2.5,2,0,0.5,1\n");
  EXPECT_EQ(tracks.track_count(), 1u);
  EXPECT_EQ(tracks.dims(), 2);
  EXPECT_EQ(tracks.dt(), 0.5);
  EXPECT_EQ(tracks.meta().unit, "um");
  EXPECT_THAT(tracks.meta().from.notes, Contains("1 row without a track id was dropped"));
}

TEST(TrackMateCsv, TimesThatAreFrameNumbers) {
  const std::string text = "TRACK_ID,POSITION_X,POSITION_Y,POSITION_T,FRAME\n0,1,2,0,0\n0,1,2,1,1\n0,1,2,2,2\n";
  EXPECT_THAT(error_of(text, {.unit = "px"}), HasSubstr("the frame rate is not in the file"));
  EXPECT_EQ(read(text, pixels()).dt(), 0.04);
  const std::string seconds =
      "TRACK_ID,POSITION_X,POSITION_Y,POSITION_T,FRAME\nTrack ID,X,Y,T,Frame\n,(pixel),(pixel),(sec),\n0,1,2,0,0\n0,1,2,1,1\n";
  EXPECT_EQ(read(seconds).dt(), 1) << "one frame a second, by the row of units";
}

TEST(Imaris, TitleTrackAndUnit) {
  const std::string head = "Position X,Position Y,Position Z,Unit,Category,Collection,Time,TrackID,ID,\n";
  const std::string rows =
      "1,2,0,um,Spot,Position,1,1000000000,0,\n3,2,0,um,Spot,Position,1,1000000001,1,\n5,2,0,um,Spot,Position,2,1000000000,2,\n";
  for (const auto& text : {head + rows, "\xEF\xBB\xBF\n Position \n ====== \n" + head + rows}) {
    const auto tracks = read(text);
    EXPECT_THAT(tracks.names(), ElementsAre("1000000000", "1000000001"));
    EXPECT_EQ(tracks.meta().unit, "um");
    EXPECT_EQ(tracks.dims(), 2);
    EXPECT_EQ(read(text, {.fps = 2}).dt(), 0.5);
  }
  EXPECT_THAT(error_of(head + rows + "5,2,0,mm,Spot,Position,3,1000000000,2,\n"), HasSubstr("several units"));
}

TEST(EthoVision, HeaderOfStatedLength) {
  const auto tracks = read(
      "\"Number of header lines:\";\"5\"\n\"Experiment\";\"Test\"\n\n\"Trial time\";\"Recording time\";\"X center\";\"Y center\"\n"
      "\"s\";\"s\";\"cm\";\"cm\"\n0,00;0,00;\"-\";\"-\"\n0,04;0,04;1,5;2\n0,08;0,08;2,5;2\n");
  EXPECT_THAT(column(tracks, 0), ElementsAre(1.5, 2.5));
  EXPECT_DOUBLE_EQ(tracks.dt(), 0.04);
  EXPECT_EQ(tracks.meta().unit, "cm");
  EXPECT_THAT(error_of("\"Number of header lines:\";\"x\"\n1;2\n"), HasSubstr("the number of header lines is missing"));
}

TEST(EthoVision, Version3) {
  const auto tracks = read("Track file,I:\\a\xFF.trk,,\nSamples,3,,\nSample no.,Time,X,Y\n1,0,1,2\n2,0.2,2,2\n3,0.4,3,2\n", {.unit = "cm"});
  EXPECT_THAT(column(tracks, 0), ElementsAre(1, 2, 3));
  EXPECT_DOUBLE_EQ(tracks.dt(), 0.2);
}

TEST(Mot, CentresOfBoxes) {
  const std::string text =
      "1,1,10,20,4,6,0.9,-1,-1,-1\n1,2,50,20,4,6,0.2,-1,-1,-1\n2,1,11,20,4,6,0.9,-1,-1,-1\n2,2,51,20,4,6,0.9,-1,-1,-1\n";
  const auto tracks = read(text, {.fps = 25});
  EXPECT_THAT(column(tracks, 0), ElementsAre(12, 52, 13, 53));
  EXPECT_THAT(column(tracks, 1), ElementsAre(23, 23, 23, 23));
  EXPECT_EQ(tracks.meta().unit, "px");
  ReadOptions options{.fps = 25};
  options.min_confidence = 0.5;
  EXPECT_EQ(read(text, options).rows(), 3);
}

TEST(Mot, DetectionsBelongToNobody) {
  EXPECT_THAT(error_of("1,-1,10,20,4,6,0.9,-1,-1,-1\n2,-1,11,20,4,6,0.9,-1,-1,-1\n", {.fps = 25}),
              HasSubstr("these are detections, every id is -1"));
}

}  // namespace
}  // namespace swarmfit
