// SPDX-License-Identifier: MIT
// Parameters by likelihood and by regression stand wherever the fitted ones do.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "reports/comparison/html.h"
#include "reports/comparison/json.h"
#include "reports/comparison/ranking_text.h"
#include "reports/comparison/second_opinions.h"
#include "reports/comparison/tables.h"
#include "reports/write/number.h"
#include "tests/reports/sample.h"

namespace swarmfit {
namespace {

using testing::HasSubstr;
using testing::Not;

Comparison with_opinions() {
  Comparison c = sample_comparison();
  ModelFit& first = c.models.front();
  first.likelihood = {-120.5, 0.2};
  first.regression = {4960, 0.023};
  first.parameters.front().likelihood = {2.5, 2.25, 2.75};
  first.parameters.front().regression = {3.5, kNaN, kNaN};
  return c;
}

TEST(SecondOpinion, IsAValueWithItsIntervalIfThereIsOne) {
  EXPECT_EQ(opinion_text({2.5, 2.25, 2.75}), "2.50 (2.25 .. 2.75)");
  EXPECT_EQ(opinion_text({3.5, kNaN, kNaN}), "3.50 (no interval)");
  EXPECT_EQ(opinion_text({}), kUndefined);
}

TEST(SecondOpinion, StandsInTheTerminalWhereItWasAskedFor) {
  const std::string text = ranking_text(with_opinions(), {}, Detail::all);
  EXPECT_THAT(text, HasSubstr("Maximum likelihood, 95 % intervals in brackets"));
  EXPECT_THAT(text, HasSubstr("2.50 (2.25 .. 2.75)"));
  EXPECT_THAT(text, HasSubstr("Regression of accelerations, 95 % intervals in brackets"));
  EXPECT_THAT(text, HasSubstr("3.50 (no interval)"));
  EXPECT_THAT(text, HasSubstr("4960 accelerations"));
  EXPECT_THAT(ranking_text(sample_comparison(), {}, Detail::all), Not(HasSubstr("Regression of accelerations")));
}

TEST(SecondOpinion, StandsInResults) {
  const auto model = nlohmann::json::parse(to_json(with_opinions())).at("models").at(0);
  const auto& parameter = model.at("parameters").at(with_opinions().models.front().parameters.front().name);
  EXPECT_EQ(parameter.at("likelihood").dump(), "[2.5,2.25,2.75]");
  EXPECT_EQ(parameter.at("regression").dump(), "[3.5,null,null]");
  EXPECT_EQ(model.at("regression").at("accelerations"), 4960);
  EXPECT_EQ(model.at("regression").at("memory"), 0.023);
  EXPECT_FALSE(nlohmann::json::parse(to_json(sample_comparison())).at("models").at(0).contains("regression"));
}

TEST(SecondOpinion, StandsInTheTableAndOnThePage) {
  const Comparison c = with_opinions();
  int found = 0;
  for (const NamedTable& table : result_tables(c))
    if (table.name == "parameters.csv") {
      ++found;
      EXPECT_THAT(table.csv, HasSubstr(",2.5,2.25,2.75,3.5,,,"));
    }
  EXPECT_EQ(found, 1);
  const auto on_page = [](const Comparison& shown) { return report_html(shown).find("regression, 95") != std::string::npos; };
  EXPECT_TRUE(on_page(c));
  EXPECT_FALSE(on_page(sample_comparison()));
}

}  // namespace
}  // namespace swarmfit
