// SPDX-License-Identifier: MIT
// Recordings in XML.
#include <gmock/gmock.h>

#include "libtrack/read/branches.h"
#include "tests/track/build.h"

namespace swarmfit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

// By brute force: the individuals of a chain, a split, a merge, and a cell that splits while it merges.
TEST(Branches, EndWhereTracksSplitOrMerge) {
  using Lists = std::vector<std::vector<std::uint32_t>>;
  EXPECT_EQ(branches({{1, 2}, {0, 1}}, {0, 1, 2}), (Lists{{0, 1, 2}})) << "edges in any order";
  EXPECT_EQ(branches({{0, 1}, {1, 2}, {1, 3}, {3, 4}}, {0, 1, 2, 2, 3}), (Lists{{0, 1}, {2}, {3, 4}}));
  EXPECT_EQ(branches({{0, 2}, {1, 2}, {2, 3}}, {0, 0, 1, 2}), (Lists{{0}, {1}, {2, 3}}));
  EXPECT_EQ(branches({{0, 2}, {1, 2}, {2, 3}, {2, 4}}, {0, 0, 1, 2, 2}), (Lists{{0}, {1}, {2}, {3}, {4}}));
}

const std::string kHead = R"(<?xml version="1.0" encoding="UTF-8"?>
<TrackMate version="7.0"><Log>any text</Log>
<Model spatialunits="µm" timeunits="min"><AllSpots nspots="5">
<SpotsInFrame frame="0"><Spot ID="5" FRAME="0" POSITION_X="1" POSITION_Y="2" POSITION_Z="0"/></SpotsInFrame>
<SpotsInFrame frame="1"><Spot ID="9" FRAME="1" POSITION_X="3" POSITION_Y="4" POSITION_Z="0"/>
<Spot ID="7" FRAME="1" POSITION_X="30" POSITION_Y="40" POSITION_Z="0"/></SpotsInFrame>
<SpotsInFrame frame="3"><Spot ID="6" FRAME="3" POSITION_X="5" POSITION_Y="6" POSITION_Z="0"/>
<Spot ID="4" FRAME="3" POSITION_X="50" POSITION_Y="60" POSITION_Z="0"/></SpotsInFrame>
</AllSpots><AllTracks>
)";
const std::string kTail = R"(</AllTracks><FilteredTracks><TrackID TRACK_ID="2"/></FilteredTracks></Model>
<Settings><ImageData timeinterval="0.5"/></Settings></TrackMate>)";

std::string edge(int from, int to) {
  return "<Edge SPOT_SOURCE_ID=\"" + std::to_string(from) + "\" SPOT_TARGET_ID=\"" + std::to_string(to) + "\"/>\n";
}

TEST(TrackMate, SpotsEdgesAndFilters) {
  const auto bytes =
      kHead + "<Track TRACK_ID=\"2\">" + edge(9, 6) + edge(5, 9) + "</Track><Track TRACK_ID=\"3\">" + edge(7, 4) + "</Track>" + kTail;
  const auto tracks = read(bytes);
  EXPECT_EQ(tracks.meta().from.format, "trackmate");
  EXPECT_EQ(tracks.meta().unit, "um");
  EXPECT_EQ(tracks.dt(), 30);
  EXPECT_EQ(tracks.dims(), 2) << "z is always the same";
  EXPECT_THAT(tracks.names(), ElementsAre("2"));
  ASSERT_EQ(tracks.rows(), 3);
  EXPECT_EQ(tracks.frame()[2], 3) << "the gap stays a gap";
  EXPECT_EQ(tracks.pos()(2, 0), 5);
  EXPECT_THAT(tracks.meta().from.notes,
              ElementsAre("tracks that TrackMate's filters reject, left out: 1", "spots that belong to no track, left out: 2 of 5"));
}

TEST(TrackMate, ASplitEndsOneIndividualAndBeginsTwo) {
  const auto tracks = read(kHead + "<Track TRACK_ID=\"2\">" + edge(5, 9) + edge(9, 6) + edge(9, 4) + "</Track>" + kTail);
  EXPECT_THAT(tracks.names(), ElementsAre("2-1", "2-2", "2-3"));
  EXPECT_EQ(tracks.rows(), 4);
  EXPECT_THAT(tracks.meta().from.notes[0], "tracks that split or merge, cut there: 1, into 3 individuals");
}

