// SPDX-License-Identifier: MIT
#include "fit/compare/hold_out.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "fit/experiment/objective.h"
#include "fit/model_fit/race.h"
#include "fit/study/recovery.h"
#include "libeval/nearness.h"
#include "libswarm/reference_set.h"
#include "libtrack/cut.h"
#include "libtrack/error.h"
#include "tests/fit/planted.h"

namespace swarmfit {
namespace {

Tracks film(std::int64_t frames) {
  auto o = test::small_swarm(3);
  o.frames = frames;
  return plant(parse_model("bswarm"), scene_parameters(parse_model("bswarm"), test::midge_parameters()), o);
}

TEST(Halves, AreEquallyLongEachAfterTheTimeOfTheSwarm) {
  const Tracks recording = film(300);
  const auto [first, second] = halves(recording);
  const auto length = [](const Half& h) { return h.tracks.frames().back().number - h.tracks.frames().front().number + 1 - h.warm_up; };
  EXPECT_EQ(length(first), length(second));
  EXPECT_EQ(first.tracks.frames().front().number, recording.frames().front().number);
  EXPECT_EQ(second.tracks.frames().front().number, first.tracks.frames().back().number + 1);
  EXPECT_GE(second.tracks.frames().back().number, recording.frames().back().number - 1);
  const double memory = std::max(natural_scales(recording).time(), correlation_time(recording));
  for (const Half& half : {first, second}) {
    EXPECT_GE(static_cast<double>(half.warm_up) * recording.dt(), memory);
    EXPECT_LT(static_cast<double>(half.warm_up) * recording.dt(), memory + 2 * recording.dt());
  }
  EXPECT_THROW(halves(film(80)), InputError);
}

TEST(Halves, AreWorthItIfLongerThanThreeTimesTheMemory) {
  const Tracks recording = film(600);
  const std::int64_t memory = halves(recording).first.warm_up;
  const auto first_frames = [&](std::int64_t frames) { return cut(recording, recording.frames().front().number, frames); };
  EXPECT_TRUE(worth_halving(recording));
  EXPECT_FALSE(worth_halving(first_frames(6 * memory)));
  EXPECT_FALSE(worth_halving(first_frames(40)));
}

TEST(Halves, WhatRunsForgetInIsSimulatedAndNotCompared) {
  const Half half = halves(film(300)).second;
  for (const auto presence : {ConditionOptions::Presence::recorded, ConditionOptions::Presence::constant}) {
    ConditionOptions options;
    options.presence = presence;
    const Conditions c = make_conditions(half.tracks, options, half.warm_up);
    EXPECT_EQ(c.first_frame, half.tracks.frames().front().number);
    EXPECT_EQ(c.recording.frames().front().number, c.first_frame + half.warm_up);
    const ModelChoice model = parse_model("brownian");
    const Tracks seen = Ensemble(model, c).run({planted_parameters(model, c.scales), Rng{1}}).seen;
    EXPECT_EQ(seen.frames().front().number, c.recording.frames().front().number);
    EXPECT_EQ(seen.frames().back().number, c.recording.frames().back().number);
  }
}

CompareOptions tiny() {
  CompareOptions o;
  o.models = {parse_model("bswarm"), parse_model("boids")};
  o.budget = {"tiny", {8, 6, 2}, {4, 3, 3}, 4, 3, 3};
  o.bootstrap_recordings = 39;
  return o;
}

const ModelFit& of(const Comparison& c, const std::string& model) {
  return *std::find_if(c.models.begin(), c.models.end(), [&](const ModelFit& m) { return m.model == model; });
}

TEST(HoldOut, RanksByTheHalvesThatWereNotFitted) {
  const Tracks recording = film(300);
  auto options = tiny();
  options.hold_out = CompareOptions::HoldOutWhen::always;
  const Comparison held = compare(recording, options);
  ASSERT_EQ(held.recording.hold_out.ways.size(), 2u);
  options.hold_out = CompareOptions::HoldOutWhen::never;
  const Comparison whole = compare(recording, options);
  EXPECT_FALSE(whole.recording.hold_out.used());
  for (const ModelFit& m : held.models) {
    const ModelFit& other = of(whole, m.model);
    EXPECT_EQ(m.runs.raw_energies, other.runs.raw_energies) << "the fit to the whole recording is the same";
    EXPECT_EQ(m.standing.in_sample.score, other.standing.score);
    EXPECT_EQ(other.standing.in_sample.score, other.standing.score);
    EXPECT_NE(m.standing.score, m.standing.in_sample.score);
    ASSERT_EQ(m.standing.held_out.scores.size(), 2u);
    EXPECT_DOUBLE_EQ(m.standing.score, (m.standing.held_out.scores[0] + m.standing.held_out.scores[1]) / 2);
    EXPECT_GT(m.standing.held_out.simulations, 0);
    for (const ParameterResult& p : m.parameters) {
      EXPECT_EQ(std::isfinite(p.halves_lower), p.fitted) << p.name;
      EXPECT_FALSE(p.halves_lower > p.halves_upper) << p.name;
    }
  }
  EXPECT_GE(held.models[0].standing.score, held.models[1].standing.score);
  EXPECT_EQ(of(held, "boids").standing.certainty.group, 2) << "boids is found out on the halves";
  EXPECT_GT(of(held, "boids").standing.certainty.lead_lower, 0);
}

// By hand: the parameters fitted to one half under the other's own conditions and what was learned from the first, with its weights.
TEST(HoldOut, AWayIsAComparisonOfOneHalfScoredOnTheOther) {
  const Tracks recording = film(300);
  const auto options = tiny();
  const HoldOut held = hold_out(recording, options);
  const auto [first, second] = halves(recording);
  const Conditions fitted = make_conditions(second.tracks, options.conditions, second.warm_up);
  Conditions conditions = make_conditions(first.tracks, options.conditions, first.warm_up);
  conditions.scales = fitted.scales;
  conditions.sigma = fitted.sigma;
  conditions.reference = std::make_shared<const Tracks>(fitted.recording);
  const Target target(metric_samples(conditions.recording, conditions.metrics), options.binning);
  const Trial& trial = held.trials[1];
  const ModelChoice model = parse_model("boids");
  Objective objective(model, conditions, target);
  objective.use_steps(of(compare(recording, options), "boids").runs.steps);
  const auto raw = objective.evaluate(held.values[1][1], replicate_seeds(trial.bootstraps.root, Stream::final_seeds, 3)).raw;
  EXPECT_EQ(trial.models[1].raw, raw);
  EXPECT_NEAR(trial.models[1].score, -cost_of(raw, trial.weighting), 1e-12);
  EXPECT_EQ(held.facts.ways[1].fitted_first, fitted.recording.frames().front().number);
  EXPECT_EQ(held.facts.ways[1].held_last, conditions.recording.frames().back().number);
}

TEST(HoldOut, SeveralSearchesAndTheirScatter) {
  const Tracks recording = film(300);
  auto options = tiny();
  const HoldOut one = hold_out(recording, options);
  EXPECT_TRUE(std::isnan(one.models[0].search_sd));
  options.searches = 3;
  const HoldOut three = hold_out(recording, options);
  EXPECT_EQ(three.values[0].size(), 6u);
  EXPECT_EQ(three.values[0][0], one.values[0][0]) << "the first search is the one that was alone";
  EXPECT_NE(three.values[0][1], three.values[0][0]);
  EXPECT_GT(three.models[0].search_sd, 0);
  EXPECT_GT(three.models[0].simulations, 2 * one.models[0].simulations);
}

// Of three searches of the first half, the scored one lies nearest to that half.
TEST(HoldOut, OfSeveralSearchesTheBestFitIsScored) {
  const Tracks recording = film(300);
  auto options = tiny();
  options.searches = 3;
  options.budget.final_replicates = 12;
  const HoldOut held = hold_out(recording, options);
  const auto [first, second] = halves(recording);
  const Conditions fitted = make_conditions(first.tracks, options.conditions, first.warm_up);
  const Conditions scored = held_out_conditions(second.tracks, fitted, second.warm_up);
  const Target here(recorded_samples(fitted.recording, fitted.metrics), options.binning);
  const Target there(recorded_samples(scored.recording, scored.metrics), options.binning);
  const Trial& trial = held.trials[0];
  const auto seeds = replicate_seeds(trial.bootstraps.root, Stream::final_seeds, 12);
  const ModelChoice model = parse_model("bswarm");
  const int steps = of(compare(recording, options), "bswarm").runs.steps;
  std::vector<double> far;
  std::vector<bool> chosen;
  for (int k = 0; k < 3; ++k) {
    Objective fit(model, fitted, here), score(model, scored, there);
    fit.use_steps(steps), score.use_steps(steps);
    const auto& values = held.values[0][static_cast<std::size_t>(k)];
    far.push_back(cost_of(fit.energies(values, replicate_seeds({7}, Stream::final_seeds, 12)).raw, trial.weighting));
    chosen.push_back(score.energies(values, seeds).raw == trial.models[0].raw);
  }
  EXPECT_EQ(std::count(chosen.begin(), chosen.end(), true), 1);
  EXPECT_TRUE(chosen[static_cast<std::size_t>(std::min_element(far.begin(), far.end()) - far.begin())])
      << ::testing::PrintToString(far) << ::testing::PrintToString(chosen);
}

Eigen::Array3d centre_of(const Tracks& t) { return t.pos().colwise().mean().transpose(); }

// A stiff langevin swarm stays where it was in the half that was fitted, not where it turned out to be later.
TEST(HoldOut, ModelsDoNotKnowWhereTheOtherHalfIs) {
  const Tracks recording = film(300);
  const Halves parts = halves(recording);
  const Conditions fitted = make_conditions(parts.first.tracks, {});
  const Conditions there = held_out_conditions(parts.second.tracks, fitted);
  EXPECT_EQ(there.first_frame, parts.second.tracks.frames().front().number);
  EXPECT_EQ(there.sigma.matrix(), fitted.sigma.matrix());
  EXPECT_EQ(there.scales.extent, fitted.scales.extent);
  const Target target(metric_samples(there.recording, there.metrics), {});
  const ModelChoice model = parse_model("langevin");
  const auto still = planted_parameters(model, fitted.scales, {{"tau_v", 0.05}, {"k", 400}, {"sigma_eta", 0}});
  const Tracks run = Ensemble(model, there).run({still, Rng{1}}).seen;
  const auto last = run.frames().back();
  const Eigen::Array3d end = run.pos().middleRows(last.first, last.count).colwise().mean().transpose();
  const double apart = (centre_of(parts.second.tracks) - centre_of(parts.first.tracks)).matrix().norm();
  ASSERT_GT(apart, 5 * there.sigma.matrix().norm()) << "the halves must lie apart for this to mean anything";
  EXPECT_LT((end - centre_of(parts.first.tracks)).matrix().norm(), 0.2 * apart);
}

// What fastswarm does on the other half it has seen in the half that was fitted.
TEST(HoldOut, LearnsFromTheFittedHalfOnly) {
  const Halves parts = halves(film(300));
  ConditionOptions options;
  options.error = ConditionOptions::Error::none;
  options.rounding = false;
  const Conditions fitted = make_conditions(parts.first.tracks, options), there = held_out_conditions(parts.second.tracks, fitted);
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
  options.hold_out = CompareOptions::HoldOutWhen::always;
  const Comparison c = compare(film(300), options);
  for (const ModelFit& m : c.models) {
    EXPECT_GT(m.standing.held_out.nearness.recorded, 0);
    EXPECT_GT(m.standing.held_out.nearness.simulated, 0);
    EXPECT_GE(m.standing.held_out.nearness.frames, 2);
    EXPECT_EQ(m.learns, m.model == "fastswarm");
  }
  EXPECT_THAT(c.warnings, testing::Contains(testing::HasSubstr("fastswarm learns from the half that is fitted")));
}

}  // namespace
}  // namespace swarmfit
