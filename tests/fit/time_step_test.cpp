// SPDX-License-Identifier: MIT
#include "fit/experiment/time_step.h"

#include <gtest/gtest.h>

#include "fit/compare/compare.h"
#include "fit/study/recovery.h"
#include "tests/fit/planted.h"

namespace swarmfit {
namespace {

constexpr Scales kScales{100, 70, 225};

struct Case {
  ModelChoice model;
  std::vector<double> truth;
  Conditions conditions;
  Target target;
  Objective objective;

  Case(const char* name, double fps, std::int64_t frames, const std::map<std::string, double>& set = {})
      : model(parse_model(name)),
        truth(planted_parameters(model, kScales, set)),
        conditions(make_conditions(planted_recording(model, truth, film(fps, frames), kScales, 1), {})),
        target(recorded_samples(conditions.recording, conditions.metrics), Binning::standard(Normalisation::reference)),
        objective(model, conditions, target) {}

  static PlantOptions film(double fps, std::int64_t frames) {
    PlantOptions o;
    o.agents = 10;
    o.frames = frames;
    o.dt = 1 / fps;
    o.unit = "mm";
    return o;
  }

  int settled() {
    const auto few = replicate_seeds({1}, Stream::selection, 12), more = replicate_seeds({1}, Stream::confirmation, 24);
    settle_steps(objective, target, {truth}, {few, more}, objective.ensemble().stable_steps());
    return objective.ensemble().steps();
  }
};

// Friction, forces and kicks are slow beside a frame, and noise within a step is exact: one step will do.
TEST(TimeStep, OneIsEnoughWhereStepsAreExact) {
  EXPECT_EQ(Case("langevin", 25, 100).settled(), 1);
  EXPECT_EQ(Case("brownian", 100, 150).settled(), 1);
}

// Boids turn towards unit vectors, which flip from step to step: ten per frame were filmed, and one is another motion.
TEST(TimeStep, MoreWhereOneChangesEnergies) {
  Case boids("boids", 25, 150);
  const int before = boids.objective.ensemble().steps(), steps = boids.settled();
  EXPECT_GT(steps, before);
  EXPECT_LE(steps, 16 * before);
  const auto seeds = replicate_seeds({2}, Stream::selection, 12);
  EXPECT_EQ(boids.objective.ensemble().steps(), steps) << "the objective keeps them";
  boids.objective.use_steps(before);
  const Outcome coarse = boids.objective.evaluate(boids.truth, seeds);
  EXPECT_FALSE(same_energies(coarse, boids.objective.evaluate(boids.truth, seeds, 2), boids.target));
}

TEST(TimeStep, MapsTakeOne) {
  for (const char* name : {"vicsek", "zonal", "bswarm[noise=gaussian,noise_scaling=literal]"}) {
    Case map(name, 5, 60);
    EXPECT_EQ(map.objective.ensemble().steps(), 1) << name;
    map.objective.use_steps(7);
    EXPECT_EQ(map.objective.ensemble().steps(), 1) << name;
  }
}

TEST(TimeStep, SameEnergies) {
  const Case any("langevin", 25, 60);
  const std::size_t columns = any.target.columns().size();
  const auto outcome = [&](double speed, double scatter) {
    Outcome o;
    o.raw = Energies(columns, 1.0);
    o.raw[kSpeed] = speed;
    for (const double sign : {-1.0, 1.0, -1.0, 1.0}) {
      o.replicates.push_back(o.raw);
      o.replicates.back()[kSpeed] += sign * scatter;
    }
    return o;
  };
  EXPECT_TRUE(same_energies(outcome(1, 0), outcome(1.09, 0), any.target)) << "below 1/200 of 20";
  EXPECT_FALSE(same_energies(outcome(0.3, 0), outcome(0.41, 0), any.target));
  EXPECT_TRUE(same_energies(outcome(6, 0), outcome(6.6, 0), any.target)) << "a tenth of what is far away";
  EXPECT_FALSE(same_energies(outcome(6, 0), outcome(6.8, 0), any.target));
  EXPECT_TRUE(same_energies(outcome(9, 0), outcome(12, 0), any.target)) << "both above a third of the worst";
  EXPECT_FALSE(same_energies(outcome(6, 0), outcome(12, 0), any.target));
  // se = 0.5 / sqrt(3) each: three of the difference are 1.2
  EXPECT_TRUE(same_energies(outcome(1, 0.5), outcome(2.1, 0.5), any.target));
  EXPECT_FALSE(same_energies(outcome(1, 0.5), outcome(2.4, 0.5), any.target));
}

// A model that is nowhere near the recording is not brought there by finer steps: they cost, and change nothing.
TEST(TimeStep, FitsFarOffAreSteppedLess) {
  Case slow("boids", 25, 150, {{"speed", 225.0}});
  slow.truth[0] = 900;  // everybody at four times the recorded speed, all over the place
  const int before = slow.objective.ensemble().steps();
  const Outcome outcome = slow.objective.evaluate(slow.truth, replicate_seeds({2}, Stream::selection, 12));
  ASSERT_TRUE(far_off(outcome, slow.target));
  EXPECT_LE(slow.settled(), kFarSteps * before);
  Case right("boids", 25, 150);
  right.settled();
  EXPECT_FALSE(far_off(right.objective.evaluate(right.truth, replicate_seeds({2}, Stream::selection, 12)), right.target));
}

// Steps that are asked for are taken, by all but maps.
TEST(TimeStep, AsManyAsAskedFor) {
  CompareOptions options;
  options.models = {parse_model("brownian"), parse_model("vicsek")};
  options.budget = {"tiny", {6, 3, 1}, {4, 1, 1}, 2, 2, 1};
  options.bootstrap_recordings = 0;
  options.conditions.steps = 3;
  for (const ModelFit& fit : compare(test::planted_swarm(1), options).models)
    EXPECT_EQ(fit.runs.steps, fit.model == "vicsek" ? 1 : 3) << fit.model;
}

}  // namespace
}  // namespace swarmfit
