// SPDX-License-Identifier: MIT
// How good is a model on what it was not fitted to? Every model is fitted to each half of the recording and scored on the other: two-fold
// cross-validation in blocks of time (Roberts et al. 2017, doi:10.1111/ecog.02881).
#pragma once

#include "fit/compare/certainty.h"
#include "fit/compare/compare.h"

namespace swarmfit {

// A half, and before it the frames in which its simulations forget where they started. Those count in no score.
struct Half {
  Tracks tracks;  // these frames included
  std::int64_t warm_up = 0;
};

// Equally long, so that energies can be compared: distances between histograms shrink with the number of samples. Each has its own warm-up
// of the time after which motion is new: L / V, or the correlation time of velocities (libeval/nearness.h) if that is longer. That of the
// second lies between them, where it keeps them apart.
struct Halves {
  Half first, second;
};

// Throws InputError if a half would have fewer than 32 frames.
Halves halves(const Tracks& recording);

// Is a half longer than three times its warm-up, and long enough for halves()? Then a ranking can rest on them.
bool worth_halving(const Tracks& recording);

// The models in the order in which they were named.
struct HoldOut {
  HoldOutFacts facts;
  std::vector<double> scores;   // of the best fits, mean of both ways
  std::vector<HeldOut> models;  // goodness is not known yet
  std::vector<Trial> trials;    // one per way; their targets are below
  std::vector<std::unique_ptr<Target>> targets;
  std::vector<std::vector<std::vector<double>>> values;  // per model and fit: a value per row of its table
};

// Fits every half as often as the options say, and scores the best fit on the other half under weights of the fits, with lags, scales,
// localisation error and all else that is learned taken from the half that was fitted. Seeds differ from those of the fit to the whole
// recording.
HoldOut hold_out(const Tracks& recording, const CompareOptions& options, const OnCompareProgress& on_progress = {},
                 const Runtime& runtime = {});

}  // namespace swarmfit
