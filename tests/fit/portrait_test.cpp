// SPDX-License-Identifier: MIT
#include "fit/portrait.h"

#include <gtest/gtest.h>

#include "fit/plant.h"
#include "libeval/metrics.h"
#include "libtrack/error.h"

namespace swarmfit {
namespace {

TEST(Portrait, MeasuresTheTracksAndFilmsThem) {
  const Tracks demo = demo_recording();
  const Comparison c = portrait(demo);
  EXPECT_TRUE(c.models.empty());
  EXPECT_EQ(c.data.rows, demo.rows());
  EXPECT_EQ(c.film.rows(), demo.rows());
  const MetricSamples samples = metric_samples(demo);
  ASSERT_EQ(c.recording.size(), kMetrics);
  for (std::size_t m = 0; m < kMetrics; ++m) {
    EXPECT_EQ(c.recording[m].histogram.samples, samples.values[m].size()) << m;
    EXPECT_TRUE(c.defined[m]) << m;
    EXPECT_GT(c.axis_width[m], 0) << m;
  }
}

// One individual that never moves: nothing can be measured, and there is still something to show.
TEST(Portrait, OfSomebodyAloneAndStill) {
  TrackColumns columns;
  columns.names = {"a"};
  columns.track = {0, 0};
  columns.frame = {1, 2};
  columns.pos.setZero(2, 3);
  TrackMeta meta;
  meta.dt = 1;
  const Comparison c = portrait(Tracks(columns, meta));
  EXPECT_EQ(c.film.rows(), 2);
  EXPECT_FALSE(c.defined[kDistance]);
}

TEST(Portrait, OfNobodyIsRefused) { EXPECT_THROW(portrait(Tracks()), InputError); }

TEST(SceneTable, HasTheRowsThatTheSettingsUse) {
  const ModelChoice white = parse_model("bswarm[noise=white]"), curl = parse_model("bswarm");
  const auto table = [](const ModelChoice& model) { return scene_table(model, scene_parameters(model, {{"gamma", 7}}), "mm"); };
  const auto has = [](const auto& rows, const char* name) {
    return std::any_of(rows.begin(), rows.end(), [&](const ParameterResult& p) { return p.name == name; });
  };
  EXPECT_TRUE(has(table(curl), "scale"));
  EXPECT_FALSE(has(table(white), "scale"));
  for (const ParameterResult& p : table(curl))
    if (p.name == "gamma") {
      EXPECT_EQ(p.value, 7);
      EXPECT_EQ(p.unit, "1/mm");
    }
}

}  // namespace
}  // namespace swarmfit
