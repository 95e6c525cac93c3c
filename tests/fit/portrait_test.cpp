// SPDX-License-Identifier: MIT
#include "fit/compare/portrait.h"

#include <gtest/gtest.h>

#include "fit/experiment/plant.h"
#include "libeval/metrics.h"
#include "libtrack/error.h"

namespace swarmfit {
namespace {

TEST(Portrait, MeasuresTheTracksAndFilmsThem) {
  const Tracks demo = demo_recording();
  const Comparison c = portrait(demo);
  EXPECT_TRUE(c.models.empty());
  EXPECT_EQ(c.recording.data.rows, demo.rows());
  EXPECT_EQ(c.film.rows(), demo.rows());
  const MetricSamples samples = metric_samples(demo);
  ASSERT_EQ(c.recording.distributions.size(), kMetrics);
  for (std::size_t m = 0; m < kMetrics; ++m) {
    EXPECT_EQ(c.recording.distributions[m].histogram.samples, samples.values[m].size()) << m;
    EXPECT_TRUE(c.recording.defined[m]) << m;
    EXPECT_GT(c.recording.axis_width[m], 0) << m;
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
  EXPECT_FALSE(c.recording.defined[kDistance]);
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

// The second one's frames have other numbers, and its film plays beside the first one's all the same.
TEST(Portrait, OfTwoBeginsBothTogether) {
  const Tracks demo = demo_recording();
  TrackColumns columns;
  columns.names = demo.names();
  columns.track.assign(demo.track().begin(), demo.track().end());
  columns.pos = 2 * demo.pos();
  for (const std::int64_t frame : demo.frame()) columns.frame.push_back(frame + 1000);
  const Tracks other(columns, demo.meta());
  const Evaluation e = evaluate(demo, other, Binning{});
  const PairPortrait p = portrait(demo, other, e);
  const Comparison& c = p.comparison;
  EXPECT_EQ(c.run.command, "evaluate");
  ASSERT_EQ(c.models.size(), 1U);
  EXPECT_EQ(c.models[0].film.rows(), demo.rows());
  EXPECT_EQ(c.models[0].film.frames().front().number, c.film.frames().front().number);
  EXPECT_EQ(p.simulation.first_frame, c.recording.data.first_frame + 1000);
  EXPECT_NEAR(p.simulation.speed, 2 * c.recording.data.speed, 1e-9 * c.recording.data.speed);
  for (std::size_t m = 0; m < kMetrics; ++m) {
    EXPECT_EQ(c.models[0].runs.raw_energies[m], e.raw_energies[m]) << m;
    EXPECT_EQ(c.recording.distributions[m].histogram.samples, e.real_distribution[m].histogram.samples) << m;
    EXPECT_EQ(c.recording.axis_width[m], e.axis_width[m]) << m;
    EXPECT_TRUE(c.recording.defined[m]) << m;
  }
}

}  // namespace
}  // namespace swarmfit
