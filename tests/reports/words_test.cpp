// SPDX-License-Identifier: MIT
#include "reports/words.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/reports/sample.h"

namespace swarmfit {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Headline, ClearWinner) {
  const Headline h = headline(sample_comparison({{"bswarm", 0.9, 0.03, 1.1}, {"boids", 0.4, 0.04, 1.4}, {"rvo", 0.1, 0.1, 2}}));
  EXPECT_EQ(h.verdict, Verdict::clear);
  EXPECT_EQ(h.sentence, "bswarm moves most like the recording.");
  EXPECT_THAT(h.detail, HasSubstr("leads boids by 0.500 in score (10.0 standard errors)"));
  EXPECT_THAT(h.detail, HasSubstr("Its largest misfit is in the "));
}

TEST(Headline, WithinTwoStandardErrorsIsATie) {
  const Headline h = headline(sample_comparison({{"bswarm", 0.50, 0.03, 1.1}, {"boids", 0.41, 0.04, 1.2}, {"rvo", 0.1, 0.01, 2}}));
  EXPECT_EQ(h.verdict, Verdict::tie);
  EXPECT_THAT(h.sentence, HasSubstr("bswarm and boids cannot be told apart"));
  EXPECT_THAT(h.sentence, Not(HasSubstr("rvo")));
  EXPECT_THAT(h.detail, HasSubstr("leads boids by only 0.090 (1.8 standard errors)"));
}

TEST(Headline, TwoStandardErrorsAreEnough) {  // 0.1 / hypot(0.03, 0.04) = 2 exactly in the reals; a little more on either side here
  EXPECT_EQ(headline(sample_comparison({{"a", 0.5001, 0.03, 1}, {"b", 0.4, 0.04, 1}})).verdict, Verdict::clear);
  EXPECT_EQ(headline(sample_comparison({{"a", 0.4999, 0.03, 1}, {"b", 0.4, 0.04, 1}})).verdict, Verdict::tie);
}

TEST(Headline, SingleModelHasNothingToRank) {
  const Headline h = headline(sample_comparison({{"bswarm", 1, NAN, 1.1}}));
  EXPECT_EQ(h.verdict, Verdict::single);
  EXPECT_THAT(h.sentence, HasSubstr("only model"));
}

TEST(Headline, UnknownErrorIsSaid) {
  const Headline h = headline(sample_comparison({{"bswarm", 0.9, NAN, 1.1}, {"boids", 0.4, 0.04, 1.4}, {"rvo", 0.1, 0.1, 2}}));
  EXPECT_EQ(h.verdict, Verdict::open);
  EXPECT_THAT(h.detail, HasSubstr("standard error unknown"));
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
