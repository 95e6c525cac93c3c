// SPDX-License-Identifier: MIT
#include "fit/compare/compare.h"

#include <gmock/gmock.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "fit/compare/facts.h"
#include "fit/optimise/screening.h"
#include "fit/study/recovery.h"
#include "libeval/score.h"
#include "libeval/skill.h"
#include "libtrack/error.h"
#include "tests/fit/planted.h"

namespace swarmfit {
namespace {

using ::testing::HasSubstr;

CompareOptions tiny(const std::vector<std::string>& names, std::uint64_t seed = 1) {
  CompareOptions o;
  for (const auto& name : names) o.models.push_back(parse_model(name));
  o.binning = Binning::standard(Normalisation::reference);
  o.budget = {"tiny", {8, 6, 2}, {4, 3, 3}, 4, 3, 3};
  o.seed = seed;
  o.bootstrap_recordings = 9;
  return o;
}

struct Threads {
  explicit Threads(int n) : before(omp_get_max_threads()) { omp_set_num_threads(n); }
  ~Threads() { omp_set_num_threads(before); }
  int before;
};

TEST(Compare, SameBitsForAnyNumberOfThreads) {
  const Tracks recording = test::planted_swarm(4, 0.5, 0.01);
  const auto options = tiny({"bswarm", "boids"});
  Comparison one, many;
  {
    const Threads threads(1);
    one = compare(recording, options);
  }
  {
    const Threads threads(4);
    many = compare(recording, options);
  }
  ASSERT_EQ(one.run.history.size(), many.run.history.size());
  for (std::size_t k = 0; k < one.run.history.size(); ++k) {
    EXPECT_EQ(one.run.history[k].x, many.run.history[k].x) << k;
    EXPECT_EQ(one.run.history[k].phase, many.run.history[k].phase) << k;
    for (std::size_t m = 0; m < kMetrics; ++m) EXPECT_EQ(one.run.history[k].raw[m], many.run.history[k].raw[m]) << k;
  }
  ASSERT_EQ(one.models.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(one.models[k].standing.score, many.models[k].standing.score);
}

TEST(Compare, PlantedModelWins) {
  const Comparison result = compare(test::planted_swarm(4), tiny({"boids", "bswarm"}));
  EXPECT_EQ(result.models.front().model, "bswarm");
  EXPECT_EQ(result.models.front().standing.rank, 1);
  EXPECT_EQ(result.run.named, (std::vector<std::string>{"boids", "bswarm"}));
}

TEST(Compare, HistoryHoldsEveryEvaluationOnce) {
  const auto options = tiny({"bswarm", "boids"});
  const Comparison result = compare(test::planted_swarm(4), options);
  const auto& budget = options.budget;
  const std::map<std::string, int> replicates = {
      {"search", budget.search.replicates},        {"steps", budget.search.replicates},  // or those of the selection
      {"select", budget.selection.replicates},     {"refine", budget.selection.replicates},
      {"confirm", budget.confirmation_replicates}, {"final", budget.final_replicates}};
  int given_up = 0;
  for (std::size_t m = 0; m < 2; ++m) {
    std::int64_t searched = 0, simulations = 0;
    for (const auto& row : result.run.history) {
      if (row.model != m) continue;
      searched += row.phase == "search" || row.phase == "refine";
      simulations += row.replicates;
      const auto all = replicates.at(row.phase);
      const bool race = row.phase == std::string("search") || row.phase == std::string("refine");
      EXPECT_TRUE(row.replicates == all || (row.phase == "steps" && row.replicates == budget.selection.replicates) ||
                  (race && row.replicates == static_cast<int>(screening_replicates(static_cast<std::size_t>(all)))));
      given_up += row.replicates < all;
    }
    for (const auto& fit : result.models) {
      if (fit.model != result.run.named[m]) continue;
      EXPECT_EQ(fit.search.evaluations, searched);
      EXPECT_EQ(fit.search.simulations, simulations);
    }
  }
  EXPECT_GT(given_up, 0);
}

TEST(Compare, WinnerIsTheBestOfTheConfirmed) {
  const auto options = tiny({"bswarm"});
  const Comparison result = compare(test::planted_swarm(4), options);
  const std::vector<bool> used(result.recording.observation.used.begin(), result.recording.observation.used.end());
  const HistoryRow* best = nullptr;
  const HistoryRow* reported = nullptr;
  double least = 1e9;
  for (const auto& row : result.run.history) {
    double sum = 0;
    for (std::size_t j = 0; j < kMetrics; ++j) sum += used[j] ? row.raw[j] : 0;
    if (row.phase == "confirm" && sum < least) least = sum, best = &row;
    if (row.phase == "final") reported = &row;
  }
  ASSERT_NE(best, nullptr);
  ASSERT_NE(reported, nullptr);
  EXPECT_EQ(reported->x, best->x);
  EXPECT_NE(reported->raw, best->raw) << "reported on the seeds it was chosen by";
}

// Settings of one model learn from each other: whatever a part of the model has found, the whole can do.
TEST(Compare, LaterPassesTryWhatOtherSettingsHaveFound) {
  auto options = tiny({"bswarm", "bswarm[interaction=off]"});
  options.budget.passes = 2;
  options.weight_tolerance = 0;
  const Comparison result = compare(test::planted_swarm(4), options);
  ASSERT_EQ(result.run.searched[0],
            (std::vector<std::string>{"gamma", "noise", "scale", "chi_rep", "chi_att", "r_rep", "r_att", "radius"}));
  ASSERT_EQ(result.run.searched[1], (std::vector<std::string>{"gamma", "noise", "scale", "radius"}));
  std::vector<double> part;
  int whole_as_part = 0, part_as_whole = 0;
  std::vector<double> whole;
  for (const HistoryRow& row : result.run.history)
    if (row.pass == 1 && row.phase == "final") (row.model == 0 ? whole : part) = row.x;
  ASSERT_EQ(part.size(), 4U);
  const auto near = [](const std::vector<double>& a, const std::vector<double>& b) {
    for (std::size_t k = 0; k < a.size(); ++k)
      if (std::abs(a[k] - b[k]) > 1e-9 * (1 + std::abs(b[k]))) return false;
    return true;
  };
  for (const HistoryRow& row : result.run.history) {
    if (row.pass != 2 || row.phase != "select") continue;
    whole_as_part += row.model == 0 && near(row.x, {part[0], part[1], part[2], 0, 0, 0, 0, part[3]});
    part_as_whole += row.model == 1 && near(row.x, {whole[0], whole[1], whole[2], whole[7]});
  }
  EXPECT_EQ(whole_as_part, 1);
  EXPECT_EQ(part_as_whole, 1);
}

TEST(Compare, APartThatBeatsItsWholeIsWarnedOf) {
  Comparison result =
      compare(test::planted_swarm(4), tiny({"bswarm", "bswarm[interaction=off]", "bswarm[noise=white]", "bswarm[avoidance=none]"}));
  const auto score = [&](const char* model, double value) {
    for (auto& fit : result.models)
      if (fit.model == model) fit.standing.in_sample.score = value, fit.standing.in_sample.score_se = 0.01;
  };
  const auto warned = ::testing::Contains(HasSubstr("as a special case"));
  score("bswarm[noise=white]", 1);     // not a part of bswarm: it has a parameter of its own
  score("bswarm[avoidance=none]", 1);  // not a part either: no radius of bswarm is as good as none
  score("bswarm", 0.5);
  score("bswarm[interaction=off]", 0.52);  // within two standard errors
  EXPECT_THAT(warnings_for(result), ::testing::Not(warned));
  score("bswarm[interaction=off]", 0.6);
  EXPECT_THAT(warnings_for(result), ::testing::Contains(HasSubstr("bswarm contains bswarm[interaction=off] as a special case")));
}

TEST(Compare, HardLimitOfEvaluationsIsKept) {
  auto options = tiny({"bswarm", "boids"});
  options.max_evaluations = 13;
  for (const auto& fit : compare(test::planted_swarm(4), options).models) EXPECT_LE(fit.search.evaluations, 13);
}

TEST(Compare, WeightsAreThoseOfTheEnergiesShown) {
  const Comparison result = compare(test::planted_swarm(4), tiny({"bswarm", "boids", "bswarm[noise=none]"}));
  Eigen::MatrixXd table(3, static_cast<Index>(kMetrics));
  for (Index m = 0; m < 3; ++m)
    for (std::size_t j = 0; j < kMetrics; ++j)
      table(m, static_cast<Index>(j)) = result.models[static_cast<std::size_t>(m)].runs.raw_energies[j];
  const std::vector<bool> used(result.recording.observation.used.begin(), result.recording.observation.used.end());
  const Weighting expected = entropy_weights(table, used, {result.recording.resolution.begin(), result.recording.resolution.end()});
  for (std::size_t j = 0; j < kMetrics; ++j) EXPECT_NEAR(result.ranking.weights[j], expected.weights[j], 1e-12);
}

TEST(Compare, LaterPassesSearchUnderTheMeanOfAllWeightsOrUnderTheLast) {
  auto options = tiny({"bswarm", "boids", "noise_aware"});
  options.budget.passes = 3;
  options.weight_tolerance = 0;
  for (const bool mean : {true, false}) {
    options.mean_weights = mean;
    const Comparison result = compare(test::planted_swarm(4), options);
    ASSERT_EQ(result.ranking.weight_history.size(), 3u);
    const WeightStep &first = result.ranking.weight_history[0], &second = result.ranking.weight_history[1],
                     &third = result.ranking.weight_history[2];
    const double used =
        static_cast<double>(std::count(result.recording.observation.used.begin(), result.recording.observation.used.end(), true));
    for (std::size_t j = 0; j < kMetrics; ++j) {
      const double equal = result.recording.observation.used[j] ? 1 / used : 0;
      EXPECT_NEAR(first.searched[j], equal, 1e-15);
      EXPECT_NEAR(second.searched[j], mean ? (equal + first.weights[j]) / 2 : first.weights[j], 1e-15);
      EXPECT_NEAR(third.searched[j], mean ? (equal + first.weights[j] + second.weights[j]) / 3 : second.weights[j], 1e-15);
      EXPECT_EQ(third.weights[j], result.ranking.weights[j]) << "the ranking's weights are those of its energies";
    }
  }
}

TEST(Compare, ResolutionIsHalfTheEnergyBetweenHalvesAndCanBeLeftOut) {
  const Tracks recording = test::planted_swarm(4);
  auto options = tiny({"bswarm", "boids"});
  const Comparison result = compare(recording, options);
  const HalfDistance halves(recording);
  for (std::size_t j = 0; j < kMetrics; ++j) {
    EXPECT_NEAR(result.recording.resolution[j], 0.5 * 20 * halves.floor()[j], 1e-12);
    if (result.ranking.p2[j] > 0) {
      EXPECT_GE(result.ranking.p2[j], result.recording.resolution[j]);
    }
  }
  options.resolution = false;
  const Comparison literal = compare(recording, options);
  for (std::size_t j = 0; j < kMetrics; ++j) {
    EXPECT_EQ(literal.recording.resolution[j], 0);
    const double a = literal.models[0].runs.raw_energies[j], b = literal.models[1].runs.raw_energies[j];
    EXPECT_NEAR(literal.ranking.p2[j], std::abs(a - b), 1e-12);
  }
}

// A constant speed has the worst energy unless it is met within a part in a hundred.
TEST(Compare, ASpeedThatHardlyVariesIsFound) {
  const auto model = parse_model("rvo");
  const Scales scales{100, 70, 225};
  PlantOptions film;
  film.agents = 10;
  film.frames = 150;
  film.dt = 0.01;
  film.unit = "mm";
  const Tracks recording = planted_recording(model, planted_parameters(model, scales, {{"max_speed", 137}}), film, scales, 1);
  auto options = tiny({"rvo"});
  options.budget = {"small", {16, 12, 1}, {6, 4, 2}, 2, 2, 1};
  options.bootstrap_recordings = 9;
  options.conditions.steps = 10;             // as filmed
  options.requests.set["max_speed"] = 1500;  // where the search starts: the default would be the recorded speed, which is the answer
  options.requests.bounds["max_speed"] = {20, 2000};
  for (const char* other : {"time_horizon", "goal_radius", "goal_time"}) options.requests.fix[other] = true;  // this is about the speed
  const ModelFit fit = compare(recording, options).models.front();
  for (const ParameterResult& p : fit.parameters)
    if (p.name == "max_speed") {
      EXPECT_NEAR(p.value, 137, 1.5);
    }
}

TEST(Compare, OneModelIsFittedWithEqualWeights) {
  const Comparison result = compare(test::planted_swarm(4), tiny({"bswarm"}));
  EXPECT_EQ(result.run.command, "fit");
  EXPECT_TRUE(result.ranking.weight_history.empty());
  double sum = 0;
  for (std::size_t j = 0; j < kMetrics; ++j) {
    sum += result.ranking.weights[j];
    EXPECT_TRUE(result.ranking.weights[j] == 0 ||
                result.ranking.weights[j] == *std::max_element(result.ranking.weights.begin(), result.ranking.weights.end()));
  }
  EXPECT_NEAR(sum, 1, 1e-12);
}

TEST(Compare, EverythingFixedStillRanks) {
  auto options = tiny({"boids"});
  for (const auto& p : options.models[0].spec->parameters) options.requests.fix[std::string(p.name)] = true;
  const Comparison result = compare(test::planted_swarm(4), options);
  EXPECT_EQ(result.models[0].search.evaluations, 1);
  EXPECT_EQ(result.models[0].search.stop_reason, "nothing to search");
}

TEST(Compare, InterruptionLeavesNoResult) {
  const swarmfit::Threads stopped([] { return true; });
  EXPECT_THROW(compare(test::planted_swarm(4), tiny({"bswarm"}), {}, {&stopped}), Interrupted);
}

TEST(Compare, SyntheticDataAndTwoModelsAreWarnedOf) {
  const Comparison result = compare(test::planted_swarm(4), tiny({"bswarm", "boids"}));
  EXPECT_THAT(result.warnings, ::testing::Contains(HasSubstr("synthetic")));
  EXPECT_THAT(result.warnings, ::testing::Contains(HasSubstr("two models")));
}

TEST(Budget, UnknownNameIsRefusedWithTheKnownOnes) {
  try {
    budget_named("huge");
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("quick, default, thorough"));
  }
}

TEST(Compare, PosteriorIsBesideTheBestParameters) {
  auto options = tiny({"brownian[interaction=none]"});
  const Comparison plain = compare(test::planted_swarm(3), options);
  options.posterior = true;
  const ModelFit fit = compare(test::planted_swarm(3), options).models.front();
  EXPECT_EQ(fit.runs.raw_energies, plain.models.front().runs.raw_energies) << "asking for it changes nothing else";
  EXPECT_EQ(plain.models.front().posterior.simulations, 0);
  EXPECT_GT(fit.posterior.simulations, 1000);
  EXPECT_EQ(fit.posterior.sample.size(), fit.posterior.weight.size());
  for (const ParameterResult& p : fit.parameters) {
    EXPECT_EQ(p.posterior.verdict.empty(), !p.fitted) << p.name;
    if (!p.fitted) continue;
    EXPECT_LT(p.posterior.lower, p.posterior.median);
    EXPECT_LT(p.posterior.median, p.posterior.upper);
    EXPECT_GE(p.posterior.lower, p.lower);
    EXPECT_LE(p.posterior.upper, p.upper);
  }
}

TEST(Warnings, ABestValueOutsideItsIntervalIsWarnedOf) {
  auto options = tiny({"brownian[interaction=none]"});
  options.posterior = true;
  Comparison c = compare(test::planted_swarm(3), options);
  ParameterResult& p = c.models.front().parameters.front();
  const auto warned = [&] {
    const auto all = warnings_for(c);
    return std::any_of(all.begin(), all.end(), [](const auto& w) {
      return w.text.find("gamma1") != std::string::npos && w.text.find(" outside ") != std::string::npos;
    });
  };
  p.value = p.posterior.median;
  EXPECT_FALSE(warned());
  p.value = p.posterior.upper + 1;
  EXPECT_TRUE(warned());
  p.posterior = {};
  EXPECT_FALSE(warned());
}

}  // namespace
}  // namespace swarmfit
