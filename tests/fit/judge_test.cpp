// SPDX-License-Identifier: MIT
#include "fit/judge.h"

#include <gmock/gmock.h>
#include <omp.h>

#include <algorithm>

#include "tests/eval/build.h"
#include "tests/fit/planted.h"

namespace swarmfit {
namespace {

using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsNan;
using testing::Not;

const PerColumn<bool> kAllUsed = {true, true, true, true, true, true, true};

// A judge of a recording that bswarm planted, and the model that planted it.
struct Planted {
  Tracks recording = test::planted_swarm(3);
  Conditions conditions = make_conditions(recording, {});
  Target target{metric_samples(recording), Binning::standard(Normalisation::reference)};
  ModelChoice model = parse_model("bswarm[avoidance=none]");
  Objective objective{model, conditions, target};
  std::vector<double> truth = scene_parameters(model, test::midge_parameters());
  std::vector<Rng> seeds = replicate_seeds({1}, Stream::final_seeds, 4);

  FitResult judged(const Judge& judge, const std::vector<double>& parameters) const {
    FitResult fit;
    judge.judge(fit, objective, parameters, seeds);
    return fit;
  }
  std::vector<double> with_gamma(double factor) const {
    auto p = truth;
    p[static_cast<std::size_t>(model.spec->find("gamma"))] *= factor;
    return p;
  }
};

TEST(Judge, TruthIsNearOneAndWrongIsFarBelow) {
  const Planted planted;
  const Judge judge(planted.conditions, kAllUsed, 1);
  const FitResult truth = planted.judged(judge, planted.truth), wrong = planted.judged(judge, planted.with_gamma(10));
  EXPECT_GT(truth.skill.value, 0.8);
  EXPECT_LT(truth.skill.value, 1.2);
  EXPECT_LT(wrong.skill.value, truth.skill.value - 5 * std::hypot(truth.skill.se, wrong.skill.se));
  EXPECT_GT(wrong.wasserstein[kSpeed], 2 * truth.wasserstein[kSpeed]);
  for (std::size_t j = 0; j < kMetrics; ++j) EXPECT_LE(truth.total_variation[j], 1);
}

// The skill from the numbers of the tables alone.
TEST(Judge, SkillFollowsFromTheDistancesShown) {
  const Planted planted;
  PerColumn<bool> used{};
  used[kSpeed] = used[kAngularVelocity] = used[kDistance] = true;
  const Judge judge(planted.conditions, used, 1);
  Comparison c;
  c.models.push_back(planted.judged(judge, planted.truth));
  judge.tell(c);
  const auto mean = [&](const PerColumn<double>& x) { return (x[kSpeed] + x[kAngularVelocity] + x[kDistance]) / 3; };
  const double floor = mean(c.skill.floor), null = mean(c.skill.null);
  EXPECT_NEAR(c.models[0].skill.value, 1 - (mean(c.models[0].total_variation) - floor) / (null - floor), 1e-9);
  EXPECT_TRUE(c.skill.informative[kAngularVelocity]);
  EXPECT_FALSE(c.skill.informative[kSpeed]) << "the walker has the recorded speeds";
}

// v alone tells nothing, since the walker has the recorded speeds.
TEST(Judge, SkillRestsOnAllMetricsIfThoseOfTheScoreTellNothing) {
  const Planted planted;
  PerColumn<bool> speed{};
  speed[kSpeed] = true;
  Comparison c;
  Judge(planted.conditions, speed, 1).tell(c);
  EXPECT_EQ(c.skill.used, kAllUsed);
  EXPECT_GT(c.skill.mean_null, c.skill.mean_floor);
}

TEST(Judge, BlownUpRunsCountAsDisjointAndHaveNoPanel) {
  const Planted planted;
  const Judge judge(planted.conditions, kAllUsed, 1);
  const FitResult fit = planted.judged(judge, planted.with_gamma(1e11));
  EXPECT_THAT(fit.total_variation, Each(1.0));
  EXPECT_LT(fit.skill.value, 0);
  ASSERT_EQ(fit.panel.size(), panel_plan(planted.recording).items().size());
  for (const Estimate& e : fit.panel) EXPECT_THAT(e.value, IsNan());
}

TEST(Judge, PanelOfTheTruthIsThatOfTheRecording) {
  const Planted planted;
  const Judge judge(planted.conditions, kAllUsed, 1);
  Comparison c;
  c.models.push_back(planted.judged(judge, planted.truth));
  judge.tell(c);
  ASSERT_EQ(c.panel.items.size(), c.models[0].panel.size());
  ASSERT_EQ(c.panel.recording_vacf.size(), c.panel.lags.size());
  std::size_t off = 0;
  for (std::size_t k = 0; k < c.panel.items.size(); ++k) {
    const Estimate &real = c.panel.recording[k], &model = c.models[0].panel[k];
    off += std::abs(model.value - real.value) > 4 * std::hypot(real.se, model.se);
  }
  EXPECT_LE(off, 2u);
}

TEST(Judge, SameBitsForAnyNumberOfThreads) {
  const Planted planted;
  const int before = omp_get_max_threads();
  std::vector<Comparison> results;
  for (const int threads : {1, 4}) {
    omp_set_num_threads(threads);
    const Judge judge(planted.conditions, kAllUsed, 1);
    results.emplace_back();
    results.back().models.push_back(planted.judged(judge, planted.truth));
    judge.tell(results.back());
  }
  omp_set_num_threads(before);
  EXPECT_EQ(results[0].models[0].skill.value, results[1].models[0].skill.value);
  EXPECT_EQ(results[0].skill.null, results[1].skill.null);
  EXPECT_EQ(results[0].skill.interaction_p[0], results[1].skill.interaction_p[0]);
  EXPECT_EQ(results[0].models[0].panel.back().value, results[1].models[0].panel.back().value);
}

// Fixed seeds: independent particles, and the same ones held apart on a lattice that breathes.
TEST(Judge, SeesInteractionWhereThereIsSome) {
  const auto p_of = [](const Tracks& tracks) {
    const Conditions conditions = make_conditions(tracks, {});
    Comparison c;
    Judge(conditions, kAllUsed, 1).tell(c);
    c.models.resize(1);
    c.models[0].skill = {1, 0};
    return std::pair(c.skill.interaction_p[0], warnings_of_skill(c));
  };
  const auto alone =
      p_of(test::tracks_of(test::rows_of(8, 200, 0.1, [](std::uint32_t i, double t) { return test::orbit(2, 50, 1, i, t); })));
  EXPECT_GT(alone.first, 0.05);
  EXPECT_THAT(alone.second, Contains(HasSubstr("No detectable interaction")));
  const auto together = p_of(test::tracks_of(test::rows_of(8, 200, 0.1, [](std::uint32_t i, double t) {
    const auto p = test::orbit(2, 5, 1, i, t);
    const double phase = 6.283185307179586 * (i / 8.0 + 0.1 * t);
    return std::array{50 * std::cos(phase) + p[0], 50 * std::sin(phase) + p[1], p[2]};
  })));
  EXPECT_DOUBLE_EQ(together.first, 0.01);
  EXPECT_THAT(together.second, Not(Contains(HasSubstr("No detectable interaction"))));
}

FitResult named(const std::string& name, double skill, double se) {
  FitResult r;
  r.model = name;
  r.skill = {skill, se};
  return r;
}

TEST(SkillWarnings, SayWhereScoreAndSkillDisagree) {
  Comparison c;
  c.models = {named("a", 0.5, 0.01), named("b", 0.7, 0.01), named("c", 0.2, 0.01)};
  EXPECT_THAT(warnings_of_skill(c), ElementsAre(HasSubstr("by skill the order is b (0.70), a (0.50), c (0.20), which puts b before a.")));
  c.models[1].skill.se = 0.2;  // chance could do that
  EXPECT_TRUE(warnings_of_skill(c).empty());
}

TEST(SkillWarnings, SayWhoDecidesTheWinner) {
  Comparison c;
  c.models = {named("a", 0.5, 0), named("b", 0.4, 0), named("c", 0.3, 0)};
  c.without = {{"a", {}, {{"b", 1}}, false, false}, {"c", {}, {{"b", 1}, {"a", 0.9}}, true, true}};
  EXPECT_THAT(warnings_of_skill(c), ElementsAre("Who wins by score depends on who is compared: without c it is b."));
}

TEST(SkillWarnings, UndefinedSkillIsExplained) {
  Comparison c;
  c.models = {named("a", NAN, NAN)};
  EXPECT_THAT(warnings_of_skill(c), ElementsAre(HasSubstr("Skill is undefined")));
}

// The energies of leave_one_out_test: without d, a overtakes b.
TEST(Judge, TellsRankingsWithoutEachModel) {
  const Planted planted;
  PerColumn<bool> two{};
  two[0] = two[1] = true;
  const Judge judge(planted.conditions, two, 1);
  Comparison c;
  c.observation.used = two;
  const std::array<std::pair<const char*, std::array<double, 2>>, 4> table{
      {{"b", {1, 0}}, {"a", {0, 4}}, {"d", {10, 1}}, {"c", {0.9, 10}}}};
  for (const auto& [name, raw] : table) {
    c.models.push_back(named(name, 0, 0));
    std::copy(raw.begin(), raw.end(), c.models.back().raw_energies.begin());
  }
  judge.tell(c);
  ASSERT_EQ(c.without.size(), 4u);
  EXPECT_EQ(c.without[2].model, "d");
  EXPECT_EQ(c.without[2].ranking.front().first, "a");
  EXPECT_TRUE(c.without[2].reordered);
  EXPECT_TRUE(c.without[2].winner_changed);
  EXPECT_FALSE(c.without[0].winner_changed) << "b itself was left out";
}

}  // namespace
}  // namespace swarmfit
