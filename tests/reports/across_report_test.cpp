// SPDX-License-Identifier: MIT
#include "reports/comparison/across_report.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "libtrack/file.h"

namespace swarmfit {
namespace {

using testing::HasSubstr;
using testing::Not;

Across sample() {
  Across a;
  a.recordings = {"one.csv", "dir/two,b.csv"};
  a.weights.resize(2);
  a.weights[0].fill(0.1);
  a.weights[1].fill(0.2);
  a.mean_weight.fill(0.15);
  a.models = {{"bswarm[noise=white]", {0.9, 0.8}, {1, 2}, 0.85, 1.5, 1}, {"boids", {0.1, NAN}, {2, 0}, 0.1, 2, 0, {0.8, 0.25, 1.35}}};
  return a;
}

TEST(AcrossReport, TextByHand) {
  EXPECT_EQ(across_text(sample(), {}),
            "Rank (score) on 2 recordings\n"
            " model                      one      two,b  mean rank  first       lead of the first\n"
            " bswarm[noise=white]  1 (0.900)  2 (0.800)       1.50      1                       –\n"
            " boids                2 (0.100)          –       2.00      0  0.800 (0.250 .. 1.350)\n");
}

TEST(AcrossReport, CsvByHand) {
  EXPECT_EQ(across_csv(sample()),
            "model,recording,rank,score\nbswarm[noise=white],one.csv,1,0.9\nbswarm[noise=white],\"dir/two,b.csv\",2,0.8\n"
            "boids,one.csv,2,0.1\nboids,\"dir/two,b.csv\",,\n");
}

TEST(AcrossReport, JsonHoldsEverything) {
  const auto json = nlohmann::json::parse(to_json(sample()));
  EXPECT_EQ(json["schema"], "swarmfit-across/1");
  EXPECT_EQ(json["recordings"][1]["path"], "dir/two,b.csv");
  EXPECT_EQ(json["recordings"][1]["weights"]["mu"], 0.2);
  EXPECT_EQ(json["models"][0]["rank"], (std::vector<int>{1, 2}));
  EXPECT_TRUE(json["models"][1]["score"][1].is_null());
  EXPECT_TRUE(json["models"][0]["lead_of_first"].is_null());
  EXPECT_EQ(json["models"][1]["lead_of_first"], 0.8);
  EXPECT_EQ(json["models"][1]["lead_ci"], (std::vector<double>{0.25, 1.35}));
}

TEST(AcrossReport, PaperTablesHaveOneColumnPerRecording) {
  for (const PaperTable& t : paper_tables(sample()))
    for (const auto& row : t.rows) EXPECT_EQ(row.size(), t.head.size()) << t.name;
  const PaperTable ranking = paper_tables(sample()).front();
  EXPECT_EQ(ranking.head[2], "two,b.csv") << "names of files, not paths";
  EXPECT_EQ(ranking.rows[1].back(), "0.800 (0.250 to 1.350)");
}

TEST(AcrossReport, SentenceSaysWhoIsFirstAndHowOften) {
  Across a = sample();
  EXPECT_EQ(across_sentence(a), "bswarm[noise=white] has the best mean rank, 1.50; it is first on 1 of 2 recordings");
  a.models[1].mean_rank = 1.5;
  EXPECT_EQ(across_sentence(a), "bswarm[noise=white] and boids share the best mean rank, 1.50");
  a.models[1].wins = 1;
  EXPECT_THAT(across_detail(a), HasSubstr("Also first: boids on 1."));
  a.models[0].wins = 2;
  EXPECT_EQ(across_sentence(a), "bswarm[noise=white] is first on all 2 recordings");
  a.models[0].mean_rank = NAN;
  EXPECT_EQ(across_sentence(a), "No model could be scored on any recording");
}

TEST(AcrossReport, DetailSaysOverWhomTheLeadHoldsBeyondTheseRecordings) {
  Across a = sample();
  EXPECT_THAT(across_detail(a), HasSubstr("the lead of bswarm[noise=white] holds over every other model (95 %)."));
  a.models.push_back({"rvo", {0.1, 0.7}, {3, 3}, 0.4, 3, 0, {0.45, -0.1, 1}});
  EXPECT_THAT(across_detail(a), HasSubstr("holds over boids, but not over rvo (95 %)."));
  a.models[1].lead.lower = -1;
  EXPECT_THAT(across_detail(a), HasSubstr("holds over no other model (95 %)."));
  a.models[1].lead = a.models[2].lead = {0.8};
  EXPECT_THAT(across_detail(a), Not(HasSubstr("holds")));
}

TEST(AcrossReport, PageLinksToEveryReportAndShowsHostileNamesAsText) {
  Across a = sample();
  a.recordings[0] = "<script>alert(1)</script>.csv";
  const std::string page = across_html(a, {{"<script>alert(1)</script>", "a & b"}, {"two b#1", "c"}}, "1.2.3");
  EXPECT_THAT(page,
              HasSubstr("<a href=\"./%3Cscript%3Ealert%281%29%3C/script%3E/report.html\">&lt;script&gt;alert(1)&lt;/script&gt;.csv</a>"));
  EXPECT_THAT(page, HasSubstr("<a href=\"./two%20b%231/report.html\">"));
  EXPECT_THAT(page, HasSubstr("a &amp; b"));
  EXPECT_EQ(page.find("<script"), page.rfind("<script"));  // only the built-in one
  EXPECT_THAT(page, Not(HasSubstr("{{")));
}

TEST(AcrossReport, WritesSummaryAndTables) {
  const auto dir = std::filesystem::path(testing::TempDir()) / "across_report";
  std::filesystem::remove_all(dir);
  write_across(dir.string(), sample(), {{"one", "first"}, {"two,b", "second"}}, "1.2.3");
  EXPECT_EQ(read_file((dir / "summary.json").string()), to_json(sample()));
  EXPECT_TRUE(std::filesystem::exists(dir / "report.html"));
  for (const char* file : {"across.csv", "across_ranking.md", "across_ranking.tex", "across_weights.md", "across_weights.tex"})
    EXPECT_TRUE(std::filesystem::exists(dir / "tables" / file)) << file;
  std::filesystem::remove_all(dir);
}

}  // namespace
}  // namespace swarmfit
