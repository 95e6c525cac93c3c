// SPDX-License-Identifier: MIT
#include "reports/study/power_html.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "fit/study/recovery.h"
#include "libtrack/file.h"
#include "reports/study/power_report.h"
#include "tests/reports/sample.h"

namespace swarmfit {
namespace {

using testing::HasSubstr;
using testing::Not;

// Of the sample's recording, 5 s long; bswarm and boids cannot be told apart.
Power sample() {
  Power p;
  p.fitted = sample_comparison();
  p.recovery.planted = p.recovery.compared = {"bswarm", "boids"};
  for (const auto& name : p.recovery.planted) {
    p.recovery.rows.push_back(planted_rows(parse_model(name), "mm"));
    p.recovery.parameters.emplace_back(p.recovery.rows.back().size(), 1.0);
  }
  p.recovery.cases = {{0, 2, p.recovery.parameters[0], {"bswarm", "boids"}, {0.9, 0.1}, {0.01, 0.01}, {1, 1}, {0.3, 0.01}, 1}};
  p.recovery.confusion = {{1, 0}, {0, 0}};
  p.pairs = {{0, 1, 3, 2, 1, 0.05, 0.05, 2.7}, {1, 0, 3, 3, 3, 0.4, 0.1, 1}};
  return p;
}

TEST(PowerPage, AnswersInWords) {
  const std::string page = power_html(sample(), {{"seeds", "3"}});
  EXPECT_THAT(page, HasSubstr("<h1>A recording like this one does not distinguish bswarm and boids (the right order needs about "));
  EXPECT_THAT(page, HasSubstr("The true model is ranked first in 1 of 1 recording."));
  EXPECT_THAT(page, HasSubstr("<dt>recording</dt><dd>swarm.txt</dd>"));
  EXPECT_THAT(page, HasSubstr(">Warnings<"));
  EXPECT_THAT(page, HasSubstr("<code>swarmfit power --config config.toml --out NEW_FOLDER</code>"));
  EXPECT_THAT(page, HasSubstr("Made by swarmfit 0.1.0."));
  EXPECT_THAT(page, Not(HasSubstr("{{")));
}

// 1.7 times 5 s are 8.5 s.
TEST(PowerPage, SaysHowMuchMoreOfTheRecordingItTakes) {
  const auto row = [](const Power& p) { return power_html(p, {}); };
  EXPECT_THAT(row(sample()), HasSubstr(">bswarm</th><td>boids</td><td class=\"n\">2 of 3</td><td class=\"n\">1 of 3</td>"));
  EXPECT_THAT(row(sample()), HasSubstr("<td class=\"n\">2.7 ×</td><td class=\"n\">8.5 s</td>"));
  EXPECT_THAT(row(sample()), HasSubstr("<td class=\"n\">as much</td><td class=\"n\">none</td>"));
  Power p = sample();
  p.pairs[0].factor = 61;
  EXPECT_THAT(row(p), HasSubstr("<td class=\"n\">61 ×</td><td class=\"n\">5 min</td>"));
  p.pairs[0].factor = INFINITY;
  EXPECT_THAT(row(p), HasSubstr("<td class=\"n\">never</td><td class=\"n\">–</td>"));
}

TEST(PowerPage, ShowsBothMatrices) {
  const std::string page = power_html(sample(), {});
  EXPECT_THAT(page, HasSubstr("<td class=\"mid right q5 own\">1</td><td class=\"mid none\">0</td><td class=\"mid\">1 of 1</td>"));
  EXPECT_THAT(page, HasSubstr("<td class=\"mid right q5 own\">1</td><td class=\"mid wrong q5\">1</td><td class=\"mid\">1 of 1</td>"));
}

TEST(PowerPage, HostileTextStaysText) {
  Power p = sample();
  p.fitted.recording.data.path = p.fitted.recording.data.unit = p.fitted.warnings.front() = "</title></script><img src=x>";
  const std::string page = power_html(p, {{"data", "<img>"}});
  EXPECT_THAT(page, Not(HasSubstr("<img")));
  EXPECT_THAT(page, HasSubstr("&lt;img src=x&gt;"));
}

TEST(PowerPage, StandsInTheFolder) {
  const auto dir = std::filesystem::path(testing::TempDir()) / "power_page";
  std::filesystem::remove_all(dir);
  write_power(dir.string(), sample(), {{"seeds", "3"}});
  EXPECT_EQ(read_file((dir / "report.html").string()), power_html(sample(), {{"seeds", "3"}}));
  std::filesystem::remove_all(dir);
}

}  // namespace
}  // namespace swarmfit
