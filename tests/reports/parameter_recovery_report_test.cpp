// SPDX-License-Identifier: MIT
#include "reports/study/parameter_recovery_report.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "libtrack/file.h"

namespace swarmfit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

ParameterRecovery sample() {
  ParameterRecovery r{"brownian", {}, {}, 3, 181, 197};
  r.parameters = {{"D", "mm^2/s^3", AxisScale::logarithmic, 2, 1, 2, 0, 0, 0.01, 0.02, 0.05},
                  {"k", "1/s^2", AxisScale::root, 2, 2, 0, 1, 1, -0.1, 0.2, 0.7}};
  ParameterInterval d{0, "D", 5, 4, 6, 0.99, Identifiability::identified, "k", 0.3},
      k{1, "k", 1, 0, 3, 0.1, Identifiability::flat, "D", 0.3};
  r.cases = {{7, {4.5, 2}, {d, k}, {0.4, 0.6}, {0.5, 0.5}, {0.05, 0.8}, {0.25, 0.5}, 0.75}};
  return r;
}

TEST(ParameterRecoveryReport, CoverageByHand) {
  const PaperTable t = coverage_table(sample(), "");
  EXPECT_THAT(t.rows[0], ElementsAre("D", "1 of 2", "2", "0", "0", "0.05", "0.010", "0.020"));
  EXPECT_THAT(t.rows[1], ElementsAre("k", "2 of 2", "0", "1", "1", "0.70", "-0.100", "0.200"));
  const std::string text = parameter_recovery_text(sample(), {});
  EXPECT_THAT(text, HasSubstr("contain 181 to 197 of 1 true values (99 % of the\n binomial, 2 parameters)"));
  EXPECT_THAT(text, HasSubstr("3 more recordings were left out"));
  EXPECT_THAT(parameter_recovery_text({"brownian", {}, {}, 30, 0, 0}, {}), HasSubstr("None of 30 recordings"));
}

TEST(ParameterRecoveryReport, CsvAndJson) {
  EXPECT_EQ(parameter_cases_csv(sample()),
            "seed,parameter,truth,median,ci_lower,ci_upper,contraction,verdict,rank\n7,D,4.5,5,4,6,0.99,identified,0.25\n7,k,2,1,0,3,0.1,"
            "flat,0.5\n");
  const auto json = nlohmann::json::parse(to_json(sample(), {{"agents", "10"}}));
  EXPECT_EQ(json["schema"], "swarmfit-parameter-recovery/1");
  EXPECT_EQ(json["parameters"][0]["covered"], 1);
  EXPECT_EQ(json["band"], nlohmann::json::array({181, 197}));
}

TEST(ParameterRecoveryReport, WritesARun) {
  const auto dir = std::filesystem::path(testing::TempDir()) / "parameter_recovery_report";
  std::filesystem::remove_all(dir);
  write_parameter_recovery(dir.string(), sample(), {{"parameters", "true"}}, "1.2.3");
  EXPECT_THAT(read_file((dir / "config.toml").string()), HasSubstr("[recover]\nparameters = true\n"));
  for (const char* file : {"tables/coverage.md", "tables/coverage.tex", "tables/cases.csv", "recovery.json"})
    EXPECT_TRUE(std::filesystem::exists(dir / file)) << file;
  std::filesystem::remove_all(dir);
}

}  // namespace
}  // namespace swarmfit
