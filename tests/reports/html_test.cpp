// SPDX-License-Identifier: MIT
#include "reports/comparison/html.h"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>

#include "libtrack/rng.h"
#include "reports/write/html_table.h"
#include "tests/reports/sample.h"

namespace swarmfit {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

std::size_t occurrences(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

std::string between(const std::string& text, const std::string& open, const std::string& close) {
  const std::size_t first = text.find(open);
  if (first == std::string::npos) return {};
  const std::size_t start = first + open.size();
  return text.substr(start, text.find(close, start) - start);
}

// Without everything from one mark up to the next, as often as they occur.
std::string without(std::string text, const std::string& open, const std::string& close) {
  for (std::size_t at = text.find(open); at != std::string::npos; at = text.find(open, at)) text.erase(at, text.find(close, at) - at);
  return text;
}

// The page without the contents of scripts and style, which are ours.
std::string markup_of(const std::string& page) { return without(without(page, "<style>", "</style>"), "<script", "</script>"); }

constexpr std::size_t kScripts = 6;  // charts, their data, the report, the films, sorting and the player

json data_of(const std::string& page) { return json::parse(between(page, "<script type=\"application/json\" id=\"data\">", "</script>")); }

constexpr const char* kHostile = "</title></script><img src=x onerror=\"alert('1')\">{{data}}&amp;";

TEST(Html, EscapesEveryMarkupCharacter) { EXPECT_EQ(html_escaped("<a b=\"c\" d='e'>&"), "&lt;a b=&quot;c&quot; d=&#39;e&#39;&gt;&amp;"); }

// A quarter of a range that begins at zero lies in the middle of the axis along which it was searched, that of square roots.
TEST(Report, PlacesBetweenBoundsAreThoseOfTheSearch) {
  Comparison c = sample_comparison();
  const auto middle = [&] { return occurrences(report_html(c), "<circle cx=\"56.00\" cy=\"7\" r=\"5\"/>"); };
  EXPECT_EQ(middle(), 0u);
  c.models[0].parameters[2].value = c.models[0].parameters[2].upper / 4;
  EXPECT_EQ(middle(), 1u);
}

TEST(Report, HasEverySectionAndNoPlaceholderLeft) {
  const std::string page = markup_of(report_html(sample_comparison()));
  for (const char* id :
       {"result", "ranking", "energies", "distributions", "parameters", "weights", "search", "observation", "methods", "repeat"})
    EXPECT_THAT(page, HasSubstr("<section id=\"" + std::string(id) + '"'));
  EXPECT_THAT(page, Not(HasSubstr("{{")));
  EXPECT_THAT(page, HasSubstr("<h1>bswarm matches the recording best.</h1>"));
  EXPECT_THAT(page, HasSubstr("0.912"));
  EXPECT_THAT(page, HasSubstr("on a bound: chi_att"));
  EXPECT_THAT(page, HasSubstr("17 of 7367 simulations diverged"));
  EXPECT_THAT(page, HasSubstr("10.1371/journal.pone.0155698"));
  EXPECT_EQ(occurrences(page, "<canvas id=\"pdf-"), kMetrics);
}

TEST(Report, LoadsNothing) {
  const std::string page = report_html(sample_comparison());
  const std::string markup = markup_of(page);
  for (const char* attribute : {" src=", " srcset=", "<link", "<iframe", "<object", "<embed", "@import", " action="})
    EXPECT_THAT(markup, Not(HasSubstr(attribute))) << attribute;
  EXPECT_THAT(markup, Not(testing::ContainsRegex("url\\([^#]"))) << "but what a drawing says of itself";
  EXPECT_THAT(between(page, "<style>", "</style>"), Not(testing::ContainsRegex("url\\(|@import")));
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  EXPECT_THAT(page, Not(HasSubstr("unsafe-inline")));
}

// A style attribute would be refused by the content policy.
TEST(Report, HasNoInlineStyleOrHandler) {
  const std::string markup = markup_of(report_html(sample_comparison()));
  EXPECT_THAT(markup, Not(testing::ContainsRegex(" style=| on[a-z]+=\"")));
}

// Independent value: `printf %s 'abc' | openssl dgst -sha256 -binary | base64` agrees with the browser; here the shape, the browser the
// rest.
TEST(Report, PolicyAllowsTheScriptsAndTheStyleByHash) {
  const std::string policy = between(report_html(sample_comparison()), "Content-Security-Policy\" content=\"", "\">");
  const std::regex hash("'sha256-[A-Za-z0-9+/]{43}='");
  EXPECT_EQ(std::distance(std::sregex_iterator(policy.begin(), policy.end(), hash), std::sregex_iterator()), 5);
}

TEST(Report, ScriptsEndWhereTheyShould) {
  const std::string page = report_html(sample_comparison());
  EXPECT_EQ(occurrences(page, "<script"), kScripts);
  EXPECT_EQ(occurrences(page, "</script>"), kScripts);
}

TEST(Report, VariantsSayWhatSetsThemApart) {
  Comparison c = sample_comparison();
  c.models[1].summary = "bswarm with Perlin noise. Force model";
  EXPECT_THAT(report_html(c), HasSubstr("<span class=\"what\">bswarm with Perlin noise</span>"));
  c.models.erase(c.models.begin());
  c.run.named.erase(c.run.named.begin());
  EXPECT_THAT(report_html(c), HasSubstr("<span class=\"what\">bswarm with Perlin noise. Force model</span>"))
      << "nothing else says what bswarm is";
}

TEST(Report, HostileTextIsShownAndNeverRuns) {
  Comparison c = sample_comparison({{kHostile, 0.9, NAN, 1.1}, {"boids", NAN, NAN, 1.3}});
  c.recording.data.path = c.recording.data.unit = c.recording.data.sha256 = c.recording.data.columns = c.run.version = c.run.budget.name =
      kHostile;
  c.warnings = {kHostile};
  c.recording.observation.why_not.fill(kHostile);
  c.models[0].citation = c.models[0].summary = c.models[0].search.stop_reason = kHostile;
  for (ParameterResult& p : c.models[0].parameters) p.name = p.symbol = p.unit = p.meaning = kHostile;
  c.run.config = {{"DATA", kHostile}};
  TrackMeta meta = c.film.meta();
  meta.unit = kHostile;
  c.film = Tracks({{"a"}, {0}, {1}, Rows::Zero(1, 3), {}, {}, {}, {}}, meta);
  const std::string page = report_html(c);
  EXPECT_EQ(occurrences(page, "<script"), kScripts);
  EXPECT_EQ(occurrences(page, "</script>"), kScripts);
  EXPECT_EQ(occurrences(page, "</title>"),
            occurrences(report_html(sample_comparison({{"a", 0.9, NAN, 1.1}, {"boids", NAN, NAN, 1.3}})), "</title>"));
  EXPECT_THAT(markup_of(page), Not(HasSubstr("<img")));
  EXPECT_THAT(markup_of(page), HasSubstr("&lt;img src=x onerror=&quot;alert(&#39;1&#39;)&quot;&gt;{{data}}&amp;amp;"));
  EXPECT_EQ(data_of(page)["models"][0]["name"], kHostile);
}

TEST(Report, UndefinedNumbersAreDashesAndNulls) {
  Comparison c = sample_comparison();
  ModelFit& r = c.models[1];
  r.standing.score = r.standing.in_sample.score = r.standing.in_sample.score_se = r.runs.infeasible_avoidance = NAN;
  r.standing.rank = 0;
  r.runs.raw_energies.fill(NAN);
  r.runs.raw_se.fill(INFINITY);
  r.search.convergence[0].best = -INFINITY;
  r.runs.distributions = {};
  const std::string page = report_html(c);
  const json data = data_of(page);
  EXPECT_TRUE(data["metrics"][0]["models"][1].empty());
  EXPECT_THAT(markup_of(page), Not(testing::ContainsRegex("[^a-z](nan|inf)[^a-z]")));
}

TEST(Report, ShowsTheRecordingAndEveryModelInMotion) {
  const Comparison c = sample_comparison();
  const std::string page = report_html(c);
  EXPECT_THAT(markup_of(page), HasSubstr("Shown are the first 20 of 500 frames, from 1 to 20: 0.19 s."));
  const json film = json::parse(between(page, "<div class=\"player\"><script type=\"application/json\">", "</script>"));
  EXPECT_EQ(film["dims"], 3);
  EXPECT_EQ(film["unit"], "mm");
  EXPECT_EQ(film["clock"], json::parse("[[1, 20]]"));
  ASSERT_EQ(film["takes"].size(), 1 + c.models.size());
  EXPECT_EQ(film["takes"][0]["title"], "recording");
  EXPECT_EQ(film["takes"][0]["series"], -1);
  EXPECT_EQ(film["takes"][2]["title"], c.models[1].model);
  EXPECT_EQ(film["takes"][2]["rows"], c.models[1].film.rows());
}

TEST(Report, HasNoEmptyPlayer) {
  Comparison c = sample_comparison();
  c.film = {};
  EXPECT_THAT(markup_of(report_html(c)), Not(HasSubstr("class=\"player\"")));
}

TEST(Report, EmptyComparisonStillMakesAPage) { EXPECT_THAT(report_html(Comparison{}), HasSubstr("No model could be scored.")); }

TEST(Report, SyntheticDataAreLabelled) {
  Comparison c = sample_comparison();
  EXPECT_THAT(markup_of(report_html(c)), Not(HasSubstr("synthetic data")));
  c.recording.data.synthetic = true;
  EXPECT_THAT(markup_of(report_html(c)), HasSubstr("class=\"badge\">synthetic data<"));
}

TEST(Report, WarningsBoxOnlyWithWarnings) {
  Comparison c = sample_comparison();
  EXPECT_THAT(markup_of(report_html(c)), HasSubstr("<aside class=\"warnings\""));
  c.warnings.clear();
  EXPECT_THAT(markup_of(report_html(c)), Not(HasSubstr("<aside")));
}

TEST(Report, EqualValuesGiveEqualBytes) { EXPECT_EQ(report_html(sample_comparison()), report_html(sample_comparison())); }

// As many points as a page may carry, of five models and the recording, and noisy ones, which compress badly. The time that this takes, as
// the test program prints it, is that of such a report.
TEST(Report, StaysSmallWithFilmsOfFullLength) {
  Comparison c = sample_comparison();
  const Rng rng{1};
  for (std::size_t k = 0; k <= c.models.size(); ++k) {
    TrackColumns columns;
    columns.names.resize(166);
    columns.pos.resize(500 * 166, 3);
    for (Index i = 0; i < columns.pos.rows(); ++i) {
      const auto track = static_cast<std::uint32_t>(i / 500);
      columns.track.push_back(track);
      columns.frame.push_back(1 + i % 500);
      for (int axis = 0; axis < 3; ++axis) {
        const double start = 200 * rng.uniform(Stream::start, track, static_cast<std::uint32_t>(axis));
        const double phase = 0.02 * static_cast<double>(i % 500) + static_cast<double>(k), noise = rng.uniform(Stream::start, i, 9, axis);
        columns.pos(i, axis) = start + 100 * std::sin(phase + start) + noise;
      }
    }
    (k == 0 ? c.film : c.models[k - 1].film) = Tracks(std::move(columns), c.film.meta());
  }
  const std::string page = report_html(c);
  EXPECT_LT(page.size(), 5'000'000u);
  RecordProperty("bytes", static_cast<int>(page.size()));
}

TEST(Report, StaysSmall) { EXPECT_LT(report_html(sample_comparison()).size(), 1u << 20); }

}  // namespace
}  // namespace swarmfit
