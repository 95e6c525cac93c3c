// SPDX-License-Identifier: MIT
#include "libeval/timeline.h"

#include <gmock/gmock.h>

#include "tests/eval/build.h"

namespace swarmfit {
namespace {

using testing::ElementsAre;

// One without a gap that jumps at frame 4, one that is lost in frame 2 and gone after 3.
TEST(Timeline, ByHand) {
  std::vector<test::Row> rows;
  for (int f = 0; f < 6; ++f) rows.push_back({0, f, {f < 4 ? 1.0 * f : 100 + 1.0 * f, 0, 0}});
  for (const int f : {0, 1, 3}) rows.push_back({1, f, {1.0 * f, 5, 0}});
  const Timeline t = timeline(test::tracks_of(rows));
  EXPECT_EQ(t.stride, 1);
  EXPECT_THAT(t.seen, ElementsAre(2, 2, 1, 2, 1, 1));
  EXPECT_THAT(t.missing, ElementsAre(0, 0, 1, 0, 0, 0));
  EXPECT_THAT(t.jumps, ElementsAre(0, 0, 0, 0, 1, 0));
}

TEST(Timeline, LongRecordingsAreBinned) {
  std::vector<test::Row> rows;
  for (int f = 0; f < 250; ++f) rows.push_back({0, f, {1.0 * f, 0, 0}});
  const Timeline t = timeline(test::tracks_of(rows));
  EXPECT_EQ(t.stride, 3);
  EXPECT_EQ(t.seen.size(), 84u);
  EXPECT_THAT(t.seen, testing::Each(1)) << "the last bin is shorter, and a mean too";
  EXPECT_TRUE(timeline(Tracks()).seen.empty());
}

}  // namespace
}  // namespace swarmfit
