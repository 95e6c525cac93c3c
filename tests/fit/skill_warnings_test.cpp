// SPDX-License-Identifier: MIT
#include "fit/compare/skill_warnings.h"

#include <gmock/gmock.h>

#include <cmath>

namespace swarmfit {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

ModelFit named(const std::string& name, double skill, double se) {
  ModelFit r;
  r.model = name;
  r.likeness.skill = {skill, se};
  return r;
}

TEST(SkillWarnings, SayWhereScoreAndSkillDisagree) {
  Comparison c;
  c.models = {named("a", 0.5, 0.01), named("b", 0.7, 0.01), named("c", 0.2, 0.01)};
  EXPECT_THAT(
      warnings_of_skill(c),
      ElementsAre(HasSubstr("By skill the order is b (0.70), a (0.50), c (0.20). Beyond chance, skill puts b before a. The score")));
  c.models[2].likeness.skill.value = 0.8;
  EXPECT_THAT(warnings_of_skill(c), ElementsAre(HasSubstr("skill puts b before a, c before a and b. The score")));
  c.models[2].likeness.skill.value = 0.2;
  c.models[1].likeness.skill.se = 0.2;  // chance could do that
  EXPECT_TRUE(warnings_of_skill(c).empty());
}

TEST(LearningWarnings, SayWhatThePlaceOfACopierIsWorth) {
  Comparison c;
  c.models = {named("copier", 0.5, 0.01), named("b", 0.4, 0.01)};
  EXPECT_THAT(warnings_of_learning(c), IsEmpty());
  c.models[0].learns = true;
  EXPECT_THAT(warnings_of_learning(c), ElementsAre(HasSubstr("copier learns from the recording that it is judged on")));
  c.recording.hold_out.ways = {{1, 240, 261, 500, {}, {}}};
  c.models[0].standing.held_out.nearness = {8, 10, 25};
  EXPECT_THAT(warnings_of_learning(c),
              ElementsAre(HasSubstr("On the other half, its paths of 25 frames lie 0.80 times as far from the nearest path that it "
                                    "has seen as the recorded paths do.")));
  c.models[0].standing.held_out.nearness.simulated = 4;
  EXPECT_THAT(warnings_of_learning(c), ElementsAre(HasSubstr("do: it repeats what it has seen.")));
}

TEST(SkillWarnings, SayWhoDecidesTheWinner) {
  Comparison c;
  c.models = {named("a", 0.5, 0), named("b", 0.4, 0), named("c", 0.3, 0)};
  c.ranking.without = {{"a", {}, {{"b", 1}}, false, false}, {"c", {}, {{"b", 1}, {"a", 0.9}}, true, true}};
  EXPECT_THAT(warnings_of_skill(c), ElementsAre("Which model ranks first depends on which models are compared: without c, b ranks first."));
}

TEST(SkillWarnings, UndefinedSkillIsExplained) {
  Comparison c;
  c.models = {named("a", NAN, NAN)};
  EXPECT_THAT(warnings_of_skill(c), ElementsAre(HasSubstr("Skill is undefined")));
}

TEST(SkillWarnings, NoMemoryOfDirection) {
  Comparison c;
  c.models = {named("a", 0.97, 0.01), named("b", 0.9, 0.01)};
  c.recording.skill.surrogates = 99;
  c.recording.skill.memory_p = 0.43;
  c.ranking.walk_suffices = true;
  c.recording.skill.null_of = SkillNull::places;
  EXPECT_THAT(warnings_of_skill(c), ElementsAre(HasSubstr("No detectable memory of direction: the recording cannot be distinguished from "
                                                          "random walks of its own steps (p = 0.43, 99 walks)"),
                                                HasSubstr("skill uses a coarser zero: its own positions")));
  c.recording.skill.memory_p = 0.05;
  c.recording.skill.null_of = SkillNull::steps;
  c.recording.skill.walker = {0, 0.01};
  c.models = {named("a", -0.4, 0.01), named("b", -0.1, 0.02)};
  EXPECT_THAT(warnings_of_skill(c), Contains("No model is closer to the recording than a random walk of its own steps (the walk's skill "
                                             "is 0.00; the best model, b, has -0.10 ± 0.02)."));
  c.ranking.walk_suffices = false;
  EXPECT_THAT(warnings_of_skill(c), Not(Contains(HasSubstr("random walk"))));
}

TEST(SkillWarnings, RejectedAndYetAsCloseAsHalves) {
  Comparison c;
  c.ranking.bootstrap_recordings = 99;
  c.models = {named("a", 0.97, 0.01)};
  c.recording.skill.mean_floor = 0.1;
  c.recording.skill.mean_floor_sd = 0.01;
  c.recording.skill.mean_null = 0.5;  // so that the floor is uncertain by .025 of the scale
  c.models[0].standing.certainty.gof_p = 0.01;
  EXPECT_THAT(warnings_of_skill(c),
              ElementsAre(HasSubstr("a is rejected although its skill is 0.97: each metric alone is about as close as "
                                    "two halves of the recording")));
  EXPECT_THAT(warnings_of_skill(c), ElementsAre(HasSubstr("(fit p ≤ 0.01)")));
  c.models[0].likeness.skill.value = 0.96;
  EXPECT_THAT(warnings_of_skill(c), IsEmpty());
  c.models[0].likeness.skill.value = 1.1;
  c.models[0].standing.certainty.gof_p = 0.04;
  EXPECT_THAT(warnings_of_skill(c), ElementsAre(HasSubstr("(fit p = 0.04)")));
  c.models[0].standing.certainty.gof_p = 0.06;
  EXPECT_THAT(warnings_of_skill(c), IsEmpty());
}

TEST(SkillWarnings, IdentifiedInteractionWhereNoneIsDetected) {
  Comparison c;
  c.models = {named("brownian", 0.5, 0.01)};
  ParameterResult strength, range, drag;
  strength.name = "C_r", range.name = "l_r", drag.name = "gamma1";
  strength.interaction = range.interaction = true;
  strength.posterior.verdict = drag.posterior.verdict = "identified";
  range.posterior.verdict = "flat";
  c.models[0].parameters = {strength, range, drag};
  c.recording.skill.interaction_p[0] = 0.3, c.recording.skill.interaction_p[1] = 0.04;
  EXPECT_THAT(warnings_of_skill(c), IsEmpty());
  c.recording.skill.interaction_p[1] = 0.9;
  EXPECT_THAT(warnings_of_skill(c), ElementsAre(HasSubstr("No detectable interaction"),
                                                HasSubstr("brownian: C_r is identified although no interaction is detectable.")));
  c.models[0].parameters[1].posterior.verdict = "identified";
  EXPECT_THAT(warnings_of_skill(c), Contains(HasSubstr("brownian: C_r, l_r are identified")));
  c.models[0].parameters = {drag};
  EXPECT_THAT(warnings_of_skill(c), ElementsAre(HasSubstr("No detectable interaction")));
}

}  // namespace
}  // namespace swarmfit
