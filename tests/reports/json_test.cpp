// SPDX-License-Identifier: MIT
#include "reports/comparison/json.h"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/reports/sample.h"

namespace swarmfit {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::Not;

std::vector<std::string> keys(const json& object) {
  std::vector<std::string> out;
  for (const auto& item : object.items()) out.push_back(item.key());
  return out;
}

TEST(ResultsJson, HasEveryDocumentedKey) {
  const json j = json::parse(to_json(sample_comparison()));
  EXPECT_EQ(j.at("schema"), "swarmfit-results/1");
  for (const char* key : {"version", "command", "seed", "protocol", "budget", "presence", "arena", "data", "observation", "binning",
                          "recording", "weights", "p1", "p2", "weights_converged", "weight_history", "models", "warnings", "config"})
    EXPECT_TRUE(j.contains(key)) << key;
  for (const char* key : {"path", "sha256", "dims", "dt", "tracks", "frames", "individuals_per_frame"})
    EXPECT_TRUE(j["data"].contains(key)) << key;
  for (const json& model : j["models"]) {
    for (const char* key : {"name",
                            "rank",
                            "score",
                            "score_ci",
                            "group",
                            "set_p",
                            "gof_p",
                            "own_energies",
                            "raw_energies",
                            "energies",
                            "parameters",
                            "evaluations",
                            "stop_reason",
                            "failed_simulations",
                            "mean_ratio",
                            "sd_ratio",
                            "outside_fraction",
                            "n_sub",
                            "infeasible_avoidance",
                            "at_bounds",
                            "n_parameters"})
      EXPECT_TRUE(model.contains(key)) << key;
  }
  for (const char* key : {"weights", "p1", "p2"}) EXPECT_EQ(keys(j[key]).size(), kMetrics);
}

// Keys of statistics that do not exist yet are absent rather than empty: a reader can tell "not computed" from "undefined".
TEST(ResultsJson, LeavesOutWhatDoesNotExist) {
  const json j = json::parse(to_json(sample_comparison()));
  for (const char* key : {"ess"}) EXPECT_FALSE(j.contains(key)) << key;
  for (const char* key : {"held_out"}) EXPECT_FALSE(j["models"][0].contains(key)) << key;
}

TEST(ResultsJson, KeysStandInTheDocumentedOrder) {
  const auto j = nlohmann::ordered_json::parse(to_json(sample_comparison()));
  std::vector<std::string> metrics;
  for (const auto& item : j["weights"].items()) metrics.push_back(item.key());
  EXPECT_THAT(metrics, ElementsAre("v", "a", "omega", "alpha", "mu", "d", "eta"));
  EXPECT_EQ(j.items().begin().key(), "schema");
}

TEST(ResultsJson, ModelsAreSortedByRank) {
  const json j = json::parse(to_json(sample_comparison()));
  ASSERT_EQ(j["models"].size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(j["models"][k]["rank"], k + 1);
}

TEST(ResultsJson, ParametersCarryUnitAndBounds) {
  const json j = json::parse(to_json(sample_comparison()));
  const json& model = j["models"][0];
  EXPECT_EQ(model["parameters"]["chi_att"]["unit"], "mm/s²");
  EXPECT_EQ(model["parameters"]["chi_att"]["upper"], 2310);
  EXPECT_EQ(model["n_parameters"], 3);
  EXPECT_EQ(model["at_bounds"], json::array({"chi_att"}));
}

TEST(ResultsJson, HowSureEveryPlaceIs) {
  const json j = json::parse(to_json(sample_comparison()));
  EXPECT_EQ(j["bootstrap_recordings"], 99);
  EXPECT_EQ(j["models"][0]["score_ci"], json::array({0.912 - 0.03, 0.912 + 0.02}));
  EXPECT_EQ(j["models"][1]["lead_ci"], json::array({0.1, 0.3}));
  EXPECT_EQ(j["models"][0]["group"], 1);
  EXPECT_EQ(j["models"][1]["group"], 2);
  EXPECT_EQ(j["models"][1]["set_p"], 0.5);
  EXPECT_EQ(j["models"][1]["gof_p"], 0.25);
  EXPECT_EQ(j["models"][1]["own_energies"]["a"], 0.1 + 0.05);
}

TEST(ResultsJson, UndefinedNumbersAreNull) {
  Comparison c = sample_comparison();
  c.models[0].standing.certainty = {};
  c.models[1].runs.raw_energies[kJerk] = NAN;
  c.models[2].runs.mean_ratio[kSpeed] = INFINITY;
  c.models[4].standing.rank = 0;
  const std::string text = to_json(c);
  const json j = json::parse(text);
  for (const char* key : {"group", "set_p", "gof_p"}) EXPECT_TRUE(j["models"][0][key].is_null()) << key;
  EXPECT_TRUE(j["models"][0]["score_ci"][0].is_null());
  EXPECT_TRUE(j["models"][1]["raw_energies"]["mu"].is_null());
  EXPECT_TRUE(j["models"][2]["mean_ratio"]["v"].is_null());
  EXPECT_TRUE(j["models"][4]["rank"].is_null());
  EXPECT_THAT(text, Not(testing::ContainsRegex("[^a-z](nan|inf)[^a-z]")));
}

TEST(ResultsJson, DoublesAndSeedsReadBackUnchanged) {
  Comparison c = sample_comparison();
  const std::vector<double> awkward = {0.1, 1.0 / 3, 5e-324, 1.7976931348623157e308, -0.0, 123456789.123456789, 1e23};
  for (const double value : awkward) {
    c.ranking.p1[kSpeed] = value;
    const double back = json::parse(to_json(c))["p1"]["v"];
    EXPECT_EQ(std::signbit(back), std::signbit(value));
    EXPECT_EQ(back, value);
  }
  EXPECT_EQ(json::parse(to_json(c))["seed"].get<std::uint64_t>(), 18446744073709551615ULL);
}

TEST(ResultsJson, EqualValuesGiveEqualBytes) { EXPECT_EQ(to_json(sample_comparison()), to_json(sample_comparison())); }

TEST(ResultsJson, BytesThatAreNotUtf8AreReplaced) {
  Comparison c = sample_comparison();
  c.recording.data.path = "a\xff\"b\x01";
  EXPECT_EQ(json::parse(to_json(c))["data"]["path"], "a\xEF\xBF\xBD\"b\x01");
}

TEST(WeightsJson, HasTheKeysOfTheDesign) {
  WeighedTable t{{"A", "B"}, {"v", "my metric"}, Eigen::MatrixXd(2, 2), {}, {1, NAN}};
  t.energies << 0.5, 1, 2, 3;
  t.weighting = {{0.25, 0.75}, {0.5, 1}, {1.5, 2}, {0, 0}};
  const json j = json::parse(to_json(t));
  EXPECT_EQ(j["weights"]["my metric"], 0.75);
  EXPECT_EQ(j["models"][1]["energies"]["v"], 2);
  EXPECT_EQ(j["models"][0]["score"], 1);
  EXPECT_TRUE(j["models"][1]["score"].is_null());
}

TEST(EvaluationJson, HasTheKeysOfTheDesign) {
  const Comparison c = sample_comparison();
  Evaluation e;
  e.binning = c.recording.binning;
  e.raw_energies = c.models[0].runs.raw_energies;
  e.real_distribution = c.recording.distributions;
  e.simulated_distribution = c.models[0].runs.distributions;
  const json j = json::parse(to_json(e));
  EXPECT_EQ(j["normalisation"], "reference");
  EXPECT_EQ(j["bins"], 150);
  EXPECT_EQ(j["interval"], json::array({-5, 10}));
  EXPECT_DOUBLE_EQ(j["mean_ratio"]["v"], 1.04);
  EXPECT_EQ(j["samples"]["real"]["v"], c.recording.distributions[kSpeed].histogram.samples);
  EXPECT_EQ(j["raw_energies"]["d"], e.raw_energies[kDistance]);
}

TEST(SummaryJson, IsOneObjectWithEveryQuantity) {
  Summary s{};
  s.suspicions = {{"unit", "speeds look like metres", "track 3"}};
  s.speed.median = NAN;
  const json j = json::parse(to_json(TrackMeta{}, s));
  EXPECT_TRUE(j["speed"]["median"].is_null());
  EXPECT_EQ(j["suspicions"][0]["what"], "unit");
  EXPECT_TRUE(j["localisation"].contains("sigma"));
}

TEST(ListJson, NamesTheList) {
  const json j = json::parse(to_json("models", {{"boids", "Flocking", {{"options", "rule=zonal|reynolds"}}}}));
  EXPECT_EQ(j["models"][0]["name"], "boids");
  EXPECT_EQ(j["models"][0]["options"], "rule=zonal|reynolds");
}

}  // namespace
}  // namespace swarmfit
