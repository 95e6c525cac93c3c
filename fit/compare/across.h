// SPDX-License-Identifier: MIT
// The same models compared on several recordings: one summary (Ren et al. 2016, Figs 10, 13 and 15).
#pragma once

#include <span>

#include "fit/results/across.h"
#include "fit/results/comparison.h"

namespace swarmfit {

// All comparisons must be of the same models. Scores of different recordings are normalised differently (p1, p2), so ranks are what can be
// averaged; mean scores are shown because the paper shows them. Leads are paired within recordings; their intervals hold together (the
// level is shared among the models behind the first, after Bonferroni) and say what to expect of other recordings like these, if these were
// picked at random.
Across across(std::span<const Comparison> comparisons);

// Student's t interval of the mean of the values that are defined, at 1 - alpha; fewer than two give no interval.
MeanOverRecordings mean_over_recordings(std::span<const double> values, double alpha);

}  // namespace swarmfit
