// SPDX-License-Identifier: MIT
#include "fit/experiment/objective.h"

#include <gtest/gtest.h>

#include "fit/model_fit/search_space.h"
#include "tests/fit/planted.h"

namespace swarmfit {
namespace {

// A planted swarm and the objective of one model on it.
struct Scene {
  explicit Scene(const char* name, Normalisation normalisation = Normalisation::reference)
      : model(parse_model(name)), target(metric_samples(recording), Binning::standard(normalisation)) {}
  Tracks recording = test::planted_swarm(3);
  ModelChoice model;
  Conditions conditions = make_conditions(recording, {});
  Target target;
  Objective objective{model, conditions, target};
};

TEST(Objective, TrueParametersBeatWrongOnes) {
  const Scene scene("bswarm");
  const auto truth = scene_parameters(scene.model, test::midge_parameters());
  auto wrong = truth;
  wrong[static_cast<std::size_t>(scene.model.spec->find("gamma"))] *= 10;
  const auto seeds = replicate_seeds({1}, Stream::replicate, 3);
  const auto outcomes = scene.objective.evaluate({truth, wrong}, seeds);
  EXPECT_LT(outcomes[0].raw[kSpeed], 0.5 * outcomes[1].raw[kSpeed]);
  EXPECT_EQ(outcomes[0].failed, 0);
}

TEST(Objective, BlowUpIsCountedAndCostsTheWorst) {
  const Scene scene("bswarm[avoidance=none]");
  auto wild = scene_parameters(scene.model, test::midge_parameters());
  wild[static_cast<std::size_t>(scene.model.spec->find("gamma"))] = 1e9;  // explicit drag with gamma |v| dt >> 1 explodes
  const auto outcome = scene.objective.evaluate(wild, replicate_seeds({1}, Stream::replicate, 2));
  EXPECT_EQ(outcome.failed, 2);
  for (const double e : outcome.raw) EXPECT_EQ(e, scene.target.worst());
  EXPECT_TRUE(outcome.differences.empty()) << "no way is shown by what blew up";
}

TEST(Objective, SeparateNormalisationPoolsSamplesBeforeItStandardisesThem) {
  const Scene scene("bswarm", Normalisation::separate);
  const auto truth = scene_parameters(scene.model, test::midge_parameters());
  const auto seeds = replicate_seeds({1}, Stream::replicate, 2);
  MetricSamples all;
  for (const auto& seed : seeds) {
    const auto part = metric_samples(scene.objective.ensemble().run({truth, seed}).seen);
    for (std::size_t m = 0; m < kMetrics; ++m) all.values[m].insert(all.values[m].end(), part.values[m].begin(), part.values[m].end());
  }
  const Energies expected = scene.target.energies(scene.target.distributions(all));
  const Energies got = scene.objective.evaluate(truth, seeds).raw;
  for (std::size_t m = 0; m < kMetrics; ++m) EXPECT_EQ(got[m], expected[m]);
}

TEST(Objective, WhoGoesOnInARaceIsEvaluatedInFull) {
  const Scene scene("bswarm");
  const auto truth = scene_parameters(scene.model, test::midge_parameters());
  auto other = truth;
  other[static_cast<std::size_t>(scene.model.spec->find("noise"))] *= 2;
  const std::vector<std::vector<double>> candidates = {truth, other, truth};
  const auto seeds = replicate_seeds({1}, Stream::replicate, 3);
  const auto whole = scene.objective.evaluate(candidates, seeds);
  const auto first = scene.objective.evaluate(candidates, {seeds.data(), 1});
  const auto raced = scene.objective.race(candidates, seeds, 1, [&](const std::vector<Outcome>& heat) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(heat[c].first, first[c].guided);
    return std::vector<bool>{true, false, true};
  });
  for (const std::size_t c : {0, 2}) {
    EXPECT_EQ(raced[c].raw, whole[c].raw);
    EXPECT_EQ(raced[c].guided, whole[c].guided);
    EXPECT_EQ(raced[c].replicates, whole[c].replicates);
    EXPECT_EQ(raced[c].first, first[c].guided);
  }
  EXPECT_EQ(raced[1].raw, first[1].raw);
  EXPECT_EQ(raced[1].replicates.size(), 1u);
}

TEST(Objective, AModelWithAStrengthOfZeroIsItsPart) {
  const ModelChoice whole = parse_model("bswarm"), part = parse_model("bswarm[interaction=off]");
  const Conditions conditions = make_conditions(test::planted_swarm(4), {});
  const Target target(metric_samples(conditions.recording), {});
  const SearchSpace wide(whole, conditions.scales, {}), narrow(part, conditions.scales, {});
  const Point there = Point::Constant(narrow.dimensions(), 0.3);
  const auto values = wide.parameters(wide.adopt(Point::Zero(wide.dimensions()), narrow, there));
  const auto seeds = replicate_seeds({1}, Stream::replicate, 2);
  EXPECT_EQ(Objective(whole, conditions, target).evaluate(values, seeds).raw,
            Objective(part, conditions, target).evaluate(narrow.parameters(there), seeds).raw);
}

}  // namespace
}  // namespace swarmfit
