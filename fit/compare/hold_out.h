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

// Scores the ranked models of a comparison of the first half on the second, under held_out_conditions(): FitResult::held_out. `fitted` and
// the weighting are those of the comparison.
void fill_held_out(Comparison& result, const Halves& halves, const CompareOptions& options, const Conditions& fitted,
                   const Weighting& weighting, const Runtime& runtime = {});

}  // namespace swarmfit
