// SPDX-License-Identifier: MIT
#include "fit/compare/skill_assessment.h"

#include <gmock/gmock.h>
#include <omp.h>

#include <algorithm>

#include "fit/compare/skill_warnings.h"
#include "fit/experiment/objective.h"
#include "tests/eval/build.h"
#include "tests/fit/planted.h"

namespace swarmfit {
namespace {

using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::IsNan;
using testing::Not;

const PerColumn<bool> kAllUsed = {true, true, true, true, true, true, true};

ModelFit named(const std::string& name, double skill, double se) {
  ModelFit r;
  r.model = name;
  r.likeness.skill = {skill, se};
  return r;
}

std::vector<AssessedRun> assessed(const SkillAssessment& assessment, const Ensemble& ensemble, const std::vector<double>& parameters,
                                  std::span<const Rng> seeds) {
  return ensemble.measured<AssessedRun>(jobs_on(parameters, seeds), "", [&](const Run& run, std::size_t) { return assessment.of(run); });
}

// What is said of a comparison whose models were assessed.
void tell(const SkillAssessment& assessment, Comparison& c) {
  c.recording.skill = assessment.skill();
  c.recording.panel = assessment.panel();
  c.ranking.walk_suffices = walk_suffices(assessment.skill(), c.models);
}

// A recording that bswarm planted, and the model that planted it.
struct Planted {
  Tracks recording = test::planted_swarm(3);
  Conditions conditions = make_conditions(recording, {});
  Target target{metric_samples(recording), Binning::standard(Normalisation::reference)};
  ModelChoice model = parse_model("bswarm[avoidance=none]");
  Objective objective{model, conditions, target};
  std::vector<double> truth = scene_parameters(model, test::midge_parameters());
  std::vector<Rng> seeds = replicate_seeds({1}, Stream::final_seeds, 4);

