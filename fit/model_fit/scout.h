// SPDX-License-Identifier: MIT
// Where a search starts: parameters that regressions on simulations read off the recording.
#pragma once

#include <functional>

#include "fit/experiment/objective.h"
#include "fit/model_fit/search_space.h"
#include "fit/results/comparison.h"

namespace swarmfit {

// Told after every round how many simulations are done.
using OnScout = std::function<void(std::int64_t simulations)>;

// The median of an approximate posterior (fit/infer/posterior.h), first, and some of its sample; nothing if next to no simulation ended
// well. Searches of histogram distances see only how far off they are; regressions on what accelerations go with see
// in which direction, as gradient matching does, and unlike it not biased by localisation error, since simulations carry the same. All
// frames count: a start need not be unbiased.
std::vector<Point> scout(const SearchSpace& space, const Objective& objective, const Rng& rng, const ScoutSize& size,
                         const OnScout& on_scout = {});

}  // namespace swarmfit
