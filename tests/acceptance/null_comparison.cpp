// SPDX-License-Identifier: MIT
// The null test: recordings made by a model are compared with that model twice. Each must win as often as the other, and they must not be
// told apart. Too long for the default test run; by hand:
//   null_comparison MODEL [RECORDINGS] [AGENTS] [FRAMES] [BUDGET]
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "fit/study/recovery.h"

namespace swarmfit {
namespace {

struct Heat {
  int first = 0, equal = 0, together = 0, explained = 0;
};

// The same model under another name: searches of one model tell each other what they found, these do not.
const ModelSpec& again(const ModelSpec& spec) {
  static ModelSpec copy = spec;
  return copy;
}

Comparison compared_with_itself(const ModelChoice& model, std::uint64_t seed, int agents, std::int64_t frames, const char* budget) {
  const Scales scales{100, 70, 225};
  PlantOptions film;
  film.agents = agents;
  film.frames = frames;
  film.dt = 0.01;
  film.sigma = 0.1;
  film.unit = "mm";
  const auto truth = varied(model, planted_parameters(model, scales), scales, 2, seed);
  CompareOptions options;
  ModelChoice twin = model;
  twin.spec = &again(*model.spec);
  twin.name += "-again";
  options.models = {model, twin};
  options.budget = budget_named(budget);
  options.seed = seed;
  return compare(planted_recording(model, truth, film, scales, seed), with_shared_constants(options, scales));
}

}  // namespace
}  // namespace swarmfit

int main(int argc, char** argv) {
  using namespace swarmfit;
  if (argc < 2) return fmt::print(stderr, "null_comparison MODEL [RECORDINGS] [AGENTS] [FRAMES] [BUDGET]\n"), 2;
  const ModelChoice model = parse_model(argv[1]);
  const auto argument = [&](int k, int otherwise) { return argc > k ? std::atoi(argv[k]) : otherwise; };
  const int recordings = argument(2, 200);
  Heat tally;
  fmt::print("seed,lead,p,goodness_p_first,goodness_p_second\n");
  for (int k = 1; k <= recordings; ++k) {
    const Comparison c =
        compared_with_itself(model, static_cast<std::uint64_t>(k), argument(3, 10), argument(4, 120), argc > 5 ? argv[5] : "quick");
    const auto& best = c.models[0];
    const bool equal = c.models[0].standing.score == c.models[1].standing.score;
    tally.equal += equal;
    tally.first += !equal && best.model == model.name;
    tally.together += c.models[1].standing.certainty.group == 1;
    tally.explained += best.standing.certainty.gof_p > 0.05;
    fmt::print("{},{:.4f},{:.2f},{:.2f},{:.2f}\n", k, best.standing.score - c.models[1].standing.score,
               c.models[1].standing.certainty.set_p, best.standing.certainty.gof_p, c.models[1].standing.certainty.gof_p);
    std::fflush(stdout);
  }
  fmt::print("{} of {}: the first won {}, the second {}, equal {}; not told apart {}; explained {}\n", model.name, recordings, tally.first,
             recordings - tally.first - tally.equal, tally.equal, tally.together, tally.explained);
}
