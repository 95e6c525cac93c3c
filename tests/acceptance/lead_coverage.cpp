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
  s.options.conditions.error = ConditionOptions::Error::none;
  s.options = with_shared_constants(s.options, kScales);
  return s;
}

struct Lead {
  double held_out, lower, upper;  // of the first model named over the second
  double truth;                   // its mean on fresh recordings of the halves, both models as fitted
};

Lead lead_of(const Scene& s) {
  const Halves parts = halves(s.recording);
  HoldOut held = hold_out(s.recording, s.options);
  const int pooled = s.options.budget.final_replicates;
  Lead out{held.scores[0] - held.scores[1], NAN, NAN, 0};
  std::vector<Trial> fresh = held.trials, ranked;
  for (std::size_t way = 0; way < fresh.size(); ++way) {
    const Half &fit = way == 0 ? parts.first : parts.second, &other = way == 0 ? parts.second : parts.first;
    Conditions fitted = make_conditions(fit.tracks, s.options.conditions, fit.warm_up);
    fitted.metrics.lags = lags_of(held.facts.ways[way].columns);
    Conditions planted = held_out_conditions(other.tracks, fitted, other.warm_up);
    planted.reference = std::make_shared<const Tracks>();  // planted swarms stay at the origin
    Trial& trial = fresh[way];
    trial.bootstraps.recordings = bootstrap_of(Objective(s.options.models[0], planted, *trial.target), s.truth, {4711 + way}, kFresh);
    trial.bootstraps.scatter = {0, 0};
    const ScoreDraws draws = score_draws(trial, pooled);
    out.truth += (draws.draws.col(0) - draws.draws.col(1)).mean() / static_cast<double>(fresh.size());
    ranked.push_back(in_order(held.trials[way], out.held_out >= 0 ? Order{0, 1} : Order{1, 0}));
  }
  const Certainty second = certainties(ranked, pooled)[1];
  out.lower = second.lead_lower, out.upper = second.lead_upper;
  if (out.held_out < 0) std::tie(out.lower, out.upper) = std::pair(-out.upper, -out.lower);
  return out;
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
  fmt::print("seed,lead_held_out,lower,upper,true_lead\n");
  for (int k = first_seed; k < first_seed + recordings; ++k) {
    const Lead lead = lead_of(scene(planted, other, static_cast<std::uint64_t>(k), argc > 4 ? std::atoi(argv[4]) : 280));
    held += lead.lower <= lead.truth && lead.truth <= lead.upper;
    fmt::print("{},{:.4f},{:.4f},{:.4f},{:.4f}\n", k, lead.held_out, lead.lower, lead.upper, lead.truth);
    std::fflush(stdout);
  }
  fmt::print("{} of {} intervals hold the true lead\n", held, recordings);
}
