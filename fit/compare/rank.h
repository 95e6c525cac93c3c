// SPDX-License-Identifier: MIT
// Where models stand under the weights of a comparison.
#pragma once

#include <utility>
#include <vector>

#include "fit/compare/certainty.h"
#include "fit/results/comparison.h"

namespace swarmfit {

// Score in sample, which is what decides until something else does, and normalised energies; whatever needs the others is not known yet.
Standing standing_of(const FinalRuns& runs, const Weighting& weighting);

// Numbers of the models by score, best first; undefined scores come last.
using Order = std::vector<std::size_t>;
Order order_by_score(const std::vector<ModelFit>& models);

template <class T>
std::vector<T> in_order(std::vector<T> values, const Order& order) {
  std::vector<T> out;
  for (const std::size_t k : order) out.push_back(std::move(values[k]));
  return out;
}

// The best model's own recordings are those that are scored.
Trial in_order(Trial trial, const Order& order);

// Ranks of models that stand in order, and of their scores in sample; none for undefined scores.
void number(std::vector<ModelFit>& models);

}  // namespace swarmfit