  ModelFit fit(const SkillAssessment& assessment, const std::vector<double>& parameters) const {
    ModelFit out;
    out.likeness = assessment.likeness(assessed(assessment, objective.ensemble(), parameters, seeds));
    return out;
  }
  std::vector<double> with_gamma(double factor) const {
    auto p = truth;
    p[static_cast<std::size_t>(model.spec->find("gamma"))] *= factor;
    return p;
  }
};

TEST(SkillAssessment, TruthIsNearOneAndWrongIsFarBelow) {
  const Planted planted;
  const SkillAssessment assessment(planted.conditions, kAllUsed, 1);
  const ModelFit truth = planted.fit(assessment, planted.truth), wrong = planted.fit(assessment, planted.with_gamma(10));
  EXPECT_GT(truth.likeness.skill.value, 0.8);
  EXPECT_LT(truth.likeness.skill.value, 1.2);
  EXPECT_LT(wrong.likeness.skill.value, truth.likeness.skill.value - 5 * std::hypot(truth.likeness.skill.se, wrong.likeness.skill.se));
  EXPECT_GT(wrong.likeness.wasserstein[kSpeed], 2 * truth.likeness.wasserstein[kSpeed]);
  for (std::size_t j = 0; j < kMetrics; ++j) EXPECT_LE(truth.likeness.total_variation[j], 1);
}

// The skill from the numbers of the tables alone.
TEST(SkillAssessment, SkillFollowsFromTheDistancesShown) {
  const Planted planted;
  PerColumn<bool> used{};
  used[kSpeed] = used[kAngularVelocity] = used[kDistance] = true;
  const SkillAssessment assessment(planted.conditions, used, 1);
  Comparison c;
  c.models.push_back(planted.fit(assessment, planted.truth));
  tell(assessment, c);
  const auto mean = [&](const PerColumn<double>& x) { return (x[kSpeed] + x[kAngularVelocity] + x[kDistance]) / 3; };
  const double floor = mean(c.recording.skill.floor), null = mean(c.recording.skill.null);
  EXPECT_NEAR(c.models[0].likeness.skill.value, 1 - (mean(c.models[0].likeness.total_variation) - floor) / (null - floor), 1e-9);
  EXPECT_TRUE(c.recording.skill.informative[kAngularVelocity]);
  EXPECT_FALSE(c.recording.skill.informative[kSpeed]) << "the walker has the recorded speeds";
}

// v alone tells nothing, since the walker has the recorded speeds.
TEST(SkillAssessment, SkillRestsOnAllMetricsIfThoseOfTheScoreTellNothing) {
  const Planted planted;
  PerColumn<bool> speed{};
  speed[kSpeed] = true;
  Comparison c;
  tell(SkillAssessment(planted.conditions, speed, 1), c);
  EXPECT_EQ(c.recording.skill.used, kAllUsed);
  EXPECT_GT(c.recording.skill.mean_null, c.recording.skill.mean_floor);
}

TEST(SkillAssessment, BlownUpRunsCountAsDisjointAndHaveNoPanel) {
  const Planted planted;
  const SkillAssessment assessment(planted.conditions, kAllUsed, 1);
  const ModelFit fit = planted.fit(assessment, planted.with_gamma(1e11));
  EXPECT_THAT(fit.likeness.total_variation, Each(1.0));
  EXPECT_LT(fit.likeness.skill.value, 0);
  ASSERT_EQ(fit.likeness.panel.size(), panel_plan(planted.recording).items().size());
  for (const Estimate& e : fit.likeness.panel) EXPECT_THAT(e.value, IsNan());
}

TEST(SkillAssessment, PanelOfTheTruthIsThatOfTheRecording) {
  const Planted planted;
  const SkillAssessment assessment(planted.conditions, kAllUsed, 1);
  Comparison c;
  c.models.push_back(planted.fit(assessment, planted.truth));
  tell(assessment, c);
  ASSERT_EQ(c.recording.panel.items.size(), c.models[0].likeness.panel.size());
  ASSERT_EQ(c.recording.panel.recording_vacf.size(), c.recording.panel.lags.size());
  std::size_t off = 0;
  for (std::size_t k = 0; k < c.recording.panel.items.size(); ++k) {
    const Estimate &real = c.recording.panel.recording[k], &model = c.models[0].likeness.panel[k];
    off += std::abs(model.value - real.value) > 4 * std::hypot(real.se, model.se);
  }
  EXPECT_LE(off, 2u);
}

TEST(SkillAssessment, SameBitsForAnyNumberOfThreads) {
  const Planted planted;
  const int before = omp_get_max_threads();
  std::vector<Comparison> results;
  for (const int threads : {1, 4}) {
    omp_set_num_threads(threads);
    const SkillAssessment assessment(planted.conditions, kAllUsed, 1);
    results.emplace_back();
    results.back().models.push_back(planted.fit(assessment, planted.truth));
    tell(assessment, results.back());
  }
  omp_set_num_threads(before);
  EXPECT_EQ(results[0].models[0].likeness.skill.value, results[1].models[0].likeness.skill.value);
  EXPECT_EQ(results[0].recording.skill.null, results[1].recording.skill.null);
  EXPECT_EQ(results[0].recording.skill.interaction_p[0], results[1].recording.skill.interaction_p[0]);
  EXPECT_EQ(results[0].models[0].likeness.panel.back().value, results[1].models[0].likeness.panel.back().value);
}

// Eight that go round evenly spaced, each with small orbits of its own.
Tracks lattice() {
  return test::tracks_of(test::rows_of(8, 200, 0.1, [](std::uint32_t i, double t) {
    const auto p = test::orbit(2, 5, 1, i, t);
    const double phase = 6.283185307179586 * (i / 8.0 + 0.1 * t);
    return std::array{50 * std::cos(phase) + p[0], 50 * std::sin(phase) + p[1], p[2]};
  }));
}

// Fixed seeds: independent particles, and the same ones held apart on a lattice that breathes.
TEST(SkillAssessment, SeesInteractionWhereThereIsSome) {
  const auto p_of = [](const Tracks& tracks) {
    const Conditions conditions = make_conditions(tracks, {});
    Comparison c;
    tell(SkillAssessment(conditions, kAllUsed, 1), c);
    c.models.resize(1);
    c.models[0].likeness.skill = {1, 0};
    return std::pair(c.recording.skill.interaction_p[0], warnings_of_skill(c));
  };
  const auto alone =
      p_of(test::tracks_of(test::rows_of(8, 200, 0.1, [](std::uint32_t i, double t) { return test::orbit(2, 50, 1, i, t); })));
  EXPECT_GT(alone.first, 0.05);
  EXPECT_THAT(alone.second, Contains(HasSubstr("No detectable interaction")));
  const auto together = p_of(lattice());
  EXPECT_DOUBLE_EQ(together.first, 0.01);
  EXPECT_THAT(together.second, Not(Contains(HasSubstr("No detectable interaction"))));
}

// Steps of independent normal numbers: nothing to be known but the steps.
Tracks random_walks(std::uint64_t seed, std::uint32_t walkers = 10, std::int64_t frames = 200) {
  std::vector<test::Row> rows;
  std::vector<std::array<double, 3>> at(walkers);
  for (std::uint32_t i = 0; i < walkers; ++i)
    for (std::uint32_t a = 0; a < 3; ++a) at[i][a] = 100 * test::normal(seed, 0, i, a);
  for (std::int64_t k = 0; k < frames; ++k)
    for (std::uint32_t i = 0; i < walkers; ++i) {
      rows.push_back({i, k, at[i]});
      for (std::uint32_t a = 0; a < 3; ++a) at[i][a] += 4 * test::normal(seed, static_cast<std::uint64_t>(k) + 1, i, a);
    }
  return test::tracks_of(rows);
}

// Its own random walks are as close to it as its halves are, and no model comes closer; the scale is that of its places.
TEST(SkillAssessment, ARandomWalkIsAnAnswer) {
  const Tracks recording = random_walks(1);
  const Conditions conditions = make_conditions(recording, {});
  const Target target(metric_samples(recording), Binning::standard(Normalisation::reference));
  const ModelChoice model = parse_model("langevin");
  const Ensemble ensemble(model, conditions);
  const SkillAssessment assessment(conditions, kAllUsed, 1);
  Comparison c;
  c.models.emplace_back();
  c.models[0].likeness = assessment.likeness(
      assessed(assessment, ensemble, scene_parameters(model, {{"sigma_eta", 100}}), replicate_seeds({1}, Stream::final_seeds, 4)));
  tell(assessment, c);
  EXPECT_EQ(c.recording.skill.null_of, SkillNull::places);
  EXPECT_NEAR(c.recording.skill.walker.value, 1, 0.05);
  EXPECT_GT(c.recording.skill.memory_p, 0.05);
  EXPECT_TRUE(c.ranking.walk_suffices);
  EXPECT_LT(c.models[0].likeness.skill.value, c.recording.skill.walker.value - 0.1);
  EXPECT_GT(c.models[0].likeness.skill.value, -1);
  const auto mean = [](const PerColumn<double>& x) { return mean_used(x, kAllUsed); };
  EXPECT_NEAR(c.recording.skill.mean_null, mean(c.recording.skill.places), 1e-12);
  EXPECT_NEAR(
      c.recording.skill.walker.value,
      1 - (mean(c.recording.skill.null) - mean(c.recording.skill.floor)) / (mean(c.recording.skill.places) - mean(c.recording.skill.floor)),
      1e-9);
}

// p of the random walk is uniform on random walks: of 20, one is expected at p <= 0.05, and the probability of more than five is 0.0003.
TEST(SkillAssessment, MemoryIsFoundWhereThereIsSome) {
  const auto facts_of = [](const Tracks& recording) {
    Comparison c;
    const Conditions conditions = make_conditions(recording, {});
    tell(SkillAssessment(conditions, kAllUsed, 1), c);
    return c.recording.skill;
  };
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) found += facts_of(random_walks(seed, 6, 80)).memory_p <= 0.05;
  EXPECT_LE(found, 5);
  const SkillFacts smooth = facts_of(test::planted_swarm(3));
  EXPECT_DOUBLE_EQ(smooth.memory_p, 0.01);
  EXPECT_EQ(smooth.null_of, SkillNull::steps);
  EXPECT_NEAR(smooth.walker.value, 0, 1e-9);
  EXPECT_GT(smooth.walker.se, 0);
}

// Neighbours alone say nothing of a walk: on a lattice they tell the recording from its surrogates.
TEST(SkillAssessment, TheWalkHasASkillWhereMotionCounts) {
  const Conditions conditions = make_conditions(lattice(), {});
  PerColumn<bool> distance{};
  distance[kDistance] = true;
  Comparison c;
  c.models = {named("a", -1, 0.01)};
  tell(SkillAssessment(conditions, distance, 1), c);
  ASSERT_EQ(c.recording.skill.used, distance);
  EXPECT_THAT(c.recording.skill.walker.value, IsNan());
  EXPECT_THAT(c.recording.skill.memory_p, IsNan());
  EXPECT_FALSE(c.ranking.walk_suffices);
}

// On the scale of the walk: as close as that within two standard errors, or closer?
TEST(SkillAssessment, SaysWhetherAnyModelIsCloserThanTheWalk) {
  const Planted planted;
  const SkillAssessment assessment(planted.conditions, kAllUsed, 1);
  const auto suffices = [&](const std::vector<Estimate>& skills) {
    Comparison c;
    for (const Estimate& e : skills) c.models.push_back(named("a", e.value, e.se));
    tell(assessment, c);
    return c.ranking.walk_suffices;
  };
  EXPECT_TRUE(suffices({{-0.3, 0.01}, {0.15, 0.1}}));
  EXPECT_FALSE(suffices({{-0.3, 0.01}, {0.15, 0.05}}));
  EXPECT_FALSE(suffices({{NAN, NAN}})) << "nobody was assessed";
  EXPECT_TRUE(suffices({{NAN, NAN}, {0, 0}}));
}

TEST(SkillAssessment, TellsWhatRefutesAModel) {
  const Planted planted;
  const SkillAssessment assessment(planted.conditions, kAllUsed, 1);
  EXPECT_THAT(planted.fit(assessment, planted.truth).likeness.refuted_by, testing::IsEmpty());
  ModelFit fit;
  fit.likeness = assessment.likeness(
      assessed(assessment, planted.objective.ensemble(), planted.with_gamma(10), replicate_seeds({1}, Stream::final_seeds, 12)));
  ASSERT_THAT(fit.likeness.refuted_by, testing::Not(testing::IsEmpty()));
  EXPECT_TRUE(std::any_of(fit.likeness.refuted_by.begin(), fit.likeness.refuted_by.end(),
                          [](const Refutation& f) { return f.item.key == "speed"; }));
}

}  // namespace
}  // namespace swarmfit
