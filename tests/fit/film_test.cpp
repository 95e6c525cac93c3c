// SPDX-License-Identifier: MIT
#include "fit/experiment/film.h"

#include <gtest/gtest.h>

#include "fit/compare/compare.h"
#include "fit/experiment/objective.h"
#include "fit/experiment/plant.h"
#include "libtrack/cut.h"

namespace swarmfit {
namespace {

// `each` individuals in every `stride`-th frame.
Tracks crowd(std::int64_t frames, Index each, std::int64_t stride = 1) {
  TrackColumns c;
  c.names.resize(static_cast<std::size_t>(each));
  c.pos.setZero(frames * each, 3);
  for (std::int64_t f = 0; f < frames; ++f)
    for (Index i = 0; i < each; ++i) c.track.push_back(static_cast<std::uint32_t>(i)), c.frame.push_back(100 + stride * f);
  TrackMeta meta;
  meta.dt = 0.1;
  return {std::move(c), meta};
}

TEST(FilmSpan, IsAllOfAShortRecording) {
  const FilmSpan span = film_span(crowd(30, 4), 3);
  EXPECT_EQ(span.first, 100);
  EXPECT_EQ(span.last, 130);
}

TEST(FilmSpan, KeepsBothLimits) {
  EXPECT_EQ(film_span(crowd(2000, 1), 1).last, 100 + 600);
  EXPECT_EQ(film_span(crowd(2000, 1, 3), 1).last, 100 + 3 * 599 + 1);  // frames with nobody are no frames
  EXPECT_EQ(film_span(crowd(400, 1000), 6).last, 100 + 83);            // 6 films × 83 frames × 1000 individuals
  EXPECT_EQ(film_span(crowd(3, 600000), 1).last, 100 + 1);             // but one at least
}

TEST(FilmSpan, OfNobodyIsEmpty) {
  const FilmSpan span = film_span(Tracks(), 2);
  EXPECT_EQ(span.first, span.last);
}

void expect_equal(const Tracks& a, const Tracks& b) {
  ASSERT_EQ(a.rows(), b.rows());
  EXPECT_TRUE((a.pos() == b.pos()).all());
  EXPECT_TRUE(std::equal(a.frame().begin(), a.frame().end(), b.frame().begin()));
  EXPECT_TRUE(std::equal(a.track().begin(), a.track().end(), b.track().begin()));
}

// What is shown is one of the simulations behind the score: a run of its own on the first final seed gives the same bits.
TEST(Comparison, FilmIsTheFirstFinalReplicate) {
  const Tracks demo = demo_recording();
  const Tracks recording = cut(demo, demo.frames().front().number, demo.frames().front().number + 40);
  CompareOptions options;
  options.models = {parse_model("brownian"), parse_model("langevin")};
  options.budget = budget_named("quick");
  options.max_evaluations = 20;
  options.bootstrap_recordings = 0;
  const Comparison c = compare(recording, options);
  expect_equal(c.film, recording);
  Conditions conditions = make_conditions(recording, options.conditions);
  const Target target(metric_samples(conditions.recording, conditions.metrics), options.binning);
  const Rng first = replicate_seeds({options.seed}, Stream::final_seeds, options.budget.final_replicates).front();
  for (const ModelFit& fit : c.models) {
    const ModelChoice model = parse_model(fit.model);
    const Tracks again = Ensemble(model, conditions).run({parameter_values(model, fit), first}).seen;
    expect_equal(fit.film, again);
    EXPECT_EQ(fit.film.rows(), recording.rows()) << fit.model;  // seen where and when the recorded ones are
  }
}

}  // namespace
}  // namespace swarmfit
