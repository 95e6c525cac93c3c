// SPDX-License-Identifier: MIT
#include "reports/comparison/quantities.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/comparison/words.h"
#include "reports/write/number.h"

namespace swarmfit {
namespace {

Value place(int number) { return number > 0 ? std::optional(number) : std::nullopt; }

std::int64_t fitted_parameters(const ModelFit& m) {
  return std::count_if(m.parameters.begin(), m.parameters.end(), [](const ParameterResult& p) { return p.fitted; });
}

std::string rank_and_group(const Comparison&, const ModelFit& m, Audience) {
  return m.standing.rank > 0 ? fmt::format("{} {}", m.standing.rank, group_letter(m)) : kUndefined;
}

// With its standard error where there is room.
std::string skill_text(const Comparison&, const ModelFit& m, Audience audience) {
  const Estimate& skill = m.likeness.skill;
  return audience == Audience::terminal ? fixed(skill.value, 2) : with_error(skill.value, skill.se, 2);
}

}  // namespace

// NOLINTNEXTLINE(readability-function-size): a table, one entry per quantity
const std::vector<Quantity>& quantities() {
  static const std::vector<Quantity> all = {
      {"rank", "1 is best", [](const ModelFit& m) { return place(m.standing.rank); }, "rank", Audience::terminal, rank_and_group},
      {"score", "E, the weighted score that decides: higher is better", [](const ModelFit& m) -> Value { return m.standing.score; },
       "score", Audience::terminal, [](const Comparison&, const ModelFit& m, Audience) { return fixed(m.standing.score, 3); }},
      {"score_ci", "95 % interval of the score across recordings of this length",
       [](const ModelFit& m) -> Value {
         return IntervalEnds{m.standing.certainty.lower, m.standing.certainty.upper};
       },
       "95 %", Audience::terminal, [](const Comparison&, const ModelFit& m, Audience) { return score_interval(m); }},
      {"lead_ci", "95 % interval of the first model's lead over this one",
       [](const ModelFit& m) -> Value {
         return IntervalEnds{m.standing.certainty.lead_lower, m.standing.certainty.lead_upper};
       }},
      {"group", "models of one group are not distinguishable; 1 is the best",
       [](const ModelFit& m) { return place(m.standing.certainty.group); }},
      {"set_p", "p at which the model leaves the model confidence set",
       [](const ModelFit& m) -> Value { return m.standing.certainty.set_p; }},
      {"gof_p", "goodness of fit: fraction of recordings simulated from the model that fit it no better than this one",
       [](const ModelFit& m) -> Value { return m.standing.certainty.gof_p; }, "fit p", Audience::terminal,
       [](const Comparison& c, const ModelFit& m, Audience) { return fit_p(c, m); }},
      {"gof_q", "gof_p, adjusted for the number of models (false discovery rate)",
       [](const ModelFit& m) -> Value { return m.standing.certainty.gof_q; }},
      {"skill", "1: as close as two halves of the recording, 0: no better than randomised tracks",
       [](const ModelFit& m) -> Value { return m.likeness.skill.value; }, "skill", Audience::terminal, skill_text},
      {"skill_se", "standard error of the skill over final replicates", [](const ModelFit& m) -> Value { return m.likeness.skill.se; }},
      {"in_sample.score", "score of the fit to the whole recording, on that recording",
       [](const ModelFit& m) -> Value { return m.standing.in_sample.score; }, "in sample", Audience::terminal,
       [](const Comparison&, const ModelFit& m, Audience) { return fixed(m.standing.in_sample.score, 3); }},
      {"in_sample.score_se", "its standard error, over single final replicates",
       [](const ModelFit& m) -> Value { return m.standing.in_sample.score_se; }},
      {"in_sample.rank", "rank by the score in sample", [](const ModelFit& m) { return place(m.standing.in_sample.rank); }},
      {"in_sample.group", "group of the scores in sample", [](const ModelFit& m) { return place(m.standing.in_sample.group); }},
      {"in_sample.score_ci", "95 % interval of the score in sample",
       [](const ModelFit& m) -> Value {
         return IntervalEnds{m.standing.in_sample.lower, m.standing.in_sample.upper};
       }},
      {"held_out.gap", "score in sample minus score on the halves that were not fitted",
       [](const ModelFit& m) -> Value { return m.standing.in_sample.score - m.standing.score; }},
      {"held_out.search_sd", "standard deviation of the score between searches of the same half",
       [](const ModelFit& m) -> Value { return m.standing.held_out.search_sd; }},
      {"held_out.gof_p", "goodness of fit on the halves that were not fitted",
       [](const ModelFit& m) -> Value { return m.standing.held_out.gof_p; }},
      {"held_out.simulations", "runs for the fits to halves, beside `simulations`",
       [](const ModelFit& m) -> Value { return m.standing.held_out.simulations; }},
      {"held_out.nearness",
       "median distance of the model's paths from the nearest path of the fitted half, divided by that of the held-out paths; far below 1: "
       "the model repeats what it has seen",
       [](const ModelFit& m) -> Value { return m.standing.held_out.nearness.ratio(); }},
      {"n_parameters", "parameters that were fitted", [](const ModelFit& m) -> Value { return fitted_parameters(m); }, "fitted",
       Audience::terminal, [](const Comparison&, const ModelFit& m, Audience) { return std::to_string(fitted_parameters(m)); }},
      {"evaluations", "candidates simulated", [](const ModelFit& m) -> Value { return m.search.evaluations; }, "candidates", Audience::page,
       [](const Comparison&, const ModelFit& m, Audience) { return counted(m.search.evaluations); }},
      {"simulations", "runs: candidates × replicates, the final ones included",
       [](const ModelFit& m) -> Value { return m.search.simulations; }},
      {"failed_simulations", "runs that diverged", [](const ModelFit& m) -> Value { return m.search.failed_simulations; }},
      {"failed_final", "share of the final replicates that diverged", [](const ModelFit& m) -> Value { return m.runs.failed_final; }},
      {"n_sub", "simulation steps per frame", [](const ModelFit& m) -> Value { return std::int64_t{m.runs.steps}; }},
      {"map", "a map: one step per frame by definition", [](const ModelFit& m) -> Value { return m.runs.map; }},
      {"steps_settled", "halving the time step changes no energy by more than chance",
       [](const ModelFit& m) -> Value { return m.runs.steps_settled; }},
      {"infeasible_avoidance", "share of agent-steps without a collision-free velocity",
       [](const ModelFit& m) -> Value { return m.runs.infeasible_avoidance; }},
      {"extent", "root-mean-square radius of the simulated group", [](const ModelFit& m) -> Value { return m.likeness.extent; }},
      {"spacing", "mean distance to the nearest neighbour in the simulated group",
       [](const ModelFit& m) -> Value { return m.likeness.spacing; }},
      {"speed", "mean speed of the simulated group", [](const ModelFit& m) -> Value { return m.likeness.speed; }},
      {"stop_reason", "why the search ended", [](const ModelFit& m) -> Value { return m.search.stop_reason; }},
  };
  return all;
}

bool known(const Quantity& quantity, const Comparison& c) { return c.recording.hold_out.used() || !quantity.key.starts_with("held_out."); }

std::vector<const Quantity*> ranking_columns(const Comparison& c, Audience audience) {
  std::vector<const Quantity*> out;
  for (const Quantity& q : quantities())
    if (q.first <= audience && q.first != Audience::nobody && known(q, c) && (q.key != "in_sample.score" || c.recording.hold_out.used()))
      out.push_back(&q);
  return out;
}

const std::vector<ColumnQuantity>& column_quantities() {
  using M = const ModelFit&;
  using P = const PerColumn<double>&;
  static const std::vector<ColumnQuantity> all = {
      {"raw_energies", "raw", "raw energy of the pooled final replicates", [](M m) -> P { return m.runs.raw_energies; }},
      {"raw_energies_se", "raw_se", "its standard error over single replicates", [](M m) -> P { return m.runs.raw_se; }},
      {"own_energies", "own", "mean raw energy of recordings simulated from the model: expected if it were true",
       [](M m) -> P { return m.standing.certainty.own; }},
      {"energies", "normalised", "(raw - p1)/p2, 0 where p2 = 0", [](M m) -> P { return m.standing.energies; }},
      {"half_step_energies", "half_step", "raw energy at half the time step", [](M m) -> P { return m.runs.half_step_energies; }},
      {"mean_ratio", "mean_ratio", "mean of the simulations over that of the recording", [](M m) -> P { return m.runs.mean_ratio; }},
      {"sd_ratio", "sd_ratio", "standard deviation of the simulations over that of the recording",
       [](M m) -> P { return m.runs.sd_ratio; }},
      {"outside_fraction", "outside_fraction", "share of the simulated samples outside the binned range",
       [](M m) -> P { return m.runs.outside_fraction; }},
      {"total_variation", "total_variation", "mean distance of single replicates from the recording, halves against halves",
       [](M m) -> P { return m.likeness.total_variation; }},
      {"wasserstein", "wasserstein", "the same as Wasserstein distance, in standard deviations of the recording",
       [](M m) -> P { return m.likeness.wasserstein; }},
  };
  return all;
}

}  // namespace swarmfit
