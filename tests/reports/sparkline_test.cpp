// SPDX-License-Identifier: MIT
#include "reports/draw/sparkline.h"
#include "reports/comparison/ranking_text.h"
#include "reports/recording/recording_text.h"

#include <gmock/gmock.h>

#include <sstream>

#include "libeval/summary.h"
#include "tests/reports/sample.h"

namespace swarmfit {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(Sparkline, HasEightHeights) {
  EXPECT_EQ(sparkline({0, 1, 2, 3, 4, 5, 6, 7, 8}), "▁▂▃▄▅▆▇██");
  EXPECT_EQ(sparkline({1000, 0}), "█▁");
  EXPECT_EQ(sparkline({}), "–");
  EXPECT_EQ(sparkline({0, 0}), "–");
}

Histogram histogram(std::vector<std::uint64_t> counts) {
  Histogram h;
  for (const auto n : counts) h.samples += n;
  h.counts = std::move(counts);
  return h;
}

// The recording in the bins 2 to 6 of 12, one model there, one far above, one without samples. Six cells of one bin: the name leaves no
// more.
TEST(Shapes, AreOnTheRecordingsRange) {
  PerColumn<Distribution> recording, same, above, none;
  for (std::size_t m = 0; m < kMetrics; ++m) {
    recording[m].histogram = same[m].histogram = histogram({1, 0, 10, 20, 40, 20, 10, 0, 0, 0, 0, 3});
    above[m].histogram = histogram({0, 0, 0, 0, 0, 0, 0, 0, 0, 100, 0, 0});
  }
  Shapes s{{{"recording", &recording}, {"same", &same}, {"above", &above}, {"a name of many letters that leaves no room", &none}},
           columns_at({1}),
           PerColumn<double>(kMetrics, 0.0),
           PerColumn<double>(kMetrics, 10.0),
           "mm"};
  const std::string text = shapes_text(s, 0, "distribution", {});
  EXPECT_THAT(text, HasSubstr("  ▃▅█▅▃  ▃▅█▅▃")) << text;
  EXPECT_THAT(text, HasSubstr("  ▁▁▁▁█  ▁▁▁▁█")) << "what lies beyond is counted at the end";
  EXPECT_THAT(text, HasSubstr(" from ")) << text;
  EXPECT_THAT(text, testing::ContainsRegex("from +20 +20"));
  EXPECT_THAT(text, testing::ContainsRegex("to +70 +70"));
  EXPECT_THAT(text, HasSubstr("mm/s²"));
  EXPECT_THAT(shapes_text(s, 0, "distribution", {.colour = false, .unicode = false}), IsEmpty());
}

TEST(Shapes, StandBesideEachOtherInTheRanking) {
  const std::string text = ranking_text(sample_comparison(), {}, Detail::all);
  EXPECT_THAT(text, HasSubstr("\n distribution "));
  EXPECT_THAT(text, HasSubstr("distribution: each scaled to its own peak"));
  EXPECT_THAT(ranking_text(sample_comparison(), {.colour = false, .unicode = false}, Detail::all), Not(HasSubstr("distribution: each")));
  std::istringstream in(ranking_text(sample_at_lags(), {}, Detail::all));
  for (std::string line; std::getline(in, line);) EXPECT_LE(display_width(line), 80u) << line;
}

TEST(Shapes, OfARecordingAreDescribed) {
  Summary s{};
  s.speed.shape = {0, 4, 8, 4, 0};
  TrackMeta meta;
  meta.dt = 0.01;
  EXPECT_THAT(describe_text(meta, s, {}), HasSubstr("▁▅█▅▁"));
  EXPECT_THAT(describe_text(meta, s, {.colour = false, .unicode = false}), Not(HasSubstr("5 to 95 %")));
}

}  // namespace
}  // namespace swarmfit
