// SPDX-License-Identifier: MIT
// Do the intervals of a lead hold it? Recordings made by one model are compared with it and another, fitted on the first half and scored on
// the second. The true lead is the mean over fresh recordings of the second half made by the planted model, in the place where it was
// planted, and not where the recordings lie. By hand:
//   lead_coverage PLANTED OTHER [RECORDINGS] [FRAMES] [FIRST_SEED]
#include <fmt/format.h>

#include <cstdlib>

#include "fit/compare/hold_out.h"
#include "fit/compare/rank.h"
#include "fit/experiment/objective.h"
#include "fit/study/recovery.h"
#include "libeval/lags.h"

namespace swarmfit {
namespace {

constexpr Scales kScales{100, 70, 225};
constexpr int kFresh = 99;

struct Scene {
  std::vector<double> truth;
  Tracks recording;
  CompareOptions options;
};

Scene scene(const ModelChoice& planted, const ModelChoice& other, std::uint64_t seed, std::int64_t frames) {
  PlantOptions film;
  film.agents = 10;
  film.frames = frames;
  film.dt = 0.01;
  film.unit = "mm";
  Scene s;
  s.truth = varied(planted, planted_parameters(planted, kScales), kScales, 2, seed);
  s.recording = planted_recording(planted, s.truth, film, kScales, seed);
  s.options.models = {planted, other};
  s.options.budget = budget_named("quick");
  s.options.seed = seed;
  s.options.hold_out = true;
  s.options.conditions.error = ConditionOptions::Error::none;
  s.options = with_shared_constants(s.options, kScales);
  return s;
}

// Mean lead of the first model over the second, both as fitted, on fresh recordings of the half that was held out.
double true_lead(const Scene& s, const Comparison& c) {
  const Halves parts = halves(s.recording);
  Conditions fitted = make_conditions(parts.fitted, s.options.conditions);
  fitted.metrics.lags = lags_of(c.recording.columns);
  const Conditions conditions = held_out_conditions(parts.held_out, fitted);
  Conditions planted = conditions;
  planted.reference = std::make_shared<const Tracks>();  // planted swarms stay at the origin
  const Target target(metric_samples(conditions.recording, conditions.metrics), s.options.binning);
  const Weighting w{{c.ranking.weights.begin(), c.ranking.weights.end()},
                    {c.ranking.p1.begin(), c.ranking.p1.end()},
                    {c.ranking.p2.begin(), c.ranking.p2.end()},
                    {}};
  Laws laws{law_of(Objective(s.options.models[0], planted, target), s.truth, {4711}, kFresh), {}, {0, 0}, {1}};
  for (const ModelFit& fit : c.models) {
    const ModelChoice model = parse_model(fit.model);
    laws.of.push_back(law_of(Objective(model, conditions, target), parameter_values(model, fit), {4712}, kFresh));
  }
  const ScoreDraws draws = score_draws(scored(c.models), laws, target, w, s.options.budget.final_replicates);
  return (draws.draws.col(0) - draws.draws.col(1)).mean();
}

}  // namespace
}  // namespace swarmfit

int main(int argc, char** argv) {
  using namespace swarmfit;
  if (argc < 3) return fmt::print(stderr, "lead_coverage PLANTED OTHER [RECORDINGS] [FRAMES] [FIRST_SEED]\n"), 2;
  const ModelChoice planted = parse_model(argv[1]), other = parse_model(argv[2]);
  const int recordings = argc > 3 ? std::atoi(argv[3]) : 200;
  const int first_seed = argc > 5 ? std::atoi(argv[5]) : 1;
  int held = 0;
  fmt::print("seed,first,lead_fitted,lead_held_out,lower,upper,true_lead\n");
  for (int k = first_seed; k < first_seed + recordings; ++k) {
    const Scene s = scene(planted, other, static_cast<std::uint64_t>(k), argc > 4 ? std::atoi(argv[4]) : 280);
    const Comparison c = compare(s.recording, s.options);
    const ModelFit &first = c.models[0], &second = c.models[1];
    const Certainty& there = second.standing.held_out.certainty;
    const double truth = true_lead(s, c);
    held += there.lead_lower <= truth && truth <= there.lead_upper;
    fmt::print("{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f}\n", k, first.model, first.standing.score - second.standing.score,
               first.standing.held_out.score - second.standing.held_out.score, there.lead_lower, there.lead_upper, truth);
    std::fflush(stdout);
  }
  fmt::print("{} of {} intervals hold the true lead\n", held, recordings);
}
