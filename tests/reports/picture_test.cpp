// SPDX-License-Identifier: MIT
#include "reports/draw/picture.h"

#include <gmock/gmock.h>

#include "libtrack/error.h"

namespace swarmfit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

struct Seen {
  std::uint32_t track;
  std::int64_t frame;
  double x, y;
};

Tracks planar(const std::vector<Seen>& seen, std::uint32_t tracks) {
  TrackColumns columns;
  columns.pos = Rows::Zero(static_cast<Index>(seen.size()), 3);
  for (std::uint32_t t = 0; t < tracks; ++t) columns.names.push_back(std::to_string(t));
  for (std::size_t k = 0; k < seen.size(); ++k) {
    columns.track.push_back(seen[k].track);
    columns.frame.push_back(seen[k].frame);
    columns.pos(static_cast<Index>(k), 0) = seen[k].x;
    columns.pos(static_cast<Index>(k), 1) = seen[k].y;
  }
  TrackMeta meta;
  meta.dims = 2;
  meta.dt = 0.1;
  meta.unit = "mm";
  return {columns, meta};
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

// The page is 720 wide with a margin of 28: motion over 664 mm to the right is drawn at one unit per mm, at half its free height of 368.
TEST(Picture, PlacesAreToScale) {
  const auto svg = picture_svg(planar({{0, 0, 0, 5}, {0, 1, 664, 5}}, 1), "one");
  EXPECT_THAT(svg, HasSubstr("M28.0 212.0L692.0 212.0"));
  EXPECT_THAT(svg, HasSubstr(">100 mm</text>"));
  EXPECT_THAT(svg, HasSubstr("h100.0\""));
}

TEST(Picture, UpIsUp) {
  const auto svg = picture_svg(planar({{0, 0, 0, 0}, {0, 1, 0, 368}}, 1), "one");
  EXPECT_THAT(svg, HasSubstr("M360.0 396.0L360.0 28.0"));
}

TEST(Picture, GapsBreakTailsAndTheAbsentAreNotDrawn) {
  const auto svg = picture_svg(planar({{0, 0, 0, 0}, {0, 1, 10, 0}, {0, 3, 30, 0}, {0, 4, 40, 0}, {1, 0, 0, 9}, {1, 1, 10, 9}}, 2), "two");
  EXPECT_EQ(count(svg, "class=\"h\""), 1u);
  EXPECT_EQ(count(svg, "<path class=\"t"), 2u);  // 0-1 and 3-4, of different age
}

TEST(Picture, TitleIsEscapedAndNobodyIsAnError) {
  EXPECT_THAT(picture_svg(planar({{0, 0, 0, 0}}, 1), "a<b&c"), HasSubstr("<title>a&lt;b&amp;c</title>"));
  TrackMeta meta;
  meta.dt = 1;
  TrackColumns nobody;
  nobody.pos.resize(0, 3);
  EXPECT_THROW(picture_svg(Tracks(nobody, meta), "none"), InputError);
}

// One mm of the page per mm, from (28, 396) for the lower left corner of the box.
TEST(Picture, ShowsWhatIsAround) {
  Scenery scenery;
  scenery.box = Scenery::Box{{0, 0, 0}, {664, 368, 0}};
  scenery.balls = {{{100, 100, 0}, 50}};
  scenery.solids = {{{{200, 0, 0}, {300, 0, 0}, {300, 10, 0}, {200, 10, 0}}, {{0, 1, 2, 3}}}};
  scenery.marks = {{Scenery::Mark::Kind::repel, 0}, {Scenery::Mark::Kind::goal, 20}};
  scenery.seen = planar({{0, 0, 0, 0}, {0, 1, 400, 0}, {1, 0, 500, 0}, {1, 1, 500, 0}}, 2);
  const auto svg = picture_svg(planar({{0, 0, 0, 0}, {0, 1, 10, 0}}, 1), "one", scenery);
  EXPECT_THAT(svg, HasSubstr("<circle class=\"solid\" cx=\"128.0\" cy=\"296.0\" r=\"50.0\"/>"));
  EXPECT_THAT(svg, HasSubstr("d=\"M228.0 396.0L328.0 396.0 328.0 386.0 228.0 386.0z\""));
  EXPECT_THAT(svg, HasSubstr("class=\"threat\" d=\"M428.0 390.0"));  // where it is in the last frame
  EXPECT_THAT(svg, HasSubstr("<circle class=\"goal\" cx=\"528.0\" cy=\"396.0\" r=\"20.0\"/>"));
  EXPECT_THAT(svg, HasSubstr(">repels</text>"));
  EXPECT_THAT(svg, Not(HasSubstr(">attracts</text>")));
}

TEST(Picture, KindsHaveColoursAndNames) {
  TrackColumns columns;
  columns.track = {0, 1};
  columns.frame = {0, 0};
  columns.kind = {0, 1};
  columns.names = {"0", "1"};
  columns.pos = Rows::Zero(2, 3);
  columns.pos(1, 0) = 1;
  TrackMeta meta;
  meta.dims = 2;
  meta.dt = 1;
  meta.kinds = {"sheep", "dog"};
  const auto svg = picture_svg({columns, meta}, "both");
  for (const char* said : {"color=\"#0072b2\"", "color=\"#d55e00\"", ">sheep</text>", ">dog</text>"}) EXPECT_THAT(svg, HasSubstr(said));
}

}  // namespace
}  // namespace swarmfit
