// SPDX-License-Identifier: MIT
#include "reports/comparison/figures.h"

#include <gmock/gmock.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>

#include "reports/comparison/figure_parts.h"
#include "reports/comparison/force_tables.h"
#include "reports/comparison/page_sections.h"
#include "reports/comparison/picture_tables.h"
#include "reports/draw/paths.h"
#include "reports/draw/svg.h"
#include "tests/reports/sample.h"

namespace swarmfit {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

Figure named(const std::vector<Figure>& all, const std::string& name) {
  for (const Figure& f : all)
    if (f.name == name) return f;
  return {};
}

std::size_t occurrences(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

// Matchers of the whole text would print it on failure.
bool holds(const std::string& text, const std::string& pattern) { return std::regex_search(text, std::regex(pattern)); }

// Without an independent reader of XML there is no test.
void expect_xml(const std::vector<Figure>& all) {
  if (std::system("command -v python3 >/dev/null") != 0) GTEST_SKIP() << "there is no python3 on this machine";
  namespace fs = std::filesystem;
  const fs::path dir =
      fs::path(testing::TempDir()) / ("figures_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
  fs::remove_all(dir);
  fs::create_directories(dir);
  for (const Figure& f : all) std::ofstream(dir / (f.name + ".svg"), std::ios::binary) << f.svg;
  const std::string program = "import sys, glob, xml.etree.ElementTree as E; [E.parse(f) for f in glob.glob(sys.argv[1] + '/*.svg')]";
  const int status = std::system(("python3 -c \"" + program + "\" '" + dir.string() + "'").c_str());
  EXPECT_EQ(WEXITSTATUS(status), 0) << "not well-formed";
  fs::remove_all(dir);
}

TEST(Figures, AreAllThere) {
  std::vector<std::string> names;
  for (const Figure& f : figures(sample_comparison())) names.push_back(f.name);
  EXPECT_THAT(names, testing::ElementsAre("densities", "scores", "energies", "convergence", "parameters", "density_v", "density_a",
                                          "density_omega", "density_alpha", "density_mu", "density_d", "density_eta"));
  EXPECT_FALSE(named(figures(sample_at_lags()), "density_mu_lag16").svg.empty());
  for (const std::string& name : names) EXPECT_TRUE(is_figure(name + ".svg")) << name;
  EXPECT_FALSE(is_figure("mine.svg"));
}

TEST(Figures, AreXmlAndAJournalsWidth) {
  const std::vector<Figure> all = figures(sample_at_lags());
  for (const Figure& f : all) {
    EXPECT_TRUE(holds(f.svg.substr(0, 200), "width=\"(85|178)mm\"")) << f.name;
    EXPECT_FALSE(holds(f.svg, "[^a-z](nan|inf)[^a-z]|href| style=|<script")) << f.name;
    EXPECT_THAT(f.caption, HasSubstr("Recording swarm.txt")) << f.name;
  }
  expect_xml(all);
}

TEST(Figures, EqualValuesGiveEqualBytes) {
  const auto one = figures(sample_at_lags()), other = figures(sample_at_lags());
  for (std::size_t k = 0; k < one.size(); ++k) EXPECT_EQ(one[k].svg, other[k].svg);
}

TEST(Figures, HostileTextIsShown) {
  const std::string hostile = "</text><script>alert(1)</script>&\x01\xff\xc0\"'";
  Comparison c = sample_comparison({{hostile, 0.9, 0.01, 1.1}, {"boids", 0.5, 0.01, 1.3}});
  c.recording.data.unit = c.recording.data.path = c.run.version = hostile;
  for (ParameterResult& p : c.models[0].parameters) p.name = p.unit = hostile;
  const std::vector<Figure> all = figures(c);
  for (const Figure& f : all) EXPECT_FALSE(holds(f.svg, "<script>")) << f.name;
  EXPECT_THAT(named(all, "scores").svg, HasSubstr("&lt;script&gt;alert(1)&lt;/script&gt;&amp;???"));
  expect_xml(all);
}

TEST(Figures, WhatIsUndefinedIsLeftOutAndSaid) {
  Comparison c = sample_comparison();
  ModelFit& r = c.models[1];
  r.standing.score = r.standing.certainty.lower = r.standing.certainty.upper = NAN;
  r.runs.raw_energies[kJerk] = r.runs.raw_se[kSpeed] = NAN;
  r.runs.distributions[kSpeed] = {};
  r.parameters[0].value = NAN;
  for (ConvergencePoint& p : r.search.convergence) p.best = -INFINITY;
  c.recording.distributions[kDistance] = {};
  const std::vector<Figure> all = figures(c);
  for (const Figure& f : all) EXPECT_FALSE(holds(f.svg, "[^a-z](nan|inf)[^a-z]")) << f.name;
  EXPECT_THAT(named(all, "density_v").svg, HasSubstr(">No samples of v: bswarm[noise=perlin].</text>"));
  EXPECT_THAT(named(all, "densities").svg, HasSubstr("No samples of d in the recording."));
  EXPECT_THAT(named(all, "density_d").svg, IsEmpty());
  EXPECT_THAT(named(all, "scores").svg, HasSubstr(">Without a score: bswarm[noise=perlin].</text>"));
  EXPECT_THAT(named(all, "energies").svg, HasSubstr(">Undefined or below the axis in bswarm[noise=perlin]: μ.</text>"));
  EXPECT_THAT(named(all, "convergence").svg, HasSubstr(">No finite score: bswarm[noise=perlin].</text>"));
  expect_xml(all);
}

TEST(Figures, NothingToDrawIsNoFigure) { EXPECT_THAT(figures(Comparison{}), IsEmpty()); }

TEST(Figures, SeriesDifferWithoutColour) {
  std::vector<Sketch> many;
  for (int k = 0; k < 12; ++k) many.push_back({"m" + std::to_string(k), 0.9 - 0.05 * k, 0.01, 1 + 0.02 * k});
  const std::string svg = named(figures(sample_comparison(many)), "convergence").svg;
  std::vector<std::string> looks;
  const std::regex look("<path [^>]*stroke=\"(#[0-9a-f]+)\" stroke-width=\"0.9\"( stroke-dasharray=\"[^\"]*\")?");
  for (std::sregex_iterator at(svg.begin(), svg.end(), look); at != std::sregex_iterator(); ++at)
    looks.push_back((*at)[1].str() + (*at)[2].str());
  ASSERT_EQ(looks.size(), 12u);
  std::sort(looks.begin(), looks.end());
  EXPECT_EQ(std::adjacent_find(looks.begin(), looks.end()), looks.end());
}

TEST(Figures, NoMoreThanEightCurvesInAPanel) {
  std::vector<Sketch> many;
  for (int k = 0; k < 10; ++k) many.push_back({"m" + std::to_string(k), 0.9 - 0.05 * k, 0.01, 1 + 0.02 * k});
  const Figure f = named(figures(sample_comparison(many)), "density_v");
  EXPECT_EQ(occurrences(f.svg, "<path"), 1u + 8);
  EXPECT_THAT(f.svg.substr(f.svg.find("<rect")), AllOf(HasSubstr(">m7</text>"), Not(HasSubstr(">m8</text>"))));
  EXPECT_THAT(f.svg, HasSubstr(">Not drawn: m8 and m9.</text>"));
  EXPECT_THAT(f.caption, HasSubstr("Not drawn: m8 and m9."));
}

// The peak of the sample's speed: of the recording the area's highest point, of a narrow model beyond twice that.
TEST(Figures, APeakBeyondTwiceTheRecordingsIsCutAndSaid) {
  Comparison c = sample_comparison();
  Histogram& h = c.models[3].runs.distributions[kSpeed].histogram;
  std::fill(h.counts.begin(), h.counts.end(), 0);
  h.counts[50] = h.samples = 60000;
  c.models[2].runs.outside_fraction[kDistance] = 0.12;
  const std::vector<Figure> all = figures(c);
  EXPECT_THAT(named(all, "densities").caption,
              AllOf(HasSubstr("Model peaks cropped at 2 times the recording's peak: v (boids)"),
                    HasSubstr("Samples outside the binned interval: d of bswarm[noise=gaussian] (12 %).")));
  EXPECT_THAT(named(figures(sample_comparison()), "densities").caption, Not(HasSubstr("v (boids)")));
}

TEST(Figures, EveryModelHasItsIntervalAndLetter) {
  const std::string svg = named(figures(sample_comparison()), "scores").svg;
  EXPECT_EQ(occurrences(svg, "stroke-width=\"1.4\""), 5u) << "whiskers";
  EXPECT_THAT(svg, AllOf(HasSubstr(">0.912</text>"), HasSubstr(">a</text>"), HasSubstr(">bswarm[noise=white]</text>"),
                         HasSubstr("score, 95 % interval")));
  Comparison held_out = sample_comparison();
  held_out.recording.hold_out.ways = {{1, 240, 261, 500, {}, {}}, {261, 500, 1, 240, {}, {}}};
  for (ModelFit& r : held_out.models) r.standing.in_sample.score = r.standing.score + 0.1;
  EXPECT_THAT(named(figures(held_out), "scores").svg, HasSubstr("hollow: in sample"));
}

TEST(Figures, PosteriorsAreBarsBesideTheirValues) {
  Comparison c = sample_comparison();
  EXPECT_EQ(occurrences(named(figures(c), "parameters").svg, "stroke-width=\"1.4\""), 0u);
  c.models[0].posterior.simulations = 1800;
  c.models[0].parameters[0].posterior = {0.012, 0.01, 0.0141, 0.9, "identified", "chi_att", -0.83};
  const Figure f = named(figures(c), "parameters");
  EXPECT_EQ(occurrences(f.svg, "stroke-width=\"1.4\""), 1u);
  EXPECT_THAT(f.svg, AllOf(HasSubstr(">gamma [1/mm]</text>"), HasSubstr(">0.0123 (0.0100 to 0.0141)</text>"), HasSubstr(">2310 *</text>")));
  EXPECT_THAT(f.caption, HasSubstr("95 % of the posterior"));
}

TEST(Figures, CaptionsComeInBothLanguages) {
  const std::vector<Figure> all = {{"density_v", "Ab_c 5 %.", "<svg/>"}};
  EXPECT_THAT(captions_latex({{"scores", "", "<svg width=\"178mm\"/>"}}), HasSubstr("\\begin{figure*}")) << "as wide as a page";
  EXPECT_EQ(captions_markdown(all), "**density\\_v.svg** Ab\\_c 5 %.\n");
  EXPECT_THAT(captions_latex(all), HasSubstr("\\includegraphics{density_v.pdf}\n  \\caption{Ab\\_c 5 \\%.}\n  \\label{fig:density_v}"));
}

TEST(Svg, LengthsAreShort) {
  EXPECT_EQ(svg::length(12.5), "12.5");
  EXPECT_EQ(svg::length(-0.001), "0");
  EXPECT_EQ(svg::length(3), "3");
}

TEST(Svg, OnlyCharactersOfXmlPass) {
  EXPECT_EQ(svg::xml_escaped("ω ≤ 𝄞"), "ω ≤ 𝄞");
  EXPECT_EQ(svg::xml_escaped("\xed\xa0\x80"), "???") << "a surrogate";
  EXPECT_EQ(svg::xml_escaped("\xef\xbf\xbf"), "???") << "U+FFFF";
  EXPECT_EQ(svg::xml_escaped("\xc0\xaf\xf0\x80\x80\xaf"), "??????") << "overlong";
  EXPECT_EQ(svg::xml_escaped("\xe2\x82"), "??") << "cut short";
}

// As compare fills them, from the films.
Comparison with_pictures() {
  Comparison c = sample_comparison();
  const PictureGrid grid = picture_grid(c.film);
  c.recording.pictures = {grid, pictures(c.film, grid), timeline(c.film)};
  const std::vector<double> up{0, 1, 2}, some{0.3, 0.2, 0.25}, error{0.1, 0.1, 0.1}, unknown(3, NAN);
  const ForceCurves curves{some, some, up, some, {1, 2, 3}}, errors{error, error, error, unknown, {}};
  c.recording.forces = {{up, up, up}, curves, errors, {}, 0.03, 0.5};
  for (ModelFit& r : c.models) r.likeness.forces = {curves, errors};
  for (ModelFit& r : c.models) r.likeness.pictures = picture_spread({pictures(r.film, grid), pictures(c.film, grid)});
  return c;
}

TEST(Pictures, StandBesideEachOther) {
  const Comparison c = with_pictures();
  std::vector<std::string> names;
  for (const Figure& f : figures(c)) {
    names.push_back(f.name);
    EXPECT_TRUE(is_figure(f.name + ".svg")) << f.name;
    EXPECT_THAT(f.svg, Not(testing::ContainsRegex("[^a-z](nan|inf)[^a-z]"))) << f.name;
  }
  for (const char* name : {"neighbours", "responses", "curves", "forces", "order", "space"}) EXPECT_THAT(names, testing::Contains(name));
  EXPECT_THAT(parts::data_quality(c).svg, HasSubstr("individuals seen per frame"));
  EXPECT_THAT(parts::trajectory_strip(c).svg, HasSubstr("bswarm, the best model"));
  EXPECT_EQ(parts::neighbours(sample_comparison()).svg, "") << "nothing was measured";
  EXPECT_EQ(parts::forces(sample_comparison()).svg, "");
}

// All of them moved by so much.
Tracks shifted(const Tracks& tracks, double by) {
  TrackColumns columns;
  columns.names = tracks.names();
  columns.pos = tracks.pos();
  columns.pos.col(0) += by;
  columns.track.assign(tracks.track().begin(), tracks.track().end());
  columns.frame.assign(tracks.frame().begin(), tracks.frame().end());
  return {std::move(columns), tracks.meta()};
}

// The circles of the recording are 100 mm wide; figures are rounded to two digits.
TEST(Pictures, FirstFigureHoldsWhatLeavesTheRecordingsFrame) {
  Comparison c = with_pictures();
  c.models[0].film = c.film;
  EXPECT_THAT(parts::trajectory_strip(c).caption, HasSubstr("panels are 100 mm high."));
  EXPECT_THAT(parts::trajectory_strip(c).caption, Not(HasSubstr("Dashed")));

  c.models[0].film = shifted(c.film, 80);
  EXPECT_THAT(parts::trajectory_strip(c).caption,
              AllOf(HasSubstr("panels are 180 mm high. Dashed: the square of 100 mm that holds the recording."), Not(HasSubstr("Beyond"))));

  c.models[0].film = shifted(c.film, 500);
  EXPECT_THAT(parts::trajectory_strip(c).caption,
              AllOf(HasSubstr("panels are 200 mm high."), HasSubstr("Beyond the frame is bswarm (100 % of its positions).")));
}

// Of a recording that is longer than wide, and a model beside it.
TEST(Pictures, FrameHoldsTheSquareOfTheRecording) {
  const Tracks circles = with_pictures().film;
  const auto flat = [&](double y) {
    TrackColumns columns;
    columns.names = circles.names();
    columns.pos = circles.pos();
    columns.pos.col(1) = 0.1 * columns.pos.col(1) + y;
    columns.track.assign(circles.track().begin(), circles.track().end());
    columns.frame.assign(circles.frame().begin(), circles.frame().end());
    return Tracks(std::move(columns), circles.meta());
  };
  const Tracks recording = flat(0), model = flat(40);
  const plot::Window own = plot::window_of(recording), frame = plot::window_for({&recording, &model});
  EXPECT_LE(frame.y - frame.half, own.y - own.half + 1e-9);
  EXPECT_GE(frame.y + frame.half, own.y + own.half - 1e-9);
  EXPECT_LT(frame.half, 2 * own.half);
}

TEST(Pictures, PosteriorOfEveryModelThatHasOne) {
  Comparison c = sample_comparison();
  EXPECT_EQ(parts::posterior(c, 0).svg, "");
  PosteriorFacts& p = c.models[0].posterior;
  const auto searched = std::count_if(c.models[0].parameters.begin(), c.models[0].parameters.end(), [](const auto& q) { return q.fitted; });
  for (int k = 0; k < 10; ++k) {
    std::vector<double> point;
    for (const ParameterResult& q : c.models[0].parameters)
      if (q.fitted) point.push_back(q.lower + (q.upper - q.lower) * (k + 0.5) / 10);
    p.sample.push_back(point);
    p.weight.push_back(0.1);
  }
  p.simulations = 10;
  const Figure f = parts::posterior(c, 0);
  EXPECT_EQ(f.name, "posterior_1");
  EXPECT_EQ(static_cast<std::ptrdiff_t>(searched), 3);
  EXPECT_THAT(f.caption, HasSubstr("Posterior of bswarm"));
}

// A group that never changes has no ticks to fill a page with.
TEST(Pictures, WhatDoesNotVaryIsDrawn) {
  Comparison c = with_pictures();
  c.models.clear();
  std::vector<double>& p = c.recording.pictures.recording.polarisation;
  for (std::size_t k = 0; k < p.size(); ++k) p[k] = k % 2 == 0 ? 1 : std::nextafter(1, 2);
  EXPECT_LT(parts::order(c).svg.size(), 200'000u);
}

// A polarisation is no more than 1, whatever the standard deviation.
TEST(Pictures, BandsStayWithinWhatCanBe) {
  Comparison c = with_pictures();
  for (ModelFit& r : c.models) {
    r.likeness.pictures.mean.polarisation.assign(c.recording.pictures.recording.polarisation.size(), 0.9);
    r.likeness.pictures.sd.polarisation.assign(c.recording.pictures.recording.polarisation.size(), 0.3);
  }
  EXPECT_THAT(parts::order(c).svg, AllOf(HasSubstr(">1.0<"), Not(HasSubstr(">1.5<"))));
  for (ModelFit& r : c.models) {
    r.likeness.pictures.sd.pairs.assign(c.recording.pictures.recording.pairs.size(), 10);
    r.likeness.pictures.mean.pairs.assign(c.recording.pictures.recording.pairs.size(), 1);
  }
  EXPECT_THAT(parts::curves(c).svg, AllOf(HasSubstr(">20<"), Not(HasSubstr(">−20<")), Not(HasSubstr(">−10<")))) << "g(r) is 0 or more";
}

// A model that is far off leaves the panel, and does not make it an empty one.
TEST(Pictures, ForcesFarFromTheRecordingsDoNotStretchTheAxis) {
  const auto numbers = [](const std::string& svg) {
    std::vector<std::string> out;
    const std::regex tick(">([−0-9.]+)<");
    for (std::sregex_iterator at(svg.begin(), svg.end(), tick), end; at != end; ++at) out.push_back((*at)[1]);
    return out;
  };
  Comparison c = with_pictures();
  c.models.resize(1);
  const auto near = numbers(parts::forces(c).svg);
  for (double& value : c.models[0].likeness.forces.median.drag) value = -1000;
  EXPECT_EQ(numbers(parts::forces(c).svg), near);
}

TEST(Pictures, AColourBarStandsBesideItsLastMap) {
  Comparison alone = with_pictures();
  alone.models.clear();
  const auto right_end = [](const Figure& f) {
    double out = 0;
    for (std::size_t at = 0; (at = f.svg.find("<rect x=\"", at)) != std::string::npos; ++at)
      out = std::max(out, std::atof(f.svg.c_str() + at + 9));
    return out;
  };
  EXPECT_LT(right_end(parts::neighbours(alone)), 200) << "of a sheet 505 points wide";
  EXPECT_GT(right_end(parts::neighbours(with_pictures())), 400);
}

TEST(Pictures, ForcesAreSaidAndTabulated) {
  const Comparison c = with_pictures();
  EXPECT_THAT(page::forces(c).text, AllOf(HasSubstr("They suffice to describe the recorded accelerations."),
                                          HasSubstr("nor repel each other: p = 0.030."), HasSubstr("<svg")));
  EXPECT_EQ(page::forces(sample_comparison()).text, "");
  const std::string csv = forces_csv(c);
  EXPECT_THAT(csv, testing::StartsWith("curve,model,x,value,sd\ndrag,recording,0,0.3,0.1\n"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 4 * 3 * 6) << "four curves of three places; the recording and five models";
}

TEST(Pictures, TableHasARowPerValue) {
  const std::string csv = pictures_csv(with_pictures());
  EXPECT_THAT(csv, testing::StartsWith("picture,model,x,y,value,sd\nneighbour_density,recording,"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n') % 6, 1) << "a heading; the recording and five models";
}

}  // namespace
}  // namespace swarmfit
