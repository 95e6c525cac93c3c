// SPDX-License-Identifier: MIT
// How one model is searched, whoever its rivals are.
#pragma once

#include <span>
#include <string>

#include "fit/experiment/conditions.h"
#include "fit/experiment/executor.h"
#include "fit/model_fit/search_space.h"
#include "fit/results/comparison.h"

namespace swarmfit {

// "quick", "default" or "thorough"; throws InputError naming them.
Budget budget_named(const std::string& name);
std::span<const Budget> budgets();

struct SearchPlan {
  ParameterRequests requests;
  ConditionOptions conditions;
  Budget budget = budget_named("default");
  std::uint64_t seed = 1;
  bool evolution_only = false;       // the genetic algorithm alone, and no search learns from another
  std::int64_t max_evaluations = 0;  // per model, over all passes; 0: none
};

}  // namespace swarmfit
