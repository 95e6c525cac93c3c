// SPDX-License-Identifier: MIT
#include "reports/comparison/tables.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numeric>
#include <sstream>

#include "tests/reports/sample.h"

namespace swarmfit {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string table(const Comparison& c, const std::string& name) {
  for (const NamedTable& t : result_tables(c))
    if (t.name == name) return t.csv;
  ADD_FAILURE() << "no table " << name;
  return {};
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

TEST(Csv, QuotesAsInRfc4180) {
  EXPECT_EQ(csv_field("plain text"), "plain text");
  EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_field("say \"x\""), "\"say \"\"x\"\"\"");
  EXPECT_EQ(csv_field("two\nlines"), "\"two\nlines\"");
  EXPECT_EQ(csv_field(""), "");
}

TEST(Tables, ModelNamesWithSeveralOptionsAreOneField) {
  Comparison c = sample_comparison();
  c.models[0].model = "bswarm[noise=white,avoidance=none]";
  EXPECT_THAT(lines(table(c, "ranking.csv"))[1], StartsWith("1,\"bswarm[noise=white,avoidance=none]\",0.912,0.882,"));
}

TEST(Tables, EveryTableHasAsManyLinesAsItSays) {
  const Comparison c = sample_comparison();
  EXPECT_EQ(lines(table(c, "ranking.csv")).size(), 1u + 5);
  EXPECT_EQ(lines(table(c, "energies.csv")).size(), 1u + 5 * 7);
  EXPECT_EQ(lines(table(c, "weights.csv")).size(), 1u + 4 * 7);
  EXPECT_EQ(lines(table(c, "normalisation.csv")).size(), 1u + 7);
  EXPECT_EQ(lines(table(c, "parameters.csv")).size(), 1u + 5 * 4);
  EXPECT_EQ(lines(table(c, "pdfs.csv")).size(), 1u + 7 * 150);
  EXPECT_EQ(lines(table(c, "convergence.csv")).size(), 1u + 5 * 60);
}

TEST(Tables, RawEnergiesHoldOnlyMetricsThatCount) {
  EXPECT_EQ(lines(table(sample_comparison(), "raw_energies.csv"))[0], "model,v,a,omega,d,eta");
}

TEST(Tables, UndefinedIsEmpty) {
  Comparison c = sample_comparison();
  c.models[0].standing.in_sample.score_se = NAN;
  c.models[0].standing.rank = 0;
  EXPECT_THAT(lines(table(c, "ranking.csv"))[1], AllOf(StartsWith(",bswarm,0.912,0.882,"), HasSubstr(",0.912,,1,")));
}

TEST(Tables, DensityIntegratesToOne) {
  const Comparison c = sample_comparison();
  for (std::size_t m = 0; m < kMetrics; ++m) {
    const auto q = physical_density(c.recording.distributions[m].histogram, c.recording.axis_width[m]);
    EXPECT_NEAR(std::accumulate(q.begin(), q.end(), 0.0) * c.recording.axis_width[m], 1, 1e-12);
  }
  EXPECT_TRUE(physical_density({}, 1).empty());
}

TEST(Tables, PdfRowsCarryPhysicalBinCentres) {
  Comparison c = sample_comparison();
  const std::size_t bins = c.recording.distributions[kSpeed].histogram.counts.size();
  c.ranking.band.lower.assign(c.recording.columns.size(), {});
  c.ranking.band.upper = c.ranking.band.lower;
  c.ranking.band.lower[kSpeed].assign(bins, 0.0);
  c.ranking.band.upper[kSpeed].assign(bins, 0.49 * c.recording.axis_width[kSpeed]);
  const auto rows = lines(table(c, "pdfs.csv"));
  EXPECT_EQ(rows[0],
            "metric,unit,centre,recording,bswarm,bswarm[noise=perlin],bswarm[noise=gaussian],boids,bswarm[noise=white],band_lower,"
            "band_upper");
  EXPECT_THAT(rows[1], StartsWith("v,mm/s,-272.1,"));  // 213 - 5*98 + 98/20
  EXPECT_THAT(rows[1], testing::EndsWith(",0,0.49"));  // shares per unit
  EXPECT_THAT(rows[1 + bins], testing::EndsWith(",,"));
}

TEST(Tables, ModelWithoutSamplesLeavesItsDensityEmpty) {
  Comparison c = sample_comparison();
  c.models[4].runs.distributions[kSpeed] = {};
  EXPECT_THAT(lines(table(c, "pdfs.csv"))[1], testing::EndsWith(",,,"));  // nor is there a band
}

TEST(History, ParametersAreOneColumn) {
  Comparison c = sample_comparison();
  c.run.history[0].raw[kJerk] = NAN;
  const auto rows = lines(history_csv(c));
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_EQ(rows[0], "model,pass,phase,replicates,failed,v,a,omega,alpha,mu,d,eta,parameters");
  EXPECT_THAT(rows[1], StartsWith("bswarm,1,search,3,1,"));
  EXPECT_THAT(rows[1], HasSubstr(",gamma=0.01;chi_att=2100;r_rep=12.5"));
}

TEST(Tables, EqualValuesGiveEqualBytes) {
  const auto first = result_tables(sample_comparison()), second = result_tables(sample_comparison());
  for (std::size_t k = 0; k < first.size(); ++k) EXPECT_EQ(first[k].csv, second[k].csv) << first[k].name;
}

}  // namespace
}  // namespace swarmfit