TEST(TrackMate, FaultsHaveTheirLine) {
  EXPECT_THAT(error_of(kHead + "<Track TRACK_ID=\"2\">" + edge(5, 99) + "</Track>" + kTail), StartsWith("f.csv:10: there is no spot '99'"));
  EXPECT_THAT(error_of(kHead + "<Track TRACK_ID=\"2\">" + edge(9, 7) + "</Track>" + kTail), HasSubstr("joins two spots of one frame"));
  EXPECT_THAT(error_of(kHead + kTail), HasSubstr("there are no tracks in it, only spots"));
  EXPECT_THAT(error_of(kHead), HasSubstr("this is not well-formed XML"));
  EXPECT_THAT(error_of("<?xml version=\"1.0\"?><kml/>"), HasSubstr("is an XML file of no known layout"));
  auto wrong = kHead;
  wrong.replace(wrong.find("POSITION_X=\"3\""), 14, "POSITION_X=\"w\"");
  EXPECT_EQ(error_of(wrong + kTail), "f.csv:5: POSITION_X of a Spot is 'w'; expected a number");
}

TEST(TrackMate, ExportedTracks) {
  const auto tracks = read(R"(<Tracks nTracks="1" spaceUnits="pixel" frameInterval="0.1" timeUnits="sec">
<particle nSpots="2"><detection t="4" x="1" y="2" z="0"/><detection t="5" x="3" y="4" z="1"/></particle></Tracks>)");
  EXPECT_EQ(tracks.dims(), 3);
  EXPECT_EQ(tracks.dt(), 0.1);
  EXPECT_EQ(tracks.frame()[1], 5);
}

std::string point(const std::string& lat, const std::string& time) {
  return "<trkpt lat=\"" + lat + "\" lon=\"8.5\"><ele>400</ele>" + (time.empty() ? "" : "<time>" + time + "</time>") + "</trkpt>\n";
}
std::string gpx(const std::string& tracks) { return "<?xml version=\"1.0\"?>\n<gpx version=\"1.1\">\n" + tracks + "</gpx>\n"; }

// A degree of latitude is 110.574 km at the equator and 111.694 km at the poles; at 47 degrees north 111.17 km (WGS 84).
TEST(Gpx, TracksInMetres) {
  const auto tracks = read(gpx("<wpt lat=\"1\" lon=\"2\"/><trk><name>ox</name><trkseg>\n" + point("47.000", "2020-01-01T00:00:00Z") +
                               point("47.001", "2020-01-01T00:00:01Z") + point("47.002", "2020-01-01T00:00:02Z") +
                               "</trkseg><trkseg></trkseg><trkseg>" + point("47.010", "2020-01-01T00:00:10Z") +
                               "</trkseg></trk><trk><trkseg>" + point("47.002", "2020-01-01T00:00:00Z") + "</trkseg></trk>"));
  EXPECT_EQ(tracks.meta().from.format, "gpx");
  EXPECT_THAT(tracks.names(), ElementsAre("2", "ox"));
  EXPECT_EQ(tracks.meta().unit, "m");
  EXPECT_EQ(tracks.dt(), 1);
  EXPECT_EQ(tracks.dims(), 2);
  const auto rows = tracks.rows_of(1);
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_NEAR(tracks.pos()(rows[1], 1) - tracks.pos()(rows[0], 1), 111.17, 0.01);
  EXPECT_EQ(tracks.next()[static_cast<std::size_t>(rows[2])], -1) << "a hole between the segments";
}

TEST(Gpx, WithoutTimesItIsNoRecording) {
  EXPECT_EQ(error_of(gpx("<trk><trkseg>\n" + point("47", "") + "</trkseg></trk>")),
            "f.csv:4: the point has no time; expected one in every point: without times it is a route and no recording");
  EXPECT_THAT(error_of(gpx("<trk><trkseg>" + point("47", "12:00:00") + "</trkseg></trk>")), HasSubstr("'12:00:00' is not a time"));
  EXPECT_THAT(error_of(gpx("<trk><trkseg>" + point("north", "2020-01-01T00:00:00Z") + "</trkseg></trk>")),
              HasSubstr("lat is 'north'; expected degrees"));
  EXPECT_THAT(error_of(gpx("<trk/>")), HasSubstr("there are 1 tracks without a point in it"));
}

}  // namespace
}  // namespace swarmfit
