// SPDX-License-Identifier: MIT
// Do scenarios behave as they expect? Small ones here, with two seeds; all of them with ten in tests/acceptance/scenarios.
#include <gmock/gmock.h>

#include "fit/experiment/expect.h"
#include "libswarm/scenario/read.h"
#include "libtrack/error.h"

namespace swarmfit {
namespace {

Scenario named(std::string_view name) {
  for (const ScenarioFile& file : scenario_files())
    if (file.name == name) return read_scenario(std::string(name) + ".toml", std::string(file.text));
  throw InputError("no such scenario");
}

TEST(Scenarios, AskForMeasuresThatThereAre) {
  for (const ScenarioFile& file : scenario_files()) EXPECT_NO_THROW(check_expectations(named(file.name))) << file.name;
}

TEST(Scenarios, SmallOnesBehaveAsTheyExpect) {
  for (const char* name : {"midges", "fruit_flies", "phototaxis", "two_blocks"})
    for (const std::uint64_t seed : {1U, 2U}) {
      Scenario scene = named(name);
      scene.seed = seed;
      for (const Finding& f : findings(scene, film(scene, {})))
        EXPECT_TRUE(f.met()) << name << ", seed " << seed << ": " << f.name << " is " << f.value << ", expected " << f.above << " to "
                             << f.below;
    }
}

// A number that must fail does: the same moths without a lamp.
TEST(Scenarios, WithoutTheLampMothsDoNotCome) {
  Scenario scene = named("phototaxis");
  scene.stimuli.front().until = 0;
  scene.parameters[static_cast<std::size_t>(scene.model.spec->find("chi_att"))] = 0;
  scene.expectations.resize(1);
  const Film made = film(scene, {});
  EXPECT_FALSE(findings(scene, made).front().met());
}

TEST(Scenarios, TheSameForAnyCamera) {
  Scenario scene = named("phototaxis");
  scene.frames = 40;
  const Film clear = film(scene, {}), blurred = film(scene, {.sigma = 0.1, .dropout = 0.05});
  EXPECT_LT(blurred.tracks.rows(), clear.tracks.rows());
  EXPECT_GT(blurred.tracks.rows(), clear.tracks.rows() / 2);
  EXPECT_TRUE((clear.stimuli.pos() == blurred.stimuli.pos()).all()) << "stimuli are seen without error";
}

// Parameters change as the paper says they act, on the numbers alone (Ren et al. 2016, p. 8).
TEST(Scenarios, ParametersActAsThePaperSays) {
  const auto value = [](const char* parameter, double factor, const char* measure) {
    Scenario scene = named("fruit_flies");
    scene.model = parse_model("bswarm[avoidance=none]");
    scene.frames = 100;
    const int row = scene.model.spec->find(parameter);
    scene.parameters[static_cast<std::size_t>(row)] *= factor;
    scene.expectations = {{.name = "x", .measure = measure, .above = 0}};
    double sum = 0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      scene.seed = seed;
      sum += findings(scene, film(scene, {})).front().value;
    }
    return sum / 3;
  };
  EXPECT_GT(value("r_rep", 2, "extent"), value("r_rep", 1, "extent")) << "larger r_rep: sparser";
  EXPECT_LT(value("r_att", 1, "extent"), value("r_att", 0.05, "extent")) << "larger r_att: denser";
  EXPECT_GT(value("noise", 3, "speed"), value("noise", 1, "speed")) << "more noise: faster";
}

}  // namespace
}  // namespace swarmfit
