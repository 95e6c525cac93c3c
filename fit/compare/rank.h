// SPDX-License-Identifier: MIT
// Where models stand in a comparison.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "fit/compare/certainty.h"
#include "fit/compare/hold_out.h"
#include "fit/results/comparison.h"

namespace swarmfit {

// Numbers of the models, best first.
using Order = std::vector<std::size_t>;

template <class T>
std::vector<T> in_order(std::vector<T> values, const Order& order) {
  std::vector<T> out;
  for (const std::size_t k : order) out.push_back(std::move(values[k]));
  return out;
}

// The best model's own recordings are those that are scored.
Trial in_order(Trial trial, const Order& order);

struct Ranked {
  Order order;                      // by the score that decides; undefined ones come last
  std::vector<Standing> standings;  // in that order
  Bootstrap of_first;
};

// What decides are the scores on the halves that were not fitted, or else those in sample. runs: the final ones of each model, in the order
// of the trial, which is in sample; pooled: how many there are.
Ranked ranked(const std::vector<FinalRuns>& runs, Trial in_sample, const std::optional<HoldOut>& held, int pooled);

}  // namespace swarmfit
