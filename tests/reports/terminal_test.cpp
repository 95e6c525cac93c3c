// SPDX-License-Identifier: MIT

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <sstream>

#include "reports/comparison/ranking_text.h"
#include "reports/recording/recording_text.h"
#include "reports/write/list_text.h"
#include "tests/reports/sample.h"

namespace swarmfit {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::size_t widest(const std::string& text) {
  std::size_t width = 0;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) width = std::max(width, display_width(line));
  return width;
}

bool is_ascii(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

TEST(RankingText, ShowsScoresEnergiesWeightsAndWarnings) {
  const std::string text = ranking_text(sample_comparison(), {}, Detail::all);
  EXPECT_THAT(text, HasSubstr("bswarm matches the recording best."));
  EXPECT_THAT(text, HasSubstr(" 1 a  bswarm *                  0.912  0.88 .. 0.93   0.50   0.81"));
  EXPECT_THAT(text, HasSubstr("(α)"));
  EXPECT_THAT(text, HasSubstr("a~"));
  EXPECT_THAT(text, HasSubstr("~ mostly measurement error"));
  EXPECT_THAT(text, HasSubstr("it is constant or undefined in the recording"));
  EXPECT_THAT(text, HasSubstr("weight in score"));
  EXPECT_THAT(text, HasSubstr("mostly measurement error."));
  EXPECT_THAT(text, HasSubstr("* ended on a bound of its search"));
  EXPECT_THAT(text, Not(HasSubstr("\033")));
}

// A high rank does not hide that anybody can see the difference.
TEST(RankingText, MarksModelsThatSimpleObservablesContradict) {
  Comparison c = sample_comparison();
  EXPECT_THAT(ranking_text(c, {}), Not(HasSubstr("contradicted by simple observables")));
  c.models[0].likeness.refuted_by = {{c.recording.panel.items[0], {}, 1, 0}};
  EXPECT_THAT(ranking_text(c, {}), AllOf(HasSubstr(" 1 a  bswarm ! *"), HasSubstr("! contradicted by simple observables")));
}

// Of every model what no search has changed, wrapped like the rest.
TEST(RankingText, ShowsWhatIsKeptFixed) {
  Comparison c = sample_comparison();
  EXPECT_THAT(ranking_text(c, {}, Detail::all), HasSubstr(" kept fixed: bswarm, bswarm[noise=perlin]"));
  for (ModelFit& r : c.models)
    for (int k = 0; k < 9; ++k) r.parameters.push_back({"parameter_" + r.model, "", "mm/s^2", "", 0.25, 0.25, 0.25, false, false, false});
  EXPECT_LE(widest(ranking_text(c, {}, Detail::all)), 80u);
  c.models[0].parameters.back().unit = "mm/s^2";
  EXPECT_THAT(ranking_text(c, {}, Detail::all), HasSubstr("parameter_bswarm 0.25 mm/s²"));
  for (ModelFit& r : c.models) r.parameters.clear();
  EXPECT_THAT(ranking_text(c, {}, Detail::all), Not(HasSubstr("kept fixed")));
}

TEST(RankingText, FitsEightyColumns) {
  for (const Detail detail : {Detail::few, Detail::all}) EXPECT_LE(widest(ranking_text(sample_comparison(), {}, detail)), 80u);
  EXPECT_LE(widest(ranking_text(sample_comparison(), {.colour = false, .unicode = false})), 80u);
}

TEST(RankingText, SaysInFullWhatTheModelsAre) {
  Comparison c = sample_comparison();
  c.models[2].summary = "bswarm with white noise. Insect swarm";
  EXPECT_THAT(ranking_text(c, {}), Not(HasSubstr("with white noise")));
  EXPECT_THAT(ranking_text(c, {}, Detail::all), HasSubstr("\nModels\n  - bswarm: Force model with drag"));
  EXPECT_THAT(ranking_text(c, {}, Detail::all), HasSubstr(": bswarm with white noise. Insect swarm\n"));
}

TEST(RankingText, ShowsHalvesAndPosteriorsWhereThereAreSome) {
  Comparison c = sample_comparison();
  EXPECT_THAT(ranking_text(c, {}, Detail::all), Not(HasSubstr("the other way round")));
  EXPECT_THAT(ranking_text(c, {}, Detail::all), Not(HasSubstr("verdict")));
  c.recording.hold_out.ways = {{1, 240, 261, 500, {}, {}}, {261, 500, 1, 240, {}, {}}};
  for (ModelFit& r : c.models) r.standing.in_sample.score = r.standing.score + 0.05;
  c.models[0].posterior.simulations = 1800;
  c.models[0].parameters[0].posterior = {0.012, 0.01, 0.0141, 0.9, "identified", "chi_att", -0.83};
  const std::string text = ranking_text(c, {}, Detail::all);
  EXPECT_THAT(text, HasSubstr("0.962"));
  EXPECT_THAT(text, HasSubstr("0.0100 .. 0.0141"));
  EXPECT_THAT(text, HasSubstr("identified  chi_att (-0.83)"));
  EXPECT_LE(widest(text), 80u);
}

// The rest is for --verbose and the page.
TEST(RankingText, ShowsTheThreeGravestWarnings) {
  Comparison c = sample_comparison();
  c.warnings = {{Gravity::claim, "one"}, {Gravity::result, "two"}, {Gravity::meaning, "three"}, {Gravity::note, "four"}};
  const std::string text = ranking_text(c, {});
  EXPECT_THAT(text, HasSubstr("\nWarnings (the gravest 3 of 4)\n  - one\n  - two\n  - three\n\nAll warnings"));
  EXPECT_THAT(text, Not(HasSubstr("weight in score")));
  EXPECT_THAT(
      ranking_text(c, {}, Detail::all),
      HasSubstr(
          "\nRules out a conclusion\n  - one\n\nMay change the result\n  - two\n\nLimits what it means\n  - three\n\nNotes\n  - four\n"));
}

// As many columns as fit, each block headed by the first.
TEST(TextTable, FoldsWhatIsTooWide) {
  TextTable table({Align::left, Align::right, Align::right}, {});
  table.row({"model", std::string(40, 'x'), std::string(40, 'y')});
  EXPECT_EQ(table.width(), 1 + 5 + 2 + 40 + 2 + 40u);
  EXPECT_EQ(table.folded(), " model  " + std::string(40, 'x') + "\n\n model  " + std::string(40, 'y') + '\n');
}

TEST(RankingText, PlainTextIsAscii) { EXPECT_TRUE(is_ascii(ranking_text(sample_comparison(), {.colour = false, .unicode = false}))); }

TEST(RankingText, ColourOnlyWhenAsked) {
  EXPECT_THAT(ranking_text(sample_comparison(), {.colour = true, .unicode = true}), HasSubstr("\033[1m"));
}

TEST(RankingText, SyntheticDataAreLabelled) {
  Comparison c = sample_comparison();
  EXPECT_THAT(ranking_text(c, {}), Not(HasSubstr("synthetic")));
  c.recording.data.synthetic = true;
  EXPECT_THAT(ranking_text(c, {}), HasSubstr("(synthetic)"));
}

TEST(RankingText, PathsCannotDriveTheTerminal) {
  Comparison c = sample_comparison();
  c.recording.data.path = "evil\033]0;title\007.txt";
  EXPECT_THAT(ranking_text(c, {}), HasSubstr("evil?]0;title?.txt"));
}

TEST(RankingText, UndefinedNumbersAreDashes) {
  Comparison c = sample_comparison();
  for (ModelFit& r : c.models) r.standing.score = r.standing.in_sample.score = NAN, r.standing.rank = 0;
  EXPECT_THAT(ranking_text(c, {}), Not(HasSubstr("nan")));
}

TEST(DescribeText, SaysWhatIsThereAndWhatIsSuspicious) {
  Summary s{};
  s.tracks = 152;
  s.speed = {1000, 213, 98, 1, 40, 200, 400, 900};
  s.milling.median = NAN;
  s.localisation.samples = 100;
  s.localisation.jerk_share = 0.78;
  s.suspicions = {{"identity jump", "2 steps are longer than 20 median steps", "track 12, frame 340"}};
  TrackMeta meta;
  meta.dt = 0.01;
  meta.unit = "mm";
  meta.from.path = "swarm.txt";
  const std::string text = describe_text(meta, s, {});
  EXPECT_THAT(text, HasSubstr("100 Hz"));
  EXPECT_THAT(text, HasSubstr("Measurement error:"));
  EXPECT_THAT(text, HasSubstr("identity jump: 2 steps are longer than 20 median steps (track 12, frame 340)"));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
  EXPECT_TRUE(is_ascii(describe_text(meta, s, {.colour = false, .unicode = false})));
}

TEST(DescribeText, FitsEightyColumns) {
  Summary s{};
  const Quantiles wide{5562, 1600, 0.00838, 0.501, 0.0102, 1240, 0.154, 43900, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}};
  s.individuals = s.track_length = s.segment_length = s.speed = s.acceleration = s.nearest = s.extent = s.polarisation = s.milling = wide;
  s.speed_outliers = 30, s.acceleration_outliers = 32;
  TrackMeta meta;
  meta.unit = "mm";
  const std::string text = describe_text(meta, s, {});
  EXPECT_THAT(text, HasSubstr("\n speed 30 outliers and acceleration 32 outliers (beyond the median by 10 robust"));
  EXPECT_LE(widest(text), 80u);
}

