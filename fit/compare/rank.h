// SPDX-License-Identifier: MIT
// Where models stand under the weights of a comparison.
#pragma once

#include <vector>

#include "fit/compare/certainty.h"
#include "fit/results/model_fit.h"

namespace swarmfit {

// Score and normalised energies; whatever needs the others is not known yet.
Standing standing_of(const FinalRuns& runs, const Weighting& weighting);

// Puts models, and their laws and search scatter, in order of score, and numbers them; undefined scores come last, without a rank. The best
// model's law becomes the recordings that are scored.
void rank(std::vector<ModelFit>& models, Laws& laws);

std::vector<Scored> scored(const std::vector<ModelFit>& models);

}  // namespace swarmfit
