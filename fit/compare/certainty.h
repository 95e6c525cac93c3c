// SPDX-License-Identifier: MIT
// How sure is a ranking? Every fitted model makes recordings as long as the real one, and those are scored as it was: a parametric
// bootstrap without refitting (Efron and Tibshirani 1993, section 6.5; Davison and Hinkley 1997, section 4.2).
#pragma once

#include <span>
#include <vector>

#include "fit/experiment/objective.h"
#include "fit/results/comparison.h"
#include "libeval/confidence_set.h"
#include "libeval/score.h"
#include "libtrack/nan.h"

namespace swarmfit {

// What one fitted model makes of the conditions, in single runs that no search has seen. Models of one comparison share the seeds.
using Bootstrap = std::vector<SingleRun>;
Bootstrap bootstrap_of(const Objective& objective, const std::vector<double>& parameters, const Rng& root, int recordings);

// How exactly the searches find what they look for: per model, the standard deviation of its score between searches, from the changes of
// the score (under the final weights) between what one calibration pass selected and the next; at least the median of all models. 0 where
// no search was repeated. selections: per model and pass, raw energies.
std::vector<double> search_scatter(const std::vector<std::vector<Energies>>& selections, const Weighting& weighting);

// A model's score, and the raw energies behind it.
struct Scored {
  double score = kNaN;
  Energies raw{};
};

// What scores are drawn from; models in the same order throughout.
struct Bootstraps {
  Bootstrap recordings;  // that are scored: those of the best model
  std::vector<Bootstrap> of;
  std::vector<double> scatter;
  Rng root;  // of the errors of the searches
};

// One recording on which models are scored; they stand in the same order throughout.
struct Trial {
  std::vector<Scored> models;
  Bootstraps bootstraps;
  const Target* target;
  Weighting weighting;
};

// Scores of all models, and those they get on each of the recordings: every model is represented by `pooled` other runs of its own, and has
// missed its best parameters by a normal error of its scatter. So the draws scatter as the recording, the simulations and the searches do.
// NaN where the recording or a score is undefined.
ScoreDraws score_draws(const Trial& trial, int pooled);

// Where single recordings of a model lie, bin by bin; empty with fewer than 39, of which the outermost would be the ends.
Band band_of(const Bootstrap& bootstrap, const Target& target);

// How sure is each model? Leads are those of the first. Of several trials with the same models, such as two halves of a recording, it is
// asked for the mean score. With fewer than `pooled` + 2 recordings per model, everything stays undefined.
//
// - gof_p: of its own recordings, the share that is as far from the model as the real one is, in the weighted energy; at
//   least 1/(1 + recordings). A model that was fitted to the real one lies nearer for that, but the search misses the best
//   parameters by some of its scatter, and would those of its own recordings; where it misses by more, p is small even for a model that
//   made the recording (docs/certainty.md). Recordings of a model without chance hardly differ: where they scatter by less than kUnseen of
//   the worst energy, the rest of that does not count against the model.
// - gof_q: the same, adjusted for as many tests as there are models.
// - group, set_p: by the model confidence set at 95 %.
// - lower, upper, lead_lower, lead_upper: basic bootstrap intervals, an eighth wider since the model is fitted.
// - own: mean over its own recordings; of one trial only, since others may have other columns.
std::vector<Certainty> certainties(std::span<const Trial> trials, int pooled);

}  // namespace swarmfit
