// SPDX-License-Identifier: MIT
// Is a model as good on what it was not fitted to? Parameters and weights come from the first half of a recording, scores from the second.
#pragma once

#include "fit/compare/certainty.h"
#include "fit/compare/compare.h"

namespace swarmfit {

// Equally long, so that energies can be compared: distances between histograms shrink with the number of samples. Between them the time
// after which motion is new is left out: L / V, or the correlation time of velocities (libeval/nearness.h) if that is longer.
struct Halves {
  Tracks fitted{}, held_out{};
};

// Throws InputError if the recording has fewer than 64 frames besides what is left out.
Halves halves(const Tracks& recording);

HoldOutFacts facts_of(const Halves& halves);

// Scores models that are fitted to the first half, and ranked there, on the second, under held_out_conditions(). `fitted` and the weighting
// are those of the comparison.
std::vector<HeldOut> held_out(const std::vector<ModelFit>& models, const Halves& halves, const CompareOptions& options,
                              const Conditions& fitted, const Weighting& weighting, const Runtime& runtime = {});

}  // namespace swarmfit
