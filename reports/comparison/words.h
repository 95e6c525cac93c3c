// SPDX-License-Identifier: MIT
// What a comparison says, in words: shared by the terminal and the HTML report.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fit/results/comparison.h"

namespace swarmfit {

enum class Verdict {
  none,    // nothing could be scored
  single,  // one model: nothing to rank
  tie,     // at least one other model is in the winner's group
  clear,   // the winner is alone in its group
  open,    // ranked, but without groups
  walk,    // a random walk of the recording's own steps does as well
};

struct Headline {
  Verdict verdict = Verdict::none;
  std::string sentence;  // the answer: which model is best
  std::string detail;    // what to know before quoting it
};

Headline headline(const Comparison&);

// Does this column enter the score?
bool counts(const Comparison&, std::size_t column);
// Why it does not; empty if it does.
std::string why_left_out(const Comparison&, std::size_t column);
// Its symbol in a heading: in brackets if it does not enter the score, with a ~ if it is mostly measurement error.
std::string marked(const Comparison&, std::size_t column, const std::string& symbol);
// "~ mostly measurement error: ..."; empty if no column is.
std::string what_drowned_means(const Comparison&);

// What the letters, the interval and the p of the ranking mean; empty without these.
std::string what_ranks_mean(const Comparison&);

// What is played and drawn beside models: "recording"; "simulation" on the page of one.
std::string what_was_seen(const Comparison& c);

// The skill of the random walk, without an error where it is the zero of the scale.
std::string walker_skill(const Estimate& skill);

// Heads the warnings of one gravity.
std::string_view gravity_title(Gravity);

// "0.31"; "≤ 0.01" where no simulated recording fits the model so badly.
std::string fit_p(const Comparison&, const ModelFit&);

// What a skill of 1 and of 0 is: "1 = as close as …; 0 = no better than …"; empty where no model has one.
std::string what_skill_means(const Comparison&);
// The null that knows only steps, as a row of the ranking: its name, and its skill beside those of the models.
inline constexpr std::string_view kWalk = "random walk of its own steps";

// What every model has in its settings and no search has changed, with values and units: "a and b: radius 4.1 mm; c: tau 0.5 s"; empty if
// there is nothing.
std::string kept_fixed(const Comparison&);

// Simulation steps per frame of every model: "a 1; b 4; c takes one step per frame by definition".
std::string steps_taken(const Comparison&);

// Over which times motion is measured, and how much of that is measurement error.
std::string lags_measured(const Comparison&);
// Which lag carried the decision: "Lag 8 (0.08 s) carried 71 % of the weight, …. "; empty if there is only one.
std::string lag_weights(const Comparison&);

// "lag 8 (0.08 s)"
std::string lag_name(const Comparison&, int lag);

// The last part of a path: what lies before it is of one machine.
std::string file_name(const std::string& path);

// What was compared, and how: "Recording swarm.txt, protocol default, budget quick, seed 1, swarmfit 0.1.0.": captions end with it.
std::string origin(const Comparison&);

// Largest possible energy: that of disjoint distributions, 2M/(u2 - u1).
double worst_energy(const Binning&);

// "0.87 .. 0.95", the 95 % interval of the score over recordings; an en dash if unknown.
std::string score_interval(const ModelFit&);

// What the score is of: of the halves that were not fitted, or in sample.
std::string what_held_out_means(const Comparison&);

// "0.31 .. 0.42", between which the fits to halves put a parameter; kUndefined if there are none.
std::string halves_text(const ParameterResult&);

// "gamma 0.0086 (halves 0.0071 .. 0.0092) 1/s, ...": the fitted parameters of a model.
std::string fitted_values(const ModelFit&);

// "a" for the best group, whose models are not distinguishable, "b" for the next; empty if unknown.
std::string group_letter(const ModelFit&);

// "0.021 .. 0.034"; an en dash without a posterior.
std::string interval_text(const ParameterUncertainty&);
// "noise (-0.83)": the parameter with the strongest correlation, where that is 0.5 or more; empty otherwise.
std::string partner_text(const ParameterUncertainty&);
// The verdict; a parameter whose best value lies outside of its own interval is "inconsistent", whatever the interval says.
std::string verdict_text(const ParameterResult&);
std::string what_posteriors_mean();

// "quick", "quick, at most 150 candidates per model": what was asked for, in words.
std::string budget_text(const Comparison&);

// Names of the parameters that ended on a bound of their search.
std::vector<std::string> at_bounds(const ModelFit&);

// Names of the simple observables that contradict it.
std::vector<std::string> contradictions(const ModelFit&);

// Localisation error per axis, with the unit.
std::string sigma_text(const Comparison&);

// What a raw energy is, and between which numbers it lies.
std::string what_energy_means(const Comparison&);

}  // namespace swarmfit
