// SPDX-License-Identifier: MIT
// How sure is a ranking? Every fitted model makes recordings as long as the real one, and those are scored as it was: a parametric
// bootstrap without refitting (Efron and Tibshirani 1993, section 6.5; Davison and Hinkley 1997, section 4.2).
#pragma once

#include "fit/objective.h"
#include "fit/results.h"
#include "libeval/confidence_set.h"
#include "libeval/score.h"

namespace swarmfit {

// What one fitted model makes of the conditions, in single runs that no search has seen. Models of one comparison share the seeds.
using Law = std::vector<SingleRun>;
Law law_of(const Objective& objective, const std::vector<double>& parameters, const Rng& root, int recordings);

// Scores of all models, and those they get on each recording of the first model's law: every model is represented by `pooled` other runs of
// its law, so that the scatter holds that of the recording and that of the simulations. Models and laws in the same order; NaN where the
// recording or a score is undefined.
ScoreDraws score_draws(const std::vector<FitResult>& models, const std::vector<Law>& laws, const Target& target, const Weighting& weighting,
                       int pooled);

// Fills FitResult::certainty of models that are ranked. With fewer than `pooled` + 2 recordings per law, everything stays undefined.
//
// - goodness_p: of the recordings of its own law, the share that is as far from the model as the real one is, in the weighted energy; at
//   least 1/(1 + recordings). The model was fitted to the real one, which lies nearer for that: small values are trustworthy, others
//   flatter.
// - group, set_p: by the model confidence set at 95 %.
// - lower, upper: the basic bootstrap interval, over recordings of the best model's law.
// - own: mean over its own recordings.
void fill_certainty(std::vector<FitResult>& models, const std::vector<Law>& laws, const Target& target, const Weighting& weighting,
                    int pooled);

}  // namespace swarmfit
