// SPDX-License-Identifier: MIT
#include "reports/comparison/words.h"
#include "reports/write/plain_text.h"

#include <gmock/gmock.h>

#include <cmath>

#include "reports/write/unit_text.h"
#include "tests/reports/sample.h"

namespace swarmfit {
namespace {

using testing::HasSubstr;
using testing::Not;

// Models in these groups, each explained by the recording at p = 0.5/rank; the second leaves the confidence set at p = 1/2.
Comparison in_groups(const std::vector<int>& groups) {
  std::vector<Sketch> sketches;
  for (std::size_t k = 0; k < groups.size(); ++k)
    sketches.push_back({std::string(1, static_cast<char>('a' + k)), 0.9 - 0.1 * static_cast<double>(k), 0.01, 1.1});
  Comparison c = sample_comparison(sketches);
  for (std::size_t k = 0; k < groups.size(); ++k) c.models[k].standing.certainty.group = groups[k];
  return c;
}

TEST(Headline, ClearWinner) {
  const Headline h = headline(in_groups({1, 2, 2}));
  EXPECT_EQ(h.verdict, Verdict::clear);
  EXPECT_EQ(h.sentence, "a matches the recording best.");
  EXPECT_THAT(h.detail, HasSubstr("leads b by 0.100 in score (p = 0.5)"));
  EXPECT_THAT(h.detail, HasSubstr("The recording is as close to a as recordings simulated from a are (p = 0.5)."));
  EXPECT_THAT(h.detail, HasSubstr("a fits "));
}

TEST(Headline, ModelsOfTheBestGroupAreATie) {
  const Headline h = headline(in_groups({1, 1, 2}));
  EXPECT_EQ(h.verdict, Verdict::tie);
  EXPECT_EQ(h.sentence, "a and b are not distinguishable with this recording and budget.");
  EXPECT_THAT(h.detail, HasSubstr("a has the highest score, but its lead over b, 0.100, is within chance (p = 0.5)."));
}

// The second may be told from the first where the third cannot.
TEST(Headline, TheLeadWithinChanceIsOverAModelOfTheSameGroup) {
  const Headline h = headline(in_groups({1, 2, 1}));
  EXPECT_EQ(h.sentence, "a and c are not distinguishable with this recording and budget.");
  EXPECT_THAT(h.detail, HasSubstr("its lead over c, 0.200, is within chance"));
}

TEST(Headline, SaysThatNoModelExplainsTheRecording) {
  Comparison c = in_groups({1, 2});
  c.models[0].standing.certainty.gof_p = c.models[0].standing.certainty.gof_q = 0.01;
  EXPECT_EQ(headline(c).sentence, "a matches the recording best.");  // b could have made it
  EXPECT_THAT(headline(c).detail, HasSubstr("The recording is farther from a than recordings simulated from a are (p ≤ 0.01)."));
  c.models[1].standing.certainty.gof_q = 0.05;
  EXPECT_EQ(headline(c).sentence, "Every fitted model is rejected (p ≤ 0.05); a is least wrong.");
  c.models[1].standing.certainty.group = 1;
  EXPECT_EQ(headline(c).sentence, "Every fitted model is rejected (p ≤ 0.05); a and b are least wrong and not distinguishable.");
  c.models[1].standing.certainty.group = 2;
  c.models[1].standing.certainty.gof_q = NAN;
  EXPECT_EQ(headline(c).sentence, "a matches the recording best.");
  c.models.pop_back();
  EXPECT_THAT(headline(c).sentence, HasSubstr("It is rejected (p ≤ 0.05)."));
}

TEST(Headline, ARandomWalkIsAnAnswer) {
  Comparison c = in_groups({1, 2});
  c.ranking.walk_suffices = true;
  const Headline close = headline(c);
  EXPECT_EQ(close.verdict, Verdict::walk);
  EXPECT_EQ(close.sentence, "No model is closer to the recording than a random walk of its own steps.");
  EXPECT_THAT(close.detail, testing::StartsWith("Among the models: a matches the recording best. It leads b by"));
  c.recording.skill.memory_p = 0.34;
  c.ranking.walk_suffices = false;
  const Headline forgets = headline(c);
  EXPECT_EQ(forgets.verdict, Verdict::walk);
  EXPECT_EQ(forgets.sentence, "The recording cannot be distinguished from a random walk of its own steps.");
  EXPECT_THAT(forgets.detail, testing::StartsWith("It shows no memory of direction (p = 0.34), so no model can be shown to explain more of "
                                                  "its motion. Among the models: a matches the recording best."));
  c.recording.skill.memory_p = 0.05;
  EXPECT_EQ(headline(c).verdict, Verdict::clear);
  for (ModelFit& r : c.models) r.standing.score = NAN;
  c.recording.skill.memory_p = 0.34;
  EXPECT_EQ(headline(c).verdict, Verdict::none);
}

TEST(Headline, NamesTheFactsThatRefuteTheWinner) {
  Comparison c = in_groups({1, 2});
  EXPECT_THAT(headline(c).detail, Not(HasSubstr("contradict")));
  const auto& items = c.recording.panel.items;
  c.models[0].likeness.refuted_by = {{items[3], {}, 1, 0}, {items[4], {}, 1, 0}};
  EXPECT_THAT(headline(c).detail, HasSubstr("Simple observables contradict it: mean speed and memory of direction."));
  c.models.pop_back();
  EXPECT_THAT(headline(c).detail, HasSubstr("Simple observables contradict it: mean speed and memory of direction."));
}

TEST(KeptFixed, OnceForAllModelsThatShareIt) {
  Comparison c = in_groups({1, 2, 3, 4});
  c.models[2].parameters[3].value = 0.5;
  c.models[2].parameters.push_back({"max_neighbours", "", "", "", 10, 10, 10, false, false, false});
  for (ParameterResult& p : c.models[3].parameters) p.fitted = true;
  EXPECT_EQ(kept_fixed(c), "a and b: radius 4.1 mm; c: radius 0.5 mm, max_neighbours 10");
  for (ModelFit& r : c.models) r.parameters.clear();
  EXPECT_EQ(kept_fixed(c), "");
}

TEST(Words, StepsPerFrameOfEveryModel) {
  Comparison c = in_groups({1, 2, 3, 3});
  c.models[0].runs.steps = 4;
  EXPECT_EQ(steps_taken(c), "b, c and d 2; a 4");
  c.models[2].runs.map = true;
  EXPECT_EQ(steps_taken(c), "b and d 2; a 4; c takes one step per frame by definition");
}

TEST(Headline, SaysWhichModelIsFirstInSample) {
  Comparison c = in_groups({1, 2});
  EXPECT_THAT(what_held_out_means(c), HasSubstr("in sample, that is, on the frames that the models were fitted to"));
  c.recording.hold_out.ways = {{1, 240, 261, 500, {}, {}}, {261, 500, 1, 240, {}, {}}};
  c.models[0].standing.in_sample.score = 0.4;
  c.models[1].standing.in_sample.score = 0.3;
  EXPECT_THAT(headline(c).detail, Not(HasSubstr("In sample")));
  c.models[1].standing.in_sample.score = 0.5;
  EXPECT_THAT(headline(c).detail, HasSubstr("In sample b has the highest score."));
  EXPECT_THAT(what_held_out_means(c), HasSubstr("fitted to frames 1 to 240 and scored on frames 261 to 500, and the other way round"));
}

TEST(Words, FittedValuesWithTheRangeOfTheHalves) {
  ModelFit m;
  m.parameters = {{"gamma", "", "1/mm", "", 0.5, 0, 1, true}, {"k", "", "", "", 2, 0, 3, true}, {"fixed", "", "", "", 1, 1, 1, false}};
  EXPECT_EQ(fitted_values(m), "gamma 0.500 1/mm, k 2.00");
  m.parameters[0].halves_lower = 0.25, m.parameters[0].halves_upper = 1;
  EXPECT_EQ(fitted_values(m), "gamma 0.500 (0.250 .. 1.00) 1/mm, k 2.00");
}

// One in a hundred is the least that 99 simulated recordings can say.
TEST(Words, FitPThatIsABoundSaysSo) {
  Comparison c = in_groups({1, 2});
  c.ranking.bootstrap_recordings = 99;
  c.models[0].standing.certainty.gof_p = 0.01;
  EXPECT_EQ(fit_p(c, c.models[0]), "≤ 0.01");
  c.models[0].standing.certainty.gof_p = 0.02;
  EXPECT_EQ(fit_p(c, c.models[0]), "0.02");
  c.models[0].standing.certainty.gof_p = NAN;
  EXPECT_EQ(fit_p(c, c.models[0]), "–");
}

TEST(Words, ABestValueOutsideItsIntervalIsNotIdentified) {
  ParameterResult p;
  p.value = 5;
  p.posterior = {3, 1, 4, 0.9, "identified", "", NAN};
  EXPECT_EQ(verdict_text(p), "inconsistent");
  p.value = 2;
  EXPECT_EQ(verdict_text(p), "identified");
}

TEST(Words, ALowerLimitOfCandidatesBelongsToTheBudget) {
  Comparison c = in_groups({1, 2});
  c.run.budget.name = "quick";
  c.run.config = {{"max-evaluations", "0"}};
  EXPECT_EQ(budget_text(c), "quick");
  c.run.config = {{"max-evaluations", "150"}};
  EXPECT_EQ(budget_text(c), "quick, at most 150 candidates per model");
}

TEST(Words, FileNamesAreNotPaths) {
  EXPECT_EQ(file_name("/home/me/data/swarm.txt"), "swarm.txt");
  EXPECT_EQ(file_name("swarm.txt"), "swarm.txt");
  EXPECT_EQ(file_name("demo"), "demo");
}

TEST(Headline, LettersAndIntervals) {
  const Comparison c = in_groups({1, 2, 0});
  EXPECT_EQ(group_letter(c.models[0]) + group_letter(c.models[1]) + group_letter(c.models[2]), "ab");
  EXPECT_EQ(score_interval(c.models[0]), "0.87 .. 0.92");
  Comparison unknown = c;
  unknown.models[0].standing.certainty.lower = NAN;
  EXPECT_EQ(score_interval(unknown.models[0]), "–");
}

TEST(Headline, SingleModelHasNothingToRank) {
  const Headline h = headline(sample_comparison({{"bswarm", 1, NAN, 1.1}}));
  EXPECT_EQ(h.verdict, Verdict::single);
  EXPECT_THAT(h.sentence, HasSubstr("only model"));
}

TEST(Headline, WithoutGroupsThatIsSaid) {
  const Headline h = headline(in_groups({0, 0, 0}));
  EXPECT_EQ(h.verdict, Verdict::open);
  EXPECT_THAT(h.detail, HasSubstr("certainty not known"));
}

TEST(Headline, ModelsWithoutScoreDoNotCount) {
  const Headline h = headline(sample_comparison({{"bswarm", NAN, NAN, 1.1}, {"boids", NAN, NAN, 1.4}}));
  EXPECT_EQ(h.verdict, Verdict::none);
  EXPECT_EQ(headline(Comparison{}).verdict, Verdict::none);
}

TEST(Units, OfMetricsAndDensities) {
  EXPECT_EQ(metric_unit(kSpeed, "mm"), "mm/s");
  EXPECT_EQ(metric_unit(kJerk, "mm"), "mm/s³");
  EXPECT_EQ(metric_unit(kAngularAcceleration, "mm"), "rad/s²");
  EXPECT_EQ(metric_unit(kVelocityDifference, "mm"), "1/s");
  EXPECT_EQ(metric_unit(kDistance, ""), "unit");
  EXPECT_EQ(density_unit(kSpeed, "mm"), "1/(mm/s)");
  EXPECT_EQ(density_unit(kVelocityDifference, "mm"), "s");
  EXPECT_EQ(density_unit(kDistance, "mm"), "1/mm");
}

TEST(Printable, ControlCharactersAreShownAsQuestionMarks) {
  EXPECT_EQ(printable("a\033[31mb\nc\x7f"), "a?[31mb?c?");
  EXPECT_EQ(printable("\xC2\x9B"
                      "31m µ"),
            "?31m µ");  // U+009B is a terminal's "escape [" in one character
}

TEST(Enumerate, ReadsAsASentence) {
  EXPECT_EQ(enumerate({}), "");
  EXPECT_EQ(enumerate({"a"}), "a");
  EXPECT_EQ(enumerate({"a", "b", "c"}), "a, b and c");
}

}  // namespace
}  // namespace swarmfit
