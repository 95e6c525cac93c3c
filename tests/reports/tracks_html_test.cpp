// SPDX-License-Identifier: MIT
#include "reports/recording/tracks_html.h"

#include <gmock/gmock.h>

#include "reports/recording/gallery_html.h"
#include "tests/reports/sample.h"

namespace swarmfit {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kHostile = "</title></script><img src=x onerror=\"alert('1')\">";
constexpr const char* kAsText = "&lt;img src=x onerror=&quot;alert(&#39;1&#39;)&quot;&gt;";

Comparison alone() {
  Comparison c = sample_comparison();
  c.models.clear();
  c.ranking.weight_history.clear();
  return c;
}

ModelCard card() { return {"vicsek", "Alignment with noise", "Vicsek et al. 1995", {{"eta", "η", "rad", "noise", 0.25, 0, 1}}}; }

std::string page_of(Comparison c, const TracksPage& page) {
  TrackMeta meta = c.film.meta();
  meta.from.path = c.recording.data.path;
  return tracks_html(c, meta, summarise(c.film), page);
}

TEST(TracksPage, ShowsARecordingByItself) {
  const std::string page = page_of(alone(), {"swarmfit describe swarm.txt --html page.html", "1.2.3", {}});
  EXPECT_THAT(page, HasSubstr("<h1>swarm.txt</h1>"));
  EXPECT_THAT(page, HasSubstr("class=\"player\""));
  EXPECT_THAT(page, HasSubstr("<canvas id=\"pdf-eta\""));
  EXPECT_THAT(page, HasSubstr("frames per track"));
  EXPECT_THAT(page, HasSubstr("Measurement error:"));
  EXPECT_THAT(page, HasSubstr("<code>swarmfit describe swarm.txt --html page.html</code>"));
  EXPECT_THAT(page, HasSubstr("Made by swarmfit 1.2.3."));
  EXPECT_THAT(page, Not(HasSubstr("id=\"model\"")));
}

TEST(TracksPage, NamesTheModelOfASimulation) {
  const std::string page = page_of(alone(), {"swarmfit simulate vicsek", "1.2.3", card()});
  for (const char* said : {"<h1>vicsek</h1>", "Alignment with noise.", "Vicsek et al. 1995", ">eta<", ">0.2500<"})
    EXPECT_THAT(page, HasSubstr(said));
}

// Agents may halt, or start at one place: no tracker is at fault.
TEST(TracksPage, BlamesNoTrackerForASimulation) {
  Comparison c = alone();
  c.recording.pictures.timeline = timeline(c.film);
  Summary summary = summarise(c.film);
  summary.suspicions = {{"frozen track", "1 of 4", ""}};
  TrackMeta meta = c.film.meta();
  EXPECT_THAT(tracks_html(c, meta, summary, {"", "1", {}}), testing::AllOf(HasSubstr("frozen track"), HasSubstr("id=\"quality\"")));
  const std::string simulated = tracks_html(c, meta, summary, {"", "1", card()});
  EXPECT_THAT(simulated, Not(HasSubstr("frozen track")));
  EXPECT_THAT(simulated, HasSubstr("<dt>simulation</dt>"));
  EXPECT_THAT(simulated, Not(HasSubstr("id=\"quality\"")));
  meta.from.path = "/somewhere/else/swarm.txt";
  EXPECT_THAT(tracks_html(c, meta, summary, {"", "1", {}}), HasSubstr("<h1>swarm.txt</h1>"));
}

TEST(TracksPage, HostileTextStaysText) {
  Comparison c = alone();
  c.recording.data.path = c.recording.data.unit = kHostile;
  ModelCard hostile = card();
  hostile.summary = hostile.citation = hostile.parameters[0].meaning = kHostile;
  const std::string page = page_of(c, {kHostile, kHostile, hostile});
  EXPECT_THAT(page, Not(HasSubstr("<img")));
  EXPECT_THAT(page, HasSubstr(kAsText));
}

TEST(Gallery, ShowsEveryExhibit) {
  const Tracks film = sample_comparison().film;
  ModelCard other = card();
  other.name = "boids<";
  const std::string page = gallery_html({{card(), "swarmfit simulate vicsek", film}, {other, "swarmfit simulate boids", film}}, "1.2.3");
  EXPECT_THAT(page, HasSubstr("<h1>2 scenes in motion</h1>"));
  for (const char* said :
       {"<h2 id=\"vicsek-title\">vicsek</h2>", "boids&lt;</h2>", "<a href=\"#vicsek\">", "swarmfit simulate boids", "Vicsek et al. 1995"})
    EXPECT_THAT(page, HasSubstr(said));
  EXPECT_THAT(page, Not(HasSubstr("{{")));
}

TEST(Gallery, OfNothingIsAPageStill) { EXPECT_THAT(gallery_html({}, "1.2.3"), HasSubstr("0 scenes in motion")); }

}  // namespace
}  // namespace swarmfit
