// SPDX-License-Identifier: MIT
#include "fit/compare/refute.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "fit/experiment/objective.h"
#include "fit/study/recovery.h"
#include "tests/eval/build.h"
#include "tests/fit/planted.h"

namespace swarmfit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

const PanelPlan kPlan{3, 0.01, {0, 1, 2, 4}, {1, 2}};

std::size_t item(const std::string& key) {
  const auto items = kPlan.items();
  return static_cast<std::size_t>(std::find_if(items.begin(), items.end(), [&](const auto& i) { return i.key == key; }) - items.begin());
}

// A recording with 100 of everything, its polarisation .68, its velocities uncorrelated after two frames; standard errors are 2 %.
struct Recorded : PanelEstimate {
  Recorded() {
    value.values.assign(kPlan.items().size(), 100.0);
    value.values[item("polarisation")] = 0.68;
    value.values[item("vacf_zero")] = 0.02;
    se.values = value.values;
    for (double& x : se.values) x *= 0.02;
    value.vacf = {1, 0.4, 0, -0.1};
    se.vacf.assign(4, 0.02);
  }
};

// 24 runs about the same numbers, but for those that are set; they scatter by 3 %.
struct Runs {
  Panel mean = Recorded().value;
  std::vector<Panel> take(std::size_t number = 24) const {
    std::vector<Panel> out;
    for (std::size_t k = 0; k < number; ++k) {
      out.push_back(mean);
      const double off = 0.03 * (k % 2 == 0 ? 1 : -1);
      for (double& x : out.back().values) x *= 1 + off;
      for (double& c : out.back().vacf) c += off;
    }
    return out;
  }
};

std::vector<std::string> refuting(const Runs& runs, const Recorded& recording = {}, std::size_t number = 24) {
  std::vector<std::string> keys;
  for (const Refutation& f : refutations(kPlan, recording, runs.take(number))) keys.push_back(f.item.key);
  return keys;
}

TEST(Refutations, FactsThatAreFarOffAndNothingElse) {
  Runs runs;
  EXPECT_THAT(refuting(runs), IsEmpty());
  runs.mean.values[item("polarisation")] = 0.13;
  runs.mean.values[item("speed")] = 130;
  runs.mean.values[item("sd_y")] = 60;
  runs.mean.values[item("nearest")] = 200;
  for (const char* fitted_elsewhere : {"k_x", "kurtosis", "nearest_ratio"}) runs.mean.values[item(fitted_elsewhere)] = 1000;
  EXPECT_THAT(refuting(runs), ElementsAre("sd_y", "speed", "polarisation", "nearest"));
  const auto found = refutations(kPlan, Recorded(), runs.take());
  EXPECT_EQ(found[1].recording.value, 100);
  EXPECT_NEAR(found[1].recording.se, 2, 1e-12);
  EXPECT_NEAR(found[1].model, 130, 1e-9);
  EXPECT_NEAR(found[1].sd, 130 * 0.03 * std::sqrt(24.0 / 23), 1e-9);
}

// Seven facts share 1/200: two-sided Student's t of 24 runs is 3.904 (by numerical integration), and 116.2 is where
// x - 100 = t hypot(.03 x √(24/23) √(25/24), 2).
TEST(Refutations, ByMoreThanChance) {
  Runs runs;
  runs.mean.values[item("speed")] = 116.1;
  EXPECT_THAT(refuting(runs), IsEmpty());
  runs.mean.values[item("speed")] = 116.3;
  EXPECT_THAT(refuting(runs), ElementsAre("speed"));
  EXPECT_THAT(refuting(runs, {}, 3), IsEmpty()) << "three runs say little of their scatter";
  Recorded rough;
  rough.se.values[item("speed")] = 5;
  EXPECT_THAT(refuting(runs, rough), IsEmpty()) << "a recording that is not sure of itself refutes nobody";
  rough.se.values[item("speed")] = NAN;
  EXPECT_THAT(refuting(runs, rough), IsEmpty());
}

TEST(Refutations, NotByWhatNobodySees) {
  Recorded sure;
  for (double& se : sure.se.values) se = 1e-6;
  const auto without_scatter = [&](const char* key, double value) {
    Runs runs;
    runs.mean.values[item(key)] = value;
    std::vector<Panel> same(24, runs.mean);
    for (std::size_t k = 0; k < same.size(); ++k) same[k].values[item(key)] += 1e-6 * static_cast<double>(k);
    return refutations(kPlan, sure, same).size();
  };
  EXPECT_EQ(without_scatter("speed", 109), 0u);
  EXPECT_EQ(without_scatter("speed", 111), 1u);
  EXPECT_EQ(without_scatter("polarisation", 0.64), 0u);
  EXPECT_EQ(without_scatter("polarisation", 0.62), 1u);
}

