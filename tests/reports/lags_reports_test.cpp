// SPDX-License-Identifier: MIT
// Comparisons at several lags, as people and programs read them.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "reports/comparison/html.h"
#include "reports/comparison/json.h"
#include "reports/comparison/paper_tables.h"
#include "reports/comparison/ranking_text.h"
#include "reports/comparison/tables.h"
#include "reports/comparison/words.h"
#include "reports/write/text_table.h"
#include "tests/reports/sample.h"

namespace swarmfit {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using Json = nlohmann::ordered_json;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

std::vector<std::string> table(const Comparison& c, const std::string& name) {
  for (const NamedTable& t : result_tables(c))
    if (t.name == name) return lines_of(t.csv);
  return {};
}

TEST(LagWords, SayWhichLagCarriedTheDecision) {
  EXPECT_EQ(lag_weights(sample_at_lags()),
            "Lag 16 (0.16 s) carried 70 % of the weight, lag 1 (0.01 s) 12 %, lag 4 (0.04 s) 10 % and metrics without lag (d, η) 8 %. ");
  EXPECT_THAT(lag_weights(sample_comparison()), IsEmpty()) << "one lag has nobody to share with";
  EXPECT_EQ(lags_measured(sample_at_lags()),
            "Motion is measured at lag 1 (0.01 s), lag 4 (0.04 s) and lag 16 (0.16 s). Measurement error makes up at most 78 % of a "
            "metric's variance at lag 1, 10 % at lag 4 and 2 % at lag 16.");
  EXPECT_THAT(lags_measured(sample_comparison()), HasSubstr("Motion is measured at lag 1 (0.01 s)."));
  Comparison unknown = sample_at_lags();
  unknown.recording.observation.sigma.setZero();
  EXPECT_THAT(lags_measured(unknown), Not(HasSubstr("Localisation error")));
  Comparison unweighted = sample_at_lags();
  for (LagFacts& l : unweighted.ranking.lags) l.weight = NAN;
  EXPECT_THAT(lag_weights(unweighted), IsEmpty());
  EXPECT_THAT(lag_weights(Comparison{}), IsEmpty());
  EXPECT_THAT(lags_measured(Comparison{}), IsEmpty());
}

TEST(LagTables, HaveARowPerColumn) {
  const Comparison c = sample_at_lags();
  EXPECT_THAT(table(c, "energies.csv"), SizeIs(1 + 5 * 17));
  EXPECT_THAT(table(c, "energies.csv")[8], HasSubstr("bswarm,v@4,"));
  EXPECT_EQ(table(c, "raw_energies.csv")[0], "model,v,a,omega,d,eta,v@4,a@4,omega@4,alpha@4,mu@4,v@16,a@16,omega@16,alpha@16,mu@16");
  EXPECT_THAT(table(c, "skill.csv"), SizeIs(1 + 5 * 18));
  EXPECT_THAT(lines_of(history_csv(c))[0], HasSubstr(",eta,v@4,"));
  EXPECT_THAT(table(c, "lags.csv"), ElementsAre("lag,seconds,columns_scored,weight,largest_error_share", "1,0.01,3,0.118,0.78",
                                                "4,0.04,5,0.1,0.1", "16,0.16,5,0.7,0.02", "none,,2,0.082,0.11"));
}

TEST(LagTables, ThePaperSaysItInTheCaption) {
  for (const PaperTable& t : paper_tables(sample_at_lags())) {
    if (t.name != "weights") continue;
    EXPECT_THAT(t.caption, AllOf(HasSubstr("Lag 16 (0.16 s) carried 70 % of the weight"), HasSubstr("Motion at lag 1 (0.01 s).")));
    EXPECT_EQ(t.head.size(), 8u);
  }
}

// All columns side by side would not fit a page.
TEST(LagTables, ThePaperHasATablePerLag) {
  std::vector<std::string> names;
  for (const PaperTable& t : paper_tables(sample_at_lags())) {
    names.push_back(t.name);
    EXPECT_LE(t.head.size(), 9u) << t.name;
    if (t.name == "energies_lag16") {
      EXPECT_THAT(t.head, ElementsAre("model", "v@16", "a@16", "ω@16", "α@16", "μ@16"));
    }
  }
  EXPECT_THAT(names, ElementsAre("ranking", "scales", "parameters", "energies", "weights", "sensitivity", "energies_lag4", "weights_lag4",
                                 "sensitivity_lag4", "energies_lag16", "weights_lag16", "sensitivity_lag16"));
}

TEST(LagJson, HasEveryColumnAndEveryLag) {
  const Json j = Json::parse(to_json(sample_at_lags()));
  for (const char* key : {"weights", "p1", "floor"}) EXPECT_EQ(j[key].size(), 17u) << key;
  EXPECT_EQ(j["models"][0]["raw_energies"].size(), 17u);
  EXPECT_TRUE(j["observation"]["used"]["mu@16"].is_boolean());
  ASSERT_EQ(j["lags"].size(), 4u);
  EXPECT_EQ(j["lags"][2], Json::parse(R"({"lag":16,"seconds":0.16,"scored":5,"weight":0.7,"error_share":0.02})"));
  EXPECT_TRUE(j["lags"][3]["lag"].is_null());
}

TEST(LagTerminal, ATablePerLagFitsALine) {
  for (const bool unicode : {true, false}) {
    const std::string text = ranking_text(sample_at_lags(), {.colour = false, .unicode = unicode}, Detail::all);
    for (const auto& line : lines_of(text)) EXPECT_LE(display_width(line), 80u) << line;
    EXPECT_THAT(text, AllOf(HasSubstr("energy, lag 4 (0.04 s)"), HasSubstr("energy, lag 16 (0.16 s)"), HasSubstr("Lag 16 (0.16 s)"),
                            HasSubstr(unicode ? "ω@16" : "omega@16")));
  }
  EXPECT_THAT(ranking_text(sample_comparison(), {}, Detail::all), Not(HasSubstr("energy, lag")));
}

TEST(LagHtml, DrawsEveryColumnAndSharesOutTheWeight) {
  const std::string page = report_html(sample_at_lags());
  std::size_t canvases = 0;
  for (std::size_t at = page.find("<canvas id=\"pdf-"); at != std::string::npos; at = page.find("<canvas id=\"pdf-", at + 1)) ++canvases;
  EXPECT_EQ(canvases, 17u);
  EXPECT_THAT(page, AllOf(HasSubstr("pdf-omega@16"), HasSubstr("Weight of every lag"), HasSubstr("Lag 16 (0.16 s) carried 70\u00a0%")));
  EXPECT_THAT(report_html(sample_comparison()), Not(HasSubstr("Weight of every lag")));
}

}  // namespace
}  // namespace swarmfit
