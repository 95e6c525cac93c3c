// SPDX-License-Identifier: MIT
#include "fit/study/recovery.h"

#include <gtest/gtest.h>

#include <cmath>

#include "libtrack/error.h"

namespace swarmfit {
namespace {

RecoveryOptions tiny() {
  RecoveryOptions o;
  o.compare.models = {parse_model("bswarm"), parse_model("boids")};
  o.compare.budget = {"tiny", {8, 4, 1}, {4, 2, 2}, 2, 2, 2};
  o.compare.bootstrap_recordings = 9;
  o.compare.conditions.error = ConditionOptions::Error::none;
  o.planted = o.compare.models;
  o.film.agents = 8;
  o.film.frames = 60;
  o.film.dt = 0.01;
  o.film.unit = "mm";
  o.scales = {100, 70, 225};
  o.seeds = 2;
  return o;
}

TEST(Recovery, PlantsTheFitTablesDefaultsInTheGivenScales) {
  const auto model = parse_model("boids");
  const Scales scales{100, 70, 225};
  const auto values = planted_parameters(model, scales, {{"radius", 42}});
  EXPECT_NEAR(values[static_cast<std::size_t>(model.spec->find("speed"))], 225, 1e-9);
  EXPECT_EQ(values[static_cast<std::size_t>(model.spec->find("radius"))], 42);
  EXPECT_NEAR(values[static_cast<std::size_t>(model.spec->find("tau"))], 0.5 * 100 / 225, 1e-12);
  EXPECT_THROW(planted_parameters(model, scales, {{"gama", 1}}), InputError);
}

TEST(Recovery, PlantedParametersLieAboutTheDefaultsAndWithinTheBounds) {
  const auto model = parse_model("bswarm");
  const Scales scales{100, 70, 225};
  const auto middle = planted_parameters(model, scales, {{"gamma", 0.02}});
  EXPECT_EQ(varied(model, middle, scales, 1, 5), middle);
  double lowest = 1e9, highest = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const auto values = varied(model, middle, scales, 2, seed, {{"gamma", 0.02}});
    for (std::size_t p = 0; p < values.size(); ++p) {
      const Parameter& row = model.spec->parameters[p];
      if (!row.fitted || row.name == "gamma" || !model.spec->uses(p, model.options)) {
        EXPECT_EQ(values[p], middle[p]) << row.name;
        continue;
      }
      EXPECT_GE(values[p], middle[p] / 2);
      EXPECT_LE(values[p], middle[p] * 2);
      lowest = std::min(lowest, values[p] / middle[p]);
      highest = std::max(highest, values[p] / middle[p]);
    }
  }
  EXPECT_LT(lowest, 0.55);
  EXPECT_GT(highest, 1.8);
  const auto wild = varied(model, middle, scales, 100, 1);
  for (std::size_t p = 0; p < wild.size(); ++p) {
    const Parameter& row = model.spec->parameters[p];
    if (row.fitted && model.spec->uses(p, model.options)) {
      EXPECT_LE(wild[p], row.fit.upper * row.scale(scales) * (1 + 1e-12));
    }
  }
}

TEST(Recovery, RecordingsHaveTheScalesTheyWereAskedFor) {
  const auto model = parse_model("boids");
  RecoveryOptions o = tiny();
  o.film.agents = 400;
  o.film.frames = 2;
  const Scales scales{100, 10, 50};
  const Tracks t = planted_recording(model, planted_parameters(model, scales, {{"radius", 1e-3}}), o.film, scales, 3);
  const Scales seen = natural_scales(t);
  EXPECT_NEAR(seen.speed, 50, 1e-6) << "without neighbours everybody flies straight on";
  // Straight flight for two crossing times L / V in all directions: the rms radius grows from L to sqrt(1 + 2²) L.
  EXPECT_NEAR(seen.extent, 100 * std::sqrt(5.0), 15);
}

TEST(Recovery, EveryCaseIsCountedOnceAndTheSameSeedGivesTheSameAnswer) {
  const RecoveryOptions o = tiny();
  int told = 0;
  const Recovery a = recover_models(o, [&](const RecoveryCase&) { return ++told, true; }), b = recover_models(o);
  ASSERT_EQ(a.cases.size(), 4u);
  EXPECT_EQ(told, 4);
  for (std::size_t p = 0; p < 2; ++p) EXPECT_EQ(a.confusion[p][0] + a.confusion[p][1], 2);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(a.cases[k].scores, b.cases[k].scores);
    const bool won = a.cases[k].order.front() == a.planted[a.cases[k].planted];
    EXPECT_EQ(won, a.cases[k].rank_of_planted == 1);
  }
}

TEST(Recovery, WhatIsNotFittedIsTheSameForAll) {
  RecoveryOptions o = tiny();
  o.compare.requests.set["bswarm.time_horizon"] = 0.123;
  const auto set = with_shared_constants(o.compare, o.scales).requests.set;
  EXPECT_NEAR(set.at("bswarm.max_speed"), 50 * 225, 1e-9);
  EXPECT_EQ(set.at("bswarm.time_horizon"), 0.123) << "the user's own value wins";
  EXPECT_FALSE(set.contains("boids.tau")) << "fitted";
}

TEST(Recovery, PlantedModelsMustBeCompared) {
  RecoveryOptions o = tiny();
  o.planted = {parse_model("bswarm[noise=white]")};
  EXPECT_THROW(recover_models(o), InputError);
}

TEST(Recovery, SeedsCountUpFromTheOneAskedFor) {
  RecoveryOptions o = tiny();
  o.compare.seed = 7;
  o.planted = {parse_model("boids")};
  std::vector<std::uint64_t> seeds;
  for (const RecoveryCase& c : recover_models(o).cases) seeds.push_back(c.seed);
  EXPECT_EQ(seeds, (std::vector<std::uint64_t>{7, 8}));
}

TEST(Recovery, CanBeInterrupted) {
  const swarmfit::Threads stopped([] { return true; });
  EXPECT_THROW(recover_models(tiny(), {}, {{}, {&stopped}}), Interrupted);
}

}  // namespace
}  // namespace swarmfit
