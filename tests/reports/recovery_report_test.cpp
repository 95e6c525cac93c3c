// SPDX-License-Identifier: MIT
#include "reports/study/recovery_report.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "fit/study/recovery.h"
#include "libtrack/file.h"

namespace swarmfit {
namespace {

using testing::HasSubstr;

Recovery sample() {
  Recovery r;
  r.planted = r.compared = {"bswarm", "boids"};
  for (const auto& name : r.planted) {
    r.rows.push_back(planted_rows(parse_model(name), "mm"));
    r.parameters.emplace_back(r.rows.back().size(), 1.0);
  }
  const auto& p = r.parameters;
  r.cases = {{0, 1, p[0], {"bswarm", "boids"}, {0.9, 0.1}, {0.01, NAN}, {1, 2}, {0.3, 0.01}, 1},
             {1, 1, p[1], {"bswarm", "boids"}, {0.6, 0.4}, {0.01, 0.02}, {1, 1}, {0.5, 0.04}, 2}};
  r.confusion = {{1, 0}, {1, 0}};
  return r;
}

TEST(RecoveryReport, TextByHand) {
  EXPECT_EQ(recovery_text(sample(), {}),
            " true model \\ ranked first  bswarm  boids  recovered\n"
            " bswarm                          1      ·     1 of 1\n"
            " boids                           1      ·     0 of 1\n"
            "\n"
            " true model \\ in the best group  bswarm  boids  rejected\n"
            " bswarm                               1      ·    0 of 1\n"
            " boids                                1      1    1 of 1\n");
}

TEST(RecoveryReport, CsvHasOneRowPerCaseAndModel) {
  EXPECT_EQ(recovery_csv(sample()),
            "true_model,seed,rank,model,score,score_se,group,gof_p\nbswarm,1,1,bswarm,0.9,0.01,1,0.3\nbswarm,1,2,boids,0.1,,2,0.01\n"
            "boids,1,1,bswarm,0.6,0.01,1,0.5\nboids,1,2,boids,0.4,0.02,1,0.04\n");
}

TEST(RecoveryReport, JsonHoldsConditionsParametersAndCases) {
  const auto json = nlohmann::json::parse(to_json(sample(), {{"agents", "10"}}));
  EXPECT_EQ(json["conditions"]["agents"], "10");
  EXPECT_EQ(json["true_models"][1]["recovered"], 0);
  EXPECT_EQ(json["true_models"][1]["parameters"]["speed"], 1.0);
  ASSERT_EQ(json["cases"].size(), 2u);
  EXPECT_EQ(json["cases"][1]["parameters"]["speed"], 1.0);
}

TEST(RecoveryReport, WritesARunThatNamesItsConditions) {
  const auto dir = std::filesystem::path(testing::TempDir()) / "recovery_report";
  std::filesystem::remove_all(dir);
  write_recovery(dir.string(), sample(), {{"agents", "10"}}, "1.2.3");
  EXPECT_THAT(read_file((dir / "config.toml").string()), HasSubstr("[recover]\nagents = 10\n"));
  EXPECT_THAT(read_file((dir / "tables/confusion.md").string()), HasSubstr("agents 10"));
  EXPECT_TRUE(std::filesystem::exists(dir / "tables/confusion.tex"));
  EXPECT_TRUE(std::filesystem::exists(dir / "recovery.json"));
  std::filesystem::remove_all(dir);
}

}  // namespace
}  // namespace swarmfit