TEST(FirstRowsText, FiveRowsAsUnderstood) {
  TrackColumns columns;
  columns.names = {"Ada\n"};
  columns.pos = Rows::Zero(7, 3);
  for (int i = 0; i < 7; ++i) {
    columns.frame.push_back(10 + i);
    columns.track.push_back(0);
    columns.pos(i, 0) = 1.5 * i;
  }
  TrackMeta meta;
  meta.dims = 2;
  meta.dt = 0.5;
  meta.unit = "mm";
  const std::string text = first_rows_text(Tracks(columns, meta), {});
  EXPECT_THAT(text, HasSubstr("x [mm]"));
  EXPECT_THAT(text, Not(HasSubstr("z [mm]")));
  EXPECT_THAT(text, Not(HasSubstr("Ada\n")));
  EXPECT_TRUE(std::regex_search(text, std::regex(R"(Ada\? +14 +7 +6 +0\n)"))) << text;
  EXPECT_THAT(text, Not(HasSubstr(" 15 ")));
}

TEST(EvaluationText, ShowsBothSides) {
  const Comparison c = sample_comparison();
  Evaluation e;
  e.real.from.path = "real.csv";
  e.simulated.from.path = "sim.csv";
  e.real.unit = "mm";
  e.raw_energies = c.models[0].runs.raw_energies;
  e.real_distribution = c.recording.distributions;
  e.simulated_distribution = c.models[0].runs.distributions;
  const std::string text = evaluation_text(e, {});
  EXPECT_THAT(text, HasSubstr("jerk"));
  EXPECT_THAT(text, AllOf(HasSubstr("\n distribution "), HasSubstr("\n simulation "), HasSubstr("█")));
  EXPECT_TRUE(is_ascii(evaluation_text(e, {.colour = false, .unicode = false})));
  e.binning.normalisation = Normalisation::separate;
  EXPECT_THAT(evaluation_text(e, {}), HasSubstr("standardised by itself")) << "where a set lies is not shown";
  EXPECT_THAT(text, HasSubstr("1.04"));
  EXPECT_LE(widest(text), 80u);
}

