// SPDX-License-Identifier: MIT
#include "reports/study/parameter_recovery_html.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <regex>

#include "libswarm/model_spec.h"
#include "libtrack/file.h"
#include "reports/study/parameter_recovery_report.h"

namespace swarmfit {
namespace {

using testing::HasSubstr;
using testing::Not;

// Two recordings; the first parameter's interval misses in the second.
ParameterRecovery sample() {
  const auto spec = parse_model("brownian").spec;
  const std::string a(spec->parameters[0].name), b(spec->parameters[1].name);
  ParameterRecovery r{"brownian", {}, {}, 3, 2, 2};
  const auto scale = [&](std::size_t row) { return scale_of(spec->parameters[row].log, spec->parameters[row].fit.lower); };
  const auto unit = [&](std::size_t row) { return to_string(spec->parameters[row].unit, "mm"); };
  r.parameters = {{a, unit(0), scale(0), 2, 1, 2, 0, 0, 0.01, 0.02, 0.05}, {b, unit(1), scale(1), 2, 2, 0, 1, 1, -0.1, 0.2, 0.7}};
  const ParameterInterval one{0, a, 5, 4, 6, 0.99, Identifiability::identified, b, 0.3},
      two{1, b, 1, 0.5, 3, 0.1, Identifiability::flat, a, 0.3};
  r.cases = {{7, {4.5, 2}, {one, two}, {0.4, 0.6}, {0.5, 0.5}, {0.05, 0.8}},
             {8, {9, 2.5}, {one, two}, {0.4, 0.6}, {0.5, 0.5}, {0.05, 0.8}}};
  return r;
}

std::size_t occurrences(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

std::string page() { return parameter_recovery_html(sample(), {{"parameters", "true"}, {"unit", "\"mm\""}}, "1.2.3"); }

TEST(ParameterRecoveryPage, AnswersInWords) {
  ParameterRecovery r = sample();
  const std::string a = r.parameters[0].name, b = r.parameters[1].name;
  EXPECT_EQ(coverage_sentence(r), "The 95 % intervals of " + a + " of brownian contain the true value too rarely.");
  r.fewest = 1;
  EXPECT_EQ(coverage_sentence(r), "The coverage of the 95 % intervals is within chance of 95 % for all 2 parameters of brownian.");
  r.most = 1;
  EXPECT_EQ(coverage_sentence(r), "The 95 % intervals of " + b + " of brownian contain the true value too often: they are too wide.");
  EXPECT_EQ(coverage_sentence({"brownian", {}, {}, 30, 0, 0}), "None of 30 recordings simulated from brownian can be fitted.");
  EXPECT_THAT(
      page(),
      HasSubstr(
          "Correct 95 % intervals contain 2 to 2 of 2 true values (99 % of the binomial, 2 parameters). 3 more recordings were left out"));
}

TEST(ParameterRecoveryPage, CoverageStandsBesideItsBand) {
  EXPECT_THAT(page(), HasSubstr("<td class=\"n\">1 of 2</td><td><svg class=\"interval\""));
  EXPECT_THAT(page(), HasSubstr("<td class=\"n\">2 to 2</td><td><span class=\"flag\">too rarely</span></td>"));
  EXPECT_THAT(page(), HasSubstr("<td class=\"n\">2 to 2</td><td>within</td>"));
}

TEST(ParameterRecoveryPage, DrawsEveryIntervalAndMarksTheMisses) {
  EXPECT_EQ(occurrences(page(), "<svg class=\"recovered\""), 2u);
  EXPECT_EQ(occurrences(page(), "<g class=\"holds\">"), 3u);
  EXPECT_EQ(occurrences(page(), "<g class=\"misses\">"), 1u);
  EXPECT_THAT(page(), HasSubstr("<title>seed 8: true value 9.00, median 5.00, 95 % from 4.00 to 6.00</title>"));
  EXPECT_EQ(occurrences(page(), "class=\"equal\""), 2u);
}

std::vector<double> numbers_in(const std::string& drawn, const std::regex& element) {
  std::smatch found;
  std::vector<double> out;
  if (std::regex_search(drawn, found, element))
    for (std::size_t k = 1; k < found.size(); ++k) out.push_back(std::stod(found[k]));
  return out;
}

// By hand: two ranks make steps of a half; the band is cut where it leaves the square.
TEST(ParameterRecoveryPage, RanksAreDrawnInTheirBand) {
  const std::string drawn = ranks_drawing({0.75, NAN, 0.25}, 0.1, "D").text;
  EXPECT_THAT(drawn, HasSubstr("class=\"ranks\" d=\"M34.00 123.00H61.00L61.00 69.00H115.00L115.00 15.00H142.00\""));
  EXPECT_THAT(drawn, HasSubstr("class=\"band\" d=\"M34.00 123.00L34.00 112.20L131.20 15.00L142.00 15.00L142.00 25.80L44.80 123.00Z\""));
}

TEST(ParameterRecoveryPage, SaysWhetherPosteriorsAreCalibrated) {
  ParameterRecovery r = sample();
  r.uniform_band = 0.3;
  for (ParameterCoverage& p : r.parameters) p.from_uniform = 0.2;
  r.from_uniform = 0.25;
  EXPECT_THAT(ranks_text(r), HasSubstr("are within 0.30 of uniform"));
  r.from_uniform = 0.4;
  EXPECT_THAT(ranks_text(r), HasSubstr("are not within 0.30 of uniform, as those of correct posteriors are in 95 % of studies of 2 "
                                       "recordings: those of all parameters together."));
}

// Whatever the scale of a parameter's axes: who finds the truth lies on the line where both are equal.
TEST(ParameterRecoveryPage, AMedianThatIsTheTruthLiesOnTheLine) {
  const std::regex equal(R"re(class="equal" x1="([^"]+)" y1="([^"]+)" x2="([^"]+)" y2="([^"]+)")re"),
      dot(R"re(cx="([^"]+)" cy="([^"]+)")re");
  for (const AxisScale scale : {AxisScale::linear, AxisScale::root, AxisScale::logarithmic}) {
    ParameterRecovery r = sample();
    r.parameters[0].scale = scale;
    for (ParameterCase& c : r.cases) c.found[0].median = c.truth[0];
    const std::string drawn = intervals_drawing(r, 0).text;
    const auto line = numbers_in(drawn, equal), at = numbers_in(drawn, dot);
    ASSERT_EQ(line.size(), 4u);
    ASSERT_EQ(at.size(), 2u);
    EXPECT_NEAR(line[1] + (line[3] - line[1]) * (at[0] - line[0]) / (line[2] - line[0]), at[1], 0.05);
  }
}

TEST(ParameterRecoveryPage, OneRecordingAloneIsDrawnToo) {
  ParameterRecovery r = sample();
  r.cases.resize(1);
  for (ParameterInterval& p : r.cases[0].found) p.lower = p.median = p.upper = r.cases[0].truth[p.row] = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    const std::string drawn = intervals_drawing(r, k).text;
    EXPECT_THAT(drawn, Not(HasSubstr("nan")));
    EXPECT_THAT(drawn, Not(HasSubstr("inf")));
  }
}

TEST(ParameterRecoveryPage, WithoutAFitThereIsAPageStill) {
  const std::string empty = parameter_recovery_html({"brownian", {}, {}, 30, 0, 0}, {}, "1.2.3");
  EXPECT_THAT(empty, HasSubstr("<h1>None of 30 recordings simulated from brownian can be fitted.</h1>"));
  EXPECT_THAT(empty, Not(HasSubstr("id=\"coverage\"")));
  EXPECT_THAT(empty, HasSubstr("swarmfit recover --config config.toml"));
}

TEST(ParameterRecoveryPage, HostileTextStaysText) {
  const std::string hostile = parameter_recovery_html(sample(), {{"unit", "\"<img src=x>\""}}, "<img>");
  EXPECT_THAT(hostile, Not(HasSubstr("<img")));
  EXPECT_THAT(hostile, HasSubstr("&lt;img src=x&gt;"));
}

TEST(ParameterRecoveryPage, StandsInTheFolder) {
  const auto dir = std::filesystem::path(testing::TempDir()) / "parameter_recovery_page";
  std::filesystem::remove_all(dir);
  write_parameter_recovery(dir.string(), sample(), {{"parameters", "true"}, {"unit", "\"mm\""}}, "1.2.3");
  EXPECT_EQ(read_file((dir / "report.html").string()), page());
  std::filesystem::remove_all(dir);
}

}  // namespace
}  // namespace swarmfit
