// SPDX-License-Identifier: MIT
#include "fit/compare/warnings.h"

#include <gmock/gmock.h>

namespace swarmfit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;
using testing::StartsWith;

ModelFit on_a_bound(const std::string& name) {
  ModelFit r;
  r.model = name;
  r.likeness.skill = {0.5, 0.01};
  ParameterResult p;
  p.name = "noise";
  p.at_bound = true;
  r.parameters = {p};
  r.runs.mean_ratio.fill(1);
  return r;
}

Comparison on_bounds() {
  Comparison c;
  c.models = {on_a_bound("a"), on_a_bound("b"), on_a_bound("c")};
  c.recording.data.individuals_per_frame = 10;
  c.ranking.weights_converged = true;
  return c;
}

// The terminal shows three: what rules out a conclusion must be among them, however many models ended on a bound.
TEST(AllWarnings, WhatRulesOutAConclusionComesFirst) {
  Comparison c = on_bounds();
  EXPECT_THAT(all_warnings(c), ElementsAre(StartsWith("a: noise"), StartsWith("b: noise"), StartsWith("c: noise")));
  c.recording.skill.interaction_p[0] = c.recording.skill.interaction_p[1] = 0.4;
  c.models[0].standing.rank = 1;
  c.models[0].likeness.refuted_by.resize(1);
  const std::vector<Warning> all = all_warnings(c);
  ASSERT_THAT(all, SizeIs(5));
  EXPECT_THAT(all[0].text, StartsWith("No detectable interaction"));
  EXPECT_THAT(all[1].text, StartsWith("Simple observables contradict a"));
  EXPECT_THAT(all[2].text, StartsWith("a: noise"));
}

// Small changes of the weights hardly move a score.
TEST(AllWarnings, WeightsThatHardlyMoveAreANote) {
  Comparison c = on_bounds();
  c.ranking.weights_converged = false;
  c.ranking.weight_history.resize(3);
  c.ranking.weight_history.back().largest_change = 0.05;
  EXPECT_THAT(all_warnings(c).front().text, HasSubstr("weights had not converged"));
  c.ranking.weight_history.back().largest_change = 0.015;
  EXPECT_THAT(all_warnings(c).back().text, HasSubstr("weights had not converged"));
  EXPECT_EQ(all_warnings(c).back().gravity, Gravity::note);
}

TEST(AllWarnings, ASecondOpinionThatDisagreesIsANote) {
  Comparison c = on_bounds();
  c.models.resize(1);
  ParameterResult& p = c.models[0].parameters[0];
  p.at_bound = false;
  p.value = 3;
  EXPECT_THAT(all_warnings(c), SizeIs(0)) << "without an interval nothing disagrees";
  p.regression = {2, 1, 2.9};
  ASSERT_THAT(all_warnings(c), SizeIs(1));
  EXPECT_THAT(all_warnings(c)[0].text, HasSubstr("disagree about noise: the best value lies outside"));
  EXPECT_EQ(all_warnings(c)[0].gravity, Gravity::note);
  p.regression.upper = 3.1;
  EXPECT_THAT(all_warnings(c), SizeIs(0));
}

}  // namespace
}  // namespace swarmfit
