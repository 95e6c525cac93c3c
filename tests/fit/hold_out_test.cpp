// SPDX-License-Identifier: MIT
#include "fit/compare/hold_out.h"

#include <gmock/gmock.h>

#include <cmath>

#include "fit/experiment/objective.h"
#include "fit/study/recovery.h"
#include "libeval/nearness.h"
#include "libswarm/reference_set.h"
#include "libtrack/error.h"
#include "tests/fit/planted.h"

namespace swarmfit {
namespace {

Tracks film(std::int64_t frames) {
  auto o = test::small_swarm(3);
  o.frames = frames;
  return plant(parse_model("bswarm"), scene_parameters(parse_model("bswarm"), test::midge_parameters()), o);
}

TEST(Halves, AreEquallyLongAndApartByTheTimeOfTheSwarm) {
  const Tracks recording = film(300);
  const Halves h = halves(recording);
  const auto length = [](const Tracks& t) { return t.frames().back().number - t.frames().front().number + 1; };
  EXPECT_EQ(length(h.fitted), length(h.held_out));
  EXPECT_EQ(h.fitted.frames().front().number, recording.frames().front().number);
  EXPECT_EQ(h.held_out.frames().back().number, recording.frames().back().number);
  const auto apart = h.held_out.frames().front().number - h.fitted.frames().back().number - 1;
  const double memory = std::max(natural_scales(recording).time(), correlation_time(recording));
  EXPECT_GE(static_cast<double>(apart) * recording.dt(), memory);
  EXPECT_LT(static_cast<double>(apart) * recording.dt(), memory + 2 * recording.dt());
  EXPECT_THROW(halves(film(80)), InputError);
}

CompareOptions tiny() {
  CompareOptions o;
  o.models = {parse_model("bswarm"), parse_model("boids")};
  o.budget = {"tiny", {8, 6, 2}, {4, 3, 3}, 4, 3, 3};
  o.laws = 39;
  return o;
}

TEST(HoldOut, FitsTheFirstHalfAndScoresTheSecond) {
  const Tracks recording = film(300);
  auto options = tiny();
  options.hold_out = true;
  const Comparison held = compare(recording, options);
  ASSERT_TRUE(held.recording.hold_out.used);
  options.hold_out = false;
  const Comparison half = compare(halves(recording).fitted, options);
  ASSERT_EQ(held.models.size(), half.models.size());
  for (std::size_t m = 0; m < half.models.size(); ++m) EXPECT_EQ(held.models[m].runs.raw_energies, half.models[m].runs.raw_energies) << m;
  EXPECT_FALSE(half.recording.hold_out.used);
  EXPECT_TRUE(std::isnan(half.models[0].standing.held_out.score));

  // By hand: the fitted parameters under the other half's own conditions and what was learned from the first, scored with its weights.
  const Halves parts = halves(recording);
  const Conditions fitted = make_conditions(parts.fitted, options.conditions);
  Conditions conditions = make_conditions(parts.held_out, options.conditions);
  conditions.metrics.lags = {1};
  conditions.scales = fitted.scales;
  conditions.sigma = fitted.sigma;
  const Target target(metric_samples(conditions.recording, conditions.metrics), options.binning);
  Objective objective(parse_model("bswarm"), conditions, target);
  const auto& fit = held.models[0];
  ASSERT_EQ(fit.model, "bswarm");
  objective.use_steps(fit.runs.steps);
  const auto raw =
      objective.evaluate(parameter_values(parse_model("bswarm"), fit), replicate_seeds({options.seed}, Stream::final_seeds, 3)).raw;
  EXPECT_EQ(fit.standing.held_out.raw, raw);
  double cost = -1;
  for (std::size_t j = 0; j < kMetrics; ++j)
    if (held.ranking.weights[j] > 0 && held.ranking.p2[j] > 0)
      cost += held.ranking.weights[j] * (raw[j] - held.ranking.p1[j]) / held.ranking.p2[j];
  EXPECT_NEAR(fit.standing.held_out.score, -cost, 1e-12);
  EXPECT_EQ(held.models[1].standing.held_out.certainty.group, 2) << "boids is found out on either half";
  EXPECT_GT(held.models[1].standing.held_out.certainty.lead_lower, 0);
}

Eigen::Array3d centre_of(const Tracks& t) { return t.pos().colwise().mean().transpose(); }

// A stiff langevin swarm stays where it was in the half that was fitted, not where it turned out to be later.
TEST(HoldOut, ModelsDoNotKnowWhereTheOtherHalfIs) {
  const Tracks recording = film(300);
  const Halves parts = halves(recording);
  const Conditions fitted = make_conditions(parts.fitted, {});
  const Conditions there = held_out_conditions(parts.held_out, fitted);
  EXPECT_EQ(there.first_frame, parts.held_out.frames().front().number);
  EXPECT_EQ(there.sigma.matrix(), fitted.sigma.matrix());
  EXPECT_EQ(there.scales.extent, fitted.scales.extent);
  const Target target(metric_samples(there.recording, there.metrics), {});
  const ModelChoice model = parse_model("langevin");
  const auto still = planted_parameters(model, fitted.scales, {{"tau_v", 0.05}, {"k", 400}, {"sigma_eta", 0}});
  const Tracks run = Ensemble(model, there).run({still, Rng{1}}).seen;
  const auto last = run.frames().back();
  const Eigen::Array3d end = run.pos().middleRows(last.first, last.count).colwise().mean().transpose();
  const double apart = (centre_of(parts.held_out) - centre_of(parts.fitted)).matrix().norm();
  ASSERT_GT(apart, 5 * there.sigma.matrix().norm()) << "the halves must lie apart for this to mean anything";
  EXPECT_LT((end - centre_of(parts.fitted)).matrix().norm(), 0.2 * apart);
}

// What fastswarm does on the other half it has seen in the half that was fitted.
TEST(HoldOut, LearnsFromTheFittedHalfOnly) {
  const Halves parts = halves(film(300));
  ConditionOptions options;
  options.error = ConditionOptions::Error::none;
  options.rounding = false;
  const Conditions fitted = make_conditions(parts.fitted, options), there = held_out_conditions(parts.held_out, fitted);
  const ModelChoice model = parse_model("fastswarm");
  const Tracks run = Ensemble(model, there).run({planted_parameters(model, fitted.scales), Rng{1}}).seen;
  const ReferenceSet set(fitted.recording, {}, {});
  int moves = 0;
  for (Index row = 0; row < run.rows() && moves < 500; ++row) {
    const Index next = run.next()[static_cast<std::size_t>(row)];
    if (next < 0) continue;
    const Eigen::Array3d v = (run.pos().row(next) - run.pos().row(row)).transpose() / run.dt();
    double nearest = INFINITY;
    for (std::size_t k = 0; k < set.size(); ++k)
      nearest = std::min(nearest, (v - Eigen::Array3d(set.velocity()[0][k], set.velocity()[1][k], set.velocity()[2][k])).abs().maxCoeff());
    EXPECT_LT(nearest, 1e-6 * fitted.scales.speed);
    ++moves;
  }
  EXPECT_EQ(moves, 500);
}

TEST(HoldOut, SaysHowNearMotionLiesToWhatWasFitted) {
  auto options = tiny();
  options.models = {parse_model("fastswarm"), parse_model("boids")};
  options.hold_out = true;
  const Comparison c = compare(film(300), options);
  for (const ModelFit& m : c.models) {
    EXPECT_GT(m.standing.held_out.nearness.recorded, 0);
    EXPECT_GT(m.standing.held_out.nearness.simulated, 0);
    EXPECT_GE(m.standing.held_out.nearness.frames, 2);
    EXPECT_EQ(m.learns, m.model == "fastswarm");
  }
  EXPECT_THAT(c.warnings, testing::Contains(testing::HasSubstr("fastswarm takes its velocities from the half that was fitted")));
}

}  // namespace
}  // namespace swarmfit
