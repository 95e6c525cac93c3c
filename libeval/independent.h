// SPDX-License-Identifier: MIT
// How many independent samples is a recording worth?
#pragma once

#include "libeval/metrics.h"

namespace swarmfit {

// Effective sample size of each column: n / (1 + 2 sum of the autocorrelation), which says how well n correlated samples tell a mean
// (Priestley 1981, section 5.3.2). Autocorrelations are of each individual's own values along its unbroken runs, pooled over individuals
// and summed up to where two neighbouring lags first add up to nothing (the initial positive sequence: Geyer 1992,
// doi:10.1214/ss/1177011137), a third of the recording at most. Between individuals values are taken as independent, so it is an upper
// bound where a group moves as one. At least 1, at most n; NaN where the metric is undefined or constant.
PerColumn<double> independent_samples(const Tracks& tracks, const MetricOptions& options = {});

// The same of n values in runs of neighbours, about their common mean and with this variance, lags up to `longest`; NaN in a run: a gap.
double effective_size(const std::vector<std::vector<double>>& runs, double n, double variance, std::size_t longest);

}  // namespace swarmfit
