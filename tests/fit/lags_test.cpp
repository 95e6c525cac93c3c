// SPDX-License-Identifier: MIT
// Fits at several lags.
#include "libeval/lags.h"

#include <gmock/gmock.h>
#include <omp.h>

#include <cmath>
#include <filesystem>

#include "fit/compare/across.h"
#include "fit/compare/compare.h"
#include "fit/compare/facts.h"
#include "fit/experiment/objective.h"
#include "libeval/localisation.h"
#include "libtrack/error.h"
#include "libtrack/read/read.h"
#include "tests/fit/planted.h"

namespace swarmfit {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

CompareOptions tiny(std::vector<int> lags) {
  CompareOptions o;
  for (const char* name : {"bswarm", "boids", "langevin"}) o.models.push_back(parse_model(name));
  o.binning = Binning::standard(Normalisation::reference);
  o.budget = {"tiny", {8, 3, 2}, {4, 2, 2}, 3, 3, 2};
  o.bootstrap_recordings = 9;
  o.lags = std::move(lags);
  return o;
}

// A second and a half, so that an eighth of it carries lag 4.
Tracks swarm(double sigma = 0) {
  const auto model = parse_model("bswarm");
  auto o = test::small_swarm(3);
  o.frames = 150;
  o.sigma = sigma;
  return plant(model, scene_parameters(model, test::midge_parameters()), o);
}

TEST(CompareAtLags, EveryTableHasEveryColumn) {
  const Comparison c = compare(swarm(), tiny({1, 4}));
  ASSERT_EQ(c.recording.columns, columns_at({1, 4}));
  const std::size_t n = 12;
  EXPECT_EQ(c.ranking.weights.size(), n);
  EXPECT_EQ(c.ranking.p1.size(), n);
  EXPECT_EQ(c.recording.axis_width.size(), n);
  EXPECT_EQ(c.recording.observation.used.size(), n);
  EXPECT_EQ(c.recording.skill.floor.size(), n);
  EXPECT_EQ(c.recording.skill.null.size(), n);
  EXPECT_EQ(c.run.history.front().raw.size(), n);
  double weight = 0, by_lag = 0;
  for (const double w : c.ranking.weights) weight += w;
  EXPECT_NEAR(weight, 1, 1e-12);
  for (const LagFacts& l : c.ranking.lags) by_lag += l.weight;
  EXPECT_NEAR(by_lag, 1, 1e-12);
  ASSERT_EQ(c.ranking.lags.size(), 3u);
  EXPECT_EQ(c.ranking.lags[1].lag, 4);
  EXPECT_EQ(c.ranking.lags[1].scored, 5);
  EXPECT_EQ(c.ranking.lags[2].lag, 0);
  EXPECT_NEAR(c.ranking.lags[2].weight, c.ranking.weights[kDistance] + c.ranking.weights[kVelocityDifference], 1e-15);
  ASSERT_EQ(c.ranking.without.size(), 3u);
  EXPECT_EQ(c.ranking.without[0].weights.size(), n);
  for (const ModelFit& fit : c.models) {
    for (const auto* values : {&fit.runs.raw_energies, &fit.runs.raw_se, &fit.standing.energies, &fit.runs.half_step_energies,
                               &fit.runs.mean_ratio, &fit.runs.sd_ratio, &fit.runs.outside_fraction, &fit.likeness.total_variation,
                               &fit.likeness.wasserstein, &fit.standing.sensitivity.without})
      ASSERT_EQ(values->size(), n) << fit.model;
    for (std::size_t j = 0; j < n; ++j) EXPECT_TRUE(std::isfinite(fit.runs.raw_energies[j])) << c.recording.columns[j].key();
    for (std::size_t j = kMetrics; j < n; ++j) EXPECT_LE(fit.likeness.total_variation[j], 1);
    EXPECT_TRUE(std::isfinite(fit.likeness.skill.value));
  }
}

TEST(CompareAtLags, TheColumnsOfLagOneAreThoseOfAFitAtLagOne) {
  const Tracks recording = swarm(0.01);
  const auto model = parse_model("bswarm");
  Conditions one = make_conditions(recording, {}), two = make_conditions(recording, {});
  two.metrics.lags = {1, 4};
  const Binning binning = Binning::standard(Normalisation::separate);
  const Target target_one(metric_samples(recording, one.metrics), binning), target_two(metric_samples(recording, two.metrics), binning);
  const auto truth = scene_parameters(model, test::midge_parameters());
  const auto seeds = replicate_seeds({1}, Stream::replicate, 2);
  const Outcome a = Objective(model, one, target_one).evaluate(truth, seeds), b = Objective(model, two, target_two).evaluate(truth, seeds);
  ASSERT_EQ(b.raw.size(), 12u);
  for (std::size_t m = 0; m < kMetrics; ++m) EXPECT_EQ(a.raw[m], b.raw[m]);
  for (std::size_t j = 0; j < 12; ++j) EXPECT_GT(b.raw[j], 0) << j;
}

TEST(CompareAtLags, SameBitsForAnyNumberOfThreads) {
  const Tracks recording = swarm(0.5);
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const Comparison one = compare(recording, tiny({}));
  omp_set_num_threads(4);
  const Comparison many = compare(recording, tiny({}));
  omp_set_num_threads(before);
  EXPECT_EQ(one.recording.columns, many.recording.columns);
  EXPECT_EQ(one.ranking.weights, many.ranking.weights);
  ASSERT_EQ(one.run.history.size(), many.run.history.size());
  for (std::size_t k = 0; k < one.run.history.size(); ++k) EXPECT_EQ(one.run.history[k].raw, many.run.history[k].raw) << k;
}

TEST(CompareAtLags, ChoosesThemByTheErrorOfEveryColumn) {
  auto options = tiny({});
  options.models.resize(1);
  const Comparison clean = compare(swarm(), options), noisy = compare(swarm(0.5), options);
  EXPECT_THAT(lags_of(clean.recording.columns), ElementsAre(1));
  ASSERT_EQ(lags_of(noisy.recording.columns).size(), 2u);
  EXPECT_TRUE(noisy.recording.observation.error_dominated[kJerk]);
  EXPECT_TRUE(!noisy.recording.observation.error_dominated[7 + kJerk] ||
              noisy.ranking.lags[1].lag == noisy.recording.observation.longest_lag);
  EXPECT_GT(noisy.ranking.lags[0].error_share, 0.5);
  EXPECT_LT(noisy.ranking.lags[1].error_share, noisy.ranking.lags[0].error_share);
  // To the paper's protocol error is nothing special.
  options.error_limit = 1;
  EXPECT_THAT(lags_of(compare(swarm(0.5), options).recording.columns), ElementsAre(1));
}

// As much error again, added by hand, is what differences have to exceed in the columns that are mostly error, and only there.
TEST(CompareAtLags, WhatErrorDrownsCountsBeyondAsMuchErrorAgain) {
  const Conditions c = make_conditions(swarm(0.5), {});
  const Target target(metric_samples(c.recording, c.metrics), Binning::standard(Normalisation::reference));
  auto options = tiny({1});
  options.resolution = false;
  PerColumn<bool> error_dominated(kMetrics, false);
  EXPECT_EQ(resolution(c, target, options, error_dominated), PerColumn<double>(kMetrics, 0.0));
  error_dominated[kJerk] = true;
  const PerColumn<double> floor = resolution(c, target, options, error_dominated);
  const MetricSamples again = metric_samples(with_error(c.recording, c.sigma, options.seed), c.metrics);
  EXPECT_EQ(floor[kJerk], target.energies(target.distributions(again))[kJerk]);
  EXPECT_GT(floor[kJerk], 1) << "error doubled its variance";
  for (std::size_t j = 0; j < kMetrics; ++j) EXPECT_EQ(floor[j] > 0, j == kJerk);
}

TEST(CompareAtLags, WhatErrorDrownsIsScoredAndLimitsP2) {
  auto options = tiny({1});
  options.resolution = false;
  const Tracks recording = swarm(0.5);
  const Comparison floored = compare(recording, options);
  ASSERT_TRUE(floored.recording.observation.error_dominated[kJerk] && floored.recording.observation.used[kJerk]);
  EXPECT_GT(floored.recording.resolution[kJerk], 0);
  EXPECT_GE(floored.ranking.p2[kJerk], floored.recording.resolution[kJerk]);
  EXPECT_FALSE(floored.recording.observation.error_dominated[kDistance]);
  EXPECT_EQ(floored.recording.resolution[kDistance], 0);
  options.error_limit = 1;
  EXPECT_EQ(compare(recording, options).recording.resolution[kJerk], 0);
}

TEST(CompareAtLags, SaysWhenEvenTheLongestLagIsDrowned) {
  auto options = tiny({1});
  options.models.resize(1);
  EXPECT_THAT(compare(swarm(0.5), options).warnings, Contains(HasSubstr("may show motion: --lags")));
  options.lags = {};
  EXPECT_THAT(compare(swarm(30), options).warnings, Contains(HasSubstr("too short for a longer lag")));
}

// An eighth of 150 frames has 18: a jerk at lag 8 needs 25, an acceleration 17.
TEST(CompareAtLags, TheSkillDoesWithoutLagsThatAreTooLongForIt) {
  for (const auto& lags : {std::vector<int>{1, 8}, std::vector<int>{8}}) {
    auto options = tiny(lags);
    options.models.resize(1);
    const Comparison c = compare(swarm(), options);
    EXPECT_TRUE(std::isfinite(c.models[0].likeness.skill.value));
    EXPECT_THAT(c.warnings, Contains(HasSubstr("Skill leaves out alpha@8, mu@8")));
    EXPECT_GT(c.ranking.weights.back(), 0) << "the score does not";
  }
}

TEST(CompareAtLags, RefusesLagsThatTheTracksDoNotCarry) {
  EXPECT_THROW(compare(swarm(), tiny({50})), InputError);
  auto options = tiny({1, 4});
  options.conditions.velocity = VelocitySource::recorded;
  EXPECT_THROW(compare(swarm(), options), InputError);
}

// Two recordings for which different lags were chosen.
TEST(CompareAtLags, SummariesHaveTheColumnsOfAllRecordings) {
  Comparison one, two;
  one.ranking.weights = PerColumn<double>(7, 1.0 / 7);
  two.recording.columns = columns_at({1, 8});
  two.ranking.weights = PerColumn<double>(12, 1.0 / 12);
  const Across a = across(std::vector<Comparison>{one, two});
  ASSERT_EQ(a.columns.size(), 12u);
  EXPECT_TRUE(std::isnan(a.weights[0][11]));
  EXPECT_NEAR(a.mean_weight[0], (1.0 / 7 + 1.0 / 12) / 2, 1e-15);
  EXPECT_NEAR(a.mean_weight[11], 1.0 / 12, 1e-15);
  EXPECT_NEAR(a.smallest_weight[11], 1.0 / 12, 1e-15);
}

// At 100 Hz the jerk of midges is measurement error; a longer lag brings every metric under the limit.
TEST(CompareAtLags, MidgesNeedMoreThanOneFrame) {
  const auto path = std::string(SWARMFIT_SOURCE_DIR) + "/../shared/data/midge-lab-3d/BiologicalSwarmTimeSeries.txt";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "SKIPPED: the midge recording is not at " << path;
  ReadOptions read;
  read.columns = "id,x,y,z,t,_,_,_,_,_,_";
  read.unit = "mm";
  const Conditions c = make_conditions(read_tracks(path, read), {});
  ASSERT_TRUE((c.sigma > 0).any());
  const auto lags = choose_lags(c.recording, c.sigma, 0.5, 1);
  ASSERT_EQ(lags.size(), 2u);
  const auto share = error_share(c.recording, c.sigma, 1, lags);
  EXPECT_GT(share[kJerk], 0.5);
  for (std::size_t m = 0; m < kMotionMetrics; ++m) EXPECT_LT(share[kMetrics + m], 0.5) << kMetricInfo[m].key;
}

}  // namespace
}  // namespace swarmfit
