// SPDX-License-Identifier: MIT
#include "reports/recording/evaluation_html.h"

#include <gmock/gmock.h>

#include <cmath>

#include "reports/recording/evaluation_words.h"
#include "tests/reports/sample.h"

namespace swarmfit {
namespace {

using testing::HasSubstr;
using testing::Not;

struct Pair {
  Evaluation evaluation;
  PairPortrait portrait;
};

// The sample's recording against its second model.
Pair sample() {
  Pair out;
  Evaluation& e = out.evaluation;
  Comparison& c = out.portrait.comparison;
  c = sample_comparison();
  c.run.command = "evaluate";
  c.models = {c.models[1]};
  c.models.front().model = "simulation";
  c.models.front().runs.raw_energies = e.raw_energies = {0.5, 0.25, 1.5, NAN, 0.75, 1, 1.25};
  e.real = c.film.meta();
  e.simulated = c.models.front().film.meta();
  e.real.from.path = c.recording.data.path;
  e.simulated.from.path = "simulated.csv";
  e.axis_lower = c.recording.axis_lower;
  e.axis_width = c.recording.axis_width;
  e.real_distribution = c.recording.distributions;
  e.simulated_distribution = c.models.front().runs.distributions;
  e.real_order = {0.125, 0.25, 131};
  e.simulated_order = {0.875, 0.5, 147};
  out.portrait.simulation = c.recording.data;
  out.portrait.simulation.path = "simulated.csv";
  out.portrait.simulation.synthetic = true;
  return out;
}

std::string page_of(const Pair& p) {
  return evaluation_html(p.evaluation, p.portrait, "swarmfit evaluate swarm.txt simulated.csv", "1.2.3");
}

TEST(EvaluationPage, AnswersInWords) {
  Pair p = sample();
  EXPECT_EQ(evaluation_sentence(p.evaluation),
            "Most similar in acceleration (energy 0.250), least similar in angular velocity (energy 1.500).");
  EXPECT_THAT(page_of(p),
              HasSubstr("<h1>Most similar in acceleration (energy 0.250), least similar in angular velocity (energy 1.500).</h1>"));
  EXPECT_THAT(page_of(p), HasSubstr("<p class=\"lead\">Energy: 0 for the same distribution, 20 for disjoint ones.</p>"));
  EXPECT_THAT(page_of(p), HasSubstr("<dd>simulated.csv (synthetic)</dd>"));
  p.evaluation.raw_energies.fill(NAN);
  EXPECT_EQ(evaluation_sentence(p.evaluation), "No metric is defined in both.");
  p.evaluation.raw_energies[0] = 1;
  EXPECT_EQ(evaluation_sentence(p.evaluation), "Compared in one metric: speed (energy 1.000).");
}

TEST(EvaluationPage, ShowsEnergiesOrderAndBothSides) {
  const std::string page = page_of(sample());
  EXPECT_THAT(
      page, HasSubstr("<td>a</td><th scope=\"row\" class=\"name\">acceleration</th><td class=\"n\">0.250</td><td><svg class=\"interval\""));
  EXPECT_THAT(page, HasSubstr("<td class=\"n\">–</td><td></td>")) << "an undefined energy has no place";
  EXPECT_THAT(page, HasSubstr(">polarisation</th><td class=\"n\">0.125</td><td class=\"n\">0.875</td>"));
  EXPECT_THAT(page, HasSubstr(">tracks</th>"));
  EXPECT_THAT(page, HasSubstr("<figcaption>energy 1.500</figcaption>"));
}

TEST(EvaluationPage, HasPlayerChartsMethodsAndCommand) {
  const std::string page = page_of(sample());
  EXPECT_THAT(page, HasSubstr("class=\"player\""));
  EXPECT_THAT(page, HasSubstr("\"title\":\"recording\""));
  EXPECT_THAT(page, HasSubstr("\"title\":\"simulation\""));
  EXPECT_THAT(page, HasSubstr("Both begin at their own first frame"));
  EXPECT_THAT(page, Not(HasSubstr("final simulation")));
  for (const char* key : {"v", "a", "omega", "alpha", "mu", "d", "eta"})
    EXPECT_THAT(page, HasSubstr("<canvas id=\"pdf-" + std::string(key) + '"'));
  EXPECT_THAT(page, HasSubstr("The charts need JavaScript"));
  EXPECT_THAT(page, HasSubstr("simulated.csv was compared with swarm.txt by swarmfit 1.2.3."));
  EXPECT_THAT(page, HasSubstr("10.1371/journal.pone.0155698"));
  EXPECT_THAT(page, HasSubstr("<code>swarmfit evaluate swarm.txt simulated.csv</code>"));
  EXPECT_THAT(page, Not(HasSubstr("{{")));
}

TEST(EvaluationPage, SaysWhoseVelocitiesAreMeasured) {
  Pair p = sample();
  EXPECT_THAT(page_of(p), Not(HasSubstr("Velocities are the files")));
  p.portrait.comparison.recording.observation.velocity = "recorded";
  EXPECT_THAT(page_of(p), HasSubstr("Velocities are the files&#39; own."));
}

TEST(EvaluationPage, HostileTextStaysText) {
  constexpr const char* kHostile = "</title></script><img src=x onerror=\"alert('1')\">";
  Pair p = sample();
  p.portrait.comparison.recording.data.path = p.portrait.comparison.recording.data.unit = p.portrait.simulation.path = kHostile;
  p.portrait.simulation.notes = {kHostile};
  p.portrait.simulation.columns = p.evaluation.real.unit = p.evaluation.simulated.from.path = kHostile;
  const std::string page = evaluation_html(p.evaluation, p.portrait, kHostile, kHostile);
  EXPECT_THAT(page, Not(HasSubstr("<img")));
  EXPECT_THAT(page, HasSubstr("&lt;img src=x onerror=&quot;alert(&#39;1&#39;)&quot;&gt;"));
}

}  // namespace
}  // namespace swarmfit
