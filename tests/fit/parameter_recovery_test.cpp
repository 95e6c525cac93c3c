// SPDX-License-Identifier: MIT
#include "fit/study/parameter_recovery.h"

#include <gmock/gmock.h>

#include <cmath>

#include "fit/model_fit/parameter_posterior.h"

namespace swarmfit {
namespace {

// Python, math.comb: the least k with P(X <= k) >= 0.005 is 181 of 200 and 89 of 100, with P(X <= k) >= 0.995 it is 197 and 100.
TEST(CoverageBand, ByAnIndependentImplementation) {
  EXPECT_EQ(coverage_band(200, 1), std::pair(181, 197));
  EXPECT_EQ(coverage_band(100, 1), std::pair(89, 100));
  EXPECT_EQ(coverage_band(200, 5), std::pair(179, 198));
}

TEST(Settling, TakesTheSwarmsOwnTimeButAThirdAtMost) {
  Conditions c;
  TrackMeta meta;
  meta.dt = 0.01;
  c.recording = Tracks({}, meta);
  c.scales = {100, 70, 250};  // L / V = 0.4 s
  c.frames = 500;
  EXPECT_EQ(settling_frames(c), 40);
  c.frames = 90;
  EXPECT_EQ(settling_frames(c), 30);
}

// On the root axis from 0 to 91550 the first is from .04 to .50: away from the bound, and yet it says "less than 23000".
TEST(Verdict, IsThatOfPhysicalUnits) {
  const auto verdict = [](double lower, double upper, Identifiability on_axis) {
    ParameterInterval p;
    p.lower = lower, p.upper = upper, p.verdict = on_axis;
    return verdict_in_units(p, 0, 91550);
  };
  EXPECT_EQ(verdict(126, 22770, Identifiability::identified), Identifiability::one_sided);
  EXPECT_EQ(verdict(20050, 91500, Identifiability::identified), Identifiability::one_sided);
  EXPECT_EQ(verdict(20050, 21150, Identifiability::identified), Identifiability::identified);
  EXPECT_EQ(verdict(126, 22770, Identifiability::flat), Identifiability::flat);
}

RecoveryOptions brownian(int seeds) {
  RecoveryOptions o;
  o.compare.models = o.planted = {parse_model("brownian[interaction=none]")};
  o.compare.conditions.error = ConditionOptions::Error::none;
  o.film.agents = 8;
  o.film.frames = 80;
  o.film.dt = 0.01;
  o.film.unit = "mm";
  o.scales = {100, 70, 225};
  o.seeds = seeds;
  return o;
}

TEST(ParameterRecovery, FindsWhatWasPlanted) {
  const ParameterRecovery r = recover_parameters(brownian(6));
  ASSERT_EQ(r.cases.size(), 6u);
  std::vector<std::string> names;
  for (const ParameterCoverage& p : r.parameters) {
    names.push_back(p.name);
    EXPECT_EQ(p.recordings, 6);
    EXPECT_EQ(p.identified + p.one_sided + p.flat, 6);
    EXPECT_GE(p.covered, 4) << p.name;  // fewer than four of six at 95 %: one in 1000
  }
  EXPECT_THAT(names, testing::ElementsAre("gamma1", "gamma2", "D", "k"));
  const ParameterCoverage& noise = r.parameters[2];
  EXPECT_EQ(noise.identified, 6);  // eighty frames of eight particles fix the noise within a tenth of its range
  EXPECT_LT(noise.width, 0.15);
  EXPECT_LT(noise.rmse, 0.06);
}

// Ranks of the truth in posteriors: within the band of uniform ones, in every parameter and in all together.
TEST(ParameterRecovery, RanksOfTheTruthAreUniform) {
  const ParameterRecovery r = recover_parameters(brownian(12));
  ASSERT_EQ(r.cases.size(), 12u);
  EXPECT_NEAR(r.uniform_band, std::sqrt(std::log(200.0) / 24), 1e-15);  // four parameters, and all together
  for (const ParameterCase& c : r.cases) {
    ASSERT_EQ(c.rank.size(), 4u);
    for (const double rank : c.rank) EXPECT_TRUE(rank >= 0 && rank <= 1) << rank;
    EXPECT_TRUE(c.nearer >= 0 && c.nearer <= 1) << c.nearer;
  }
  for (const ParameterCoverage& p : r.parameters) EXPECT_LT(p.from_uniform, r.uniform_band) << p.name;
  EXPECT_LT(r.from_uniform, r.uniform_band);
}

// Bias, error and width by hand from the cases.
TEST(ParameterRecovery, SumsUpItsCases) {
  const ParameterRecovery r = recover_parameters(brownian(2));
  double bias = 0, square = 0, width = 0;
  int covered = 0;
  for (const ParameterCase& c : r.cases) {
    const double error = c.median_place[0] - c.truth_place[0];
    bias += error / 2, square += error * error / 2, width += c.width[0] / 2;
    covered += c.truth[0] >= c.found[0].lower && c.truth[0] <= c.found[0].upper;
  }
  EXPECT_NEAR(r.parameters[0].bias, bias, 1e-15);
  EXPECT_NEAR(r.parameters[0].rmse, std::sqrt(square), 1e-15);
  EXPECT_NEAR(r.parameters[0].width, width, 1e-15);
  EXPECT_EQ(r.parameters[0].covered, covered);
}

TEST(ParameterRecovery, CanBeInterrupted) {
  const swarmfit::Threads stopped([] { return true; });
  EXPECT_THROW(recover_parameters(brownian(2), {}, {&stopped}), Interrupted);
}

}  // namespace
}  // namespace swarmfit
