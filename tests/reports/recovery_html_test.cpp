// SPDX-License-Identifier: MIT
#include "reports/study/recovery_html.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "fit/study/recovery.h"
#include "libtrack/file.h"
#include "reports/study/recovery_report.h"

namespace swarmfit {
namespace {

using testing::HasSubstr;
using testing::Not;

// Two recordings by bswarm, of which one cannot be told from boids', and two by boids: one lost to bswarm, one without groups.
Recovery sample() {
  Recovery r;
  r.planted = r.compared = {"bswarm", "boids"};
  for (const auto& name : r.planted) {
    r.rows.push_back(planted_rows(parse_model(name), "mm"));
    r.parameters.emplace_back(r.rows.back().size(), 1.0);
  }
  auto doubled = r.parameters[0];
  for (double& value : doubled) value = 2.5;
  r.cases = {{0, 1, r.parameters[0], {"bswarm", "boids"}, {0.9, 0.1}, {0.01, 0.01}, {1, 2}, {0.3, 0.01}, 1},
             {0, 2, doubled, {"bswarm", "boids"}, {0.7, 0.6}, {0.01, 0.01}, {1, 1}, {0.6, 0.01}, 1},
             {1, 1, r.parameters[1], {"bswarm", "boids"}, {0.6, 0.4}, {0.01, 0.02}, {1, 2}, {0.5, 0.04}, 2},
             {1, 2, r.parameters[1], {"boids", "bswarm"}, {0.6, 0.4}, {0.01, 0.02}, {0, 0}, {NAN, NAN}, 1}};
  r.confusion = {{2, 0}, {1, 1}};
  return r;
}

const Settings kSettings{{"seeds", "2"},    {"agents", "10"},   {"frames", "300"}, {"fps", "100"},  {"dims", "3"},
                         {"extent", "100"}, {"unit", "\"mm\""}, {"spread", "2"},   {"dropout", "0"}};

std::string page() { return recovery_html(sample(), kSettings, "1.2.3"); }

TEST(RecoveryPage, AnswersInWords) {
  EXPECT_EQ(recovery_sentence(sample()), "The true model is ranked first in 3 of 4 recordings.");
  EXPECT_EQ(recovery_detail(sample()),
            "It is alone in the best group in 1, shares it with others in 1, and is outside it in 1; in 1 the groups are not known.");
  Recovery all = sample();
  all.cases.resize(2);
  EXPECT_EQ(recovery_sentence(all), "The true model is ranked first in all 2 recordings.");
  EXPECT_THAT(page(), HasSubstr("<h1>The true model is ranked first in 3 of 4 recordings.</h1>"));
  EXPECT_THAT(page(), HasSubstr("synthetic data"));
}

// The true model's own cell is framed and blue, a rival's orange; half of two recordings is the third of five shades.
TEST(RecoveryPage, ConfusionIsShadedByShare) {
  EXPECT_THAT(page(),
              HasSubstr("<th scope=\"row\" class=\"name\">bswarm</th><td class=\"mid right q5 own\">2</td><td class=\"mid none\">0</td>"
                        "<td class=\"mid\">2 of 2</td>"));
  EXPECT_THAT(page(), HasSubstr("<th scope=\"row\" class=\"name\">boids</th><td class=\"mid wrong q3\">1</td>"
                                "<td class=\"mid right q3 own\">1</td><td class=\"mid\">1 of 2</td>"));
}

// Groups: bswarm is in its own twice, boids once beside it; boids' only grouped recording has bswarm alone.
TEST(RecoveryPage, SaysWhoIsToldApart) {
  EXPECT_THAT(page(), HasSubstr("<td class=\"mid right q5 own\">2</td><td class=\"mid wrong q3\">1</td><td class=\"mid\">2 of 2</td>"));
  EXPECT_THAT(
      page(),
      HasSubstr(">bswarm</th><td>boids</td><td class=\"n\">1 of 2</td><td class=\"n\">1 of 1</td><td><b>not distinguished</b></td>"));
  Recovery apart = sample();
  apart.cases.resize(1);
  EXPECT_THAT(recovery_html(apart, kSettings, ""), HasSubstr("<td>distinguished</td>"));
}

TEST(RecoveryPage, CountsWhoIsRejected) {
  EXPECT_THAT(page(), HasSubstr("<td class=\"mid none own\">0</td><td class=\"mid right q5\">2</td><td class=\"mid\">0 of 2</td>"));
  EXPECT_THAT(page(), HasSubstr("<td class=\"mid none\">0</td><td class=\"mid wrong q3 own\">1</td><td class=\"mid\">1 of 2</td>"));
}

TEST(RecoveryPage, NamesWhatWasPlantedAndHowToRepeatIt) {
  EXPECT_THAT(page(), HasSubstr("<td class=\"n\">1.000</td><td class=\"n\">1.000</td><td class=\"n\">2.500</td>"))
      << "about, least, greatest";
  EXPECT_THAT(page(), HasSubstr("<code>swarmfit recover --config config.toml --out NEW_FOLDER</code>"));
  EXPECT_THAT(page(), HasSubstr("agents = 10\n"));
  EXPECT_THAT(page(), HasSubstr("<dd>300 at 100 Hz</dd>"));
  EXPECT_THAT(page(), HasSubstr("Made by swarmfit 1.2.3."));
  EXPECT_THAT(page(), Not(HasSubstr("lost per individual"))) << "nobody was";
  EXPECT_THAT(page(), Not(HasSubstr("{{")));
}

TEST(RecoveryPage, HostileTextStaysText) {
  const std::string hostile = recovery_html(sample(), {{"unit", "\"<img src=x onerror=alert(1)>\""}, {"agents", "<img>{{css}}"}}, "<img>");
  EXPECT_THAT(hostile, Not(HasSubstr("<img")));
  EXPECT_THAT(hostile, HasSubstr("&lt;img src=x onerror=alert(1)&gt;"));
  EXPECT_THAT(hostile, HasSubstr("{{css}}"));
  EXPECT_THAT(hostile, HasSubstr("default-src 'none'; script-src 'sha256-"));
}

TEST(RecoveryPage, StandsInTheFolder) {
  const auto dir = std::filesystem::path(testing::TempDir()) / "recovery_page";
  std::filesystem::remove_all(dir);
  write_recovery(dir.string(), sample(), kSettings, "1.2.3");
  EXPECT_EQ(read_file((dir / "report.html").string()), page());
  std::filesystem::remove_all(dir);
}

}  // namespace
}  // namespace swarmfit