TEST(Refutations, UndefinedNumbersRefuteNobody) {
  Runs runs;
  for (double& x : runs.mean.values) x = NAN;
  EXPECT_THAT(refuting(runs), IsEmpty());
  EXPECT_THAT(refuting(Runs(), {}, 0), IsEmpty());
}

// The earlier zero decides: at lag 2 the recording's velocities are uncorrelated.
TEST(Refutations, MemoryWithAndWithoutAZero) {
  Runs runs;
  runs.mean.vacf = {1, 0.9, 0.8, 0.7};
  runs.mean.values[item("vacf_zero")] = NAN;
  EXPECT_THAT(refuting(runs), ElementsAre("vacf_zero"));
  runs.mean.vacf = {1, 0.3, 0.09, 0};
  EXPECT_THAT(refuting(runs), IsEmpty()) << "what is left is too little to see";
  runs.mean.vacf = {1, -0.2, 0, 0};
  EXPECT_THAT(refuting(runs), ElementsAre("vacf_zero")) << "it forgets at once";
  Recorded endless;
  endless.value.vacf = {1, 0.9, 0.8, 0.7};
  endless.value.values[item("vacf_zero")] = NAN;
  EXPECT_THAT(refuting(Runs(), endless), ElementsAre("vacf_zero"));
  runs.mean.vacf = {1, 0.95, 0.9, 0.8};
  EXPECT_THAT(refuting(runs, endless), IsEmpty()) << "neither forgets";
}

Comparison refuted() {
  Comparison c;
  c.recording.data.unit = "mm";
  c.recording.panel.lags = {0, 0.01, 0.02, 1.5};
  const auto items = kPlan.items();
  c.models.resize(3);
  for (std::size_t k = 0; k < 3; ++k) {
    c.models[k].model = std::string(1, static_cast<char>('a' + k));
    c.models[k].standing.rank = static_cast<int>(k) + 1;
    c.models[k].standing.certainty.group = k < 2 ? 1 : 2;
    c.models[k].likeness.refuted_by = {{items[item("speed")], {213, 4}, 18700, 230},
                                       {items[item("polarisation")], {0.68, 0.04}, 0.13, 0.03},
                                       {items[item("vacf_zero")], {0.47, 0.02}, NAN, NAN}};
  }
  return c;
}

TEST(WarningsOfFacts, OneSentenceForEachOfTheBest) {
  Comparison c = refuted();
  EXPECT_THAT(warnings_of_facts(c), ElementsAre(StartsWith("Simple observables contradict a as fitted: the mean speed is 18700 ± 230 "
                                                           "mm/s, in the recording 213 ± 4 mm/s; the polarisation is 0.13 ± 0.03, in the "
                                                           "recording 0.68 ± 0.04; velocities keep their direction for longer than "
                                                           "1.5 s (first zero of the autocorrelation), in the recording for 0.47 ± 0.02 s"),
                                                StartsWith("Simple observables contradict b as fitted")));
  c.models[1].standing.certainty.group = 2;
  EXPECT_EQ(warnings_of_facts(c).size(), 1u);
  c.models[0].likeness.refuted_by.clear();
  EXPECT_THAT(warnings_of_facts(c), IsEmpty());
}

// Recordings and the parameters that made them, of which half a per cent may be refuted: of 72, three or more with probability 0.006.
// (rvo is not among them: its agents have goals that no recording shows, so that it does not go on as the recording did.)
TEST(Refutations, HardlyEverOfTheTruth) {
  const Scales scales{130, 40, 210};
  PlantOptions film = test::small_swarm(1);
  film.agents = 12;
  film.frames = 150;
  film.sigma = 0.3;
  int refuted = 0;
  for (const char* name : {"bswarm", "brownian", "langevin", "vicsek", "zonal", "boids"}) {
    const ModelChoice model = parse_model(name);
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      const auto truth = varied(model, planted_parameters(model, scales), scales, 2, seed);
      const Tracks recording = planted_recording(model, truth, film, scales, seed);
      ConditionOptions options;
      options.steps = 10;  // as filmed
      const Conditions conditions = make_conditions(recording, options);
      const Target target(metric_samples(recording), Binning::standard(Normalisation::reference));
      const Ensemble ensemble(model, conditions);
      const PanelPlan plan = panel_plan(recording);
      std::vector<Panel> runs;
      for (const Rng& s : replicate_seeds({seed}, Stream::final_seeds, 24))
        if (const auto run = ensemble.run({truth, s}); !run.blew_up) runs.push_back(panel(run.seen, plan));
      refuted += !refutations(plan, panel_with_error(recording, plan), runs).empty();
    }
  }
  EXPECT_LE(refuted, 2);
}

}  // namespace
}  // namespace swarmfit