TEST(WeightsText, OneRowPerModel) {
  WeighedTable t{{"A", "B"}, {"v", "a"}, Eigen::MatrixXd(2, 2), {}, {1, 0.5}};
  t.energies << 0.5, 1, 2, 3;
  t.weighting = {{0.25, 0.75}, {0.5, 1}, {1.5, 2}, {0, 0}};
  EXPECT_EQ(weights_text(t, {}),
            " model    score       v       a\n A       1.0000  0.5000   1.000\n B       0.5000   2.000   3.000\n"
            " weight          0.2500  0.7500\n");
}

TEST(ListText, AlignsNames) {
  const std::string text = list_text({{"boids", "Flocking", {{"options", "rule=zonal|reynolds"}}}, {"bswarm", "Insects", {}}}, {});
  EXPECT_EQ(text, " boids   Flocking\n         options: rule=zonal|reynolds\n bswarm  Insects\n");
}

TEST(TextTable, ColumnsStandStraightInAsciiToo) {
  TextTable table({Align::left, Align::left}, {.colour = false, .unicode = false});
  table.row({"mm/s²", "x"});
  table.row({"mm", "y"});
  EXPECT_EQ(table.text(), " mm/s^2  x\n mm      y\n");
}

TEST(Wrapped, BreaksAtSpacesOnly) {
  EXPECT_EQ(wrapped("aa bb cc", 5, "  "), "aa bb\n  cc");
  EXPECT_EQ(wrapped("the 95 % of it", 7, " "), "the\n 95 %\n of it") << "a number and its sign are one word";
  EXPECT_EQ(wrapped("unbreakable", 3), "unbreakable");
  EXPECT_EQ(wrapped("", 3), "");
}

}  // namespace
}  // namespace swarmfit
