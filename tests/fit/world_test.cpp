// SPDX-License-Identifier: MIT
// Recordings that bring walls.
#include <gmock/gmock.h>

#include "fit/experiment/objective.h"
#include "fit/experiment/plant.h"
#include "libswarm/scenario/scenario.h"
#include "libswarm/walls.h"
#include "libtrack/error.h"
#include "libtrack/file.h"

namespace swarmfit {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const char* const kCorridor =
    "[bounds]\nshape = \"box\"\nlower = [-6, -2]\nupper = [6, 2]\n[[obstacle]]\nshape = \"sphere\"\ncentre = [0, 0]\nradius = 1\n";

// Filmed without error, which simulations then have none of either.
ConditionOptions open_space() {
  ConditionOptions options;
  options.error = ConditionOptions::Error::none;
  return options;
}

ConditionOptions within(const std::string& text) {
  ConditionOptions options = open_space();
  options.world = {"corridor.toml", text};
  return options;
}

// Random walkers that know nothing of walls, between two of them.
Scenario walkers() {
  Scenario scene = plain_scenario(parse_model("brownian[confinement=none]"), 2);
  scene.bounds.lower = {-6, -2, 0};
  scene.bounds.upper = {6, 2, 0};
  scene.obstacles = {{.centre = {0, 0, 0}, .radius = 1}};
  scene.groups.front().agents = 12;
  scene.groups.front().start = {.shape = Start::Shape::box, .lower = {1.5, -1.9, 0}, .upper = {5, 1.9, 0}};
  scene.frames = 1500;
  scene.dt = 0.05;
  scene.unit = "m";
  set_parameter(scene, "C_r", 0);
  set_parameter(scene, "C_a", 0);
  return scene;
}

TEST(World, WallsOfTheRecordingMakeTheModelFitBetter) {
  const Scenario scene = walkers();
  const Tracks recording = film(scene, {}).tracks;
  const auto energy = [&](const ConditionOptions& options) {
    const Conditions conditions = make_conditions(recording, options);
    const Target target(metric_samples(conditions.recording, conditions.metrics), Binning::standard(Normalisation::reference));
    const Objective objective(scene.model, conditions, target);
    const Energies raw = objective.evaluate(scene.parameters, replicate_seeds({1}, Stream::replicate, 6)).raw;
    double sum = 0;
    for (const double e : raw) sum += std::isfinite(e) ? e : 0;
    return sum;
  };
  const double with = energy(within(kCorridor)), without = energy(open_space());
  EXPECT_LT(with, 0.7 * without) << "the same model and the same seeds, but for the walls";
}

TEST(World, NobodyLeavesItOrIsInAnObstacle) {
  const Scenario scene = walkers();
  const Conditions conditions = make_conditions(film(scene, {}).tracks, within(kCorridor));
  const auto* walls = conditions.world.part<Walls>();
  ASSERT_NE(walls, nullptr);
  const Ensemble ensemble(scene.model, conditions);
  const auto run = ensemble.run({scene.parameters, {7}});
  ASSERT_GT(run.seen.rows(), 1000);
  for (Index row = 0; row < run.seen.rows(); ++row) {
    ASSERT_LE(std::abs(run.seen.pos()(row, 1)), 2 + 1e-9);
    ASSERT_FALSE(walls->hold(run.seen.pos().row(row).transpose(), 2));
  }
}

TEST(World, IsPartOfWhatAResultHoldsFor) {
  const Tracks recording = film(walkers(), {}).tracks;
  const std::string open = fingerprint(make_conditions(recording, open_space()));
  const std::string corridor = fingerprint(make_conditions(recording, within(kCorridor)));
  std::string smaller = kCorridor;
  smaller.replace(smaller.rfind("1"), 1, "0.5");
  EXPECT_NE(open, corridor);
  EXPECT_NE(corridor, fingerprint(make_conditions(recording, within(smaller))));
  EXPECT_EQ(corridor, fingerprint(make_conditions(recording, within(kCorridor))));
}

TEST(World, WhatCannotBeIsRefused) {
  const Tracks recording = film(walkers(), {}).tracks;
  const auto refuses = [&](const std::string& text, const char* what, const char* arena = "open") {
    ConditionOptions options = within(text);
    options.arena = arena;
    EXPECT_THAT([&] { make_conditions(recording, options); }, ThrowsMessage<InputError>(HasSubstr(what)));
  };
  refuses("title = \"t\"\n", "corridor.toml:1:9: 'title' is not known; expected one of bounds, obstacle");
  refuses("[bounds]\nshape = \"box\"\nlower = [-1, -2]\nupper = [1, 2]\n", "recorded positions reach");
  refuses("[bounds]\nshape = \"periodic\"\nlower = [-99, -2]\nupper = [99, 2]\n", "expected open, box or sphere");
  refuses("[[obstacle]]\nshape = \"sphere\"\ncentre = [0, 0]\nradius = 3\n", "recorded positions are inside an obstacle");
  refuses(kCorridor, "`arena` box: is given together with the bounds of corridor.toml; expected one of the two", "box");
}

}  // namespace
}  // namespace swarmfit
