// SPDX-License-Identifier: MIT
#include "fit/model_fit/search_plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <vector>

#include "libtrack/error.h"

namespace swarmfit {
namespace {

const std::array<Budget, 3> kBudgets{{
    // name      search          selection     confirmation, final, passes
    {"quick", {24, 40, 2}, {10, 14, 6}, 24, 24, 3},
    {"default", {40, 66, 3}, {16, 20, 12}, 48, 32, 6},
    {"thorough", {80, 124, 5}, {40, 30, 24}, 64, 48, 10},
}};

}  // namespace

std::span<const Budget> budgets() { return kBudgets; }

Budget budget_named(const std::string& name) {
  std::vector<std::string> names;
  for (const auto& b : kBudgets) {
    if (b.name == name) return b;
    names.push_back(b.name);
  }
  throw InputError(fmt::format("`budget` {}: no such budget; expected one of {}", name, fmt::join(names, ", ")));
}

}  // namespace swarmfit
