// SPDX-License-Identifier: MIT
#include "fit/compare/warnings.h"

#include <algorithm>

#include "fit/compare/facts.h"
#include "fit/compare/refute.h"
#include "fit/compare/skill_warnings.h"

namespace swarmfit {

std::vector<Warning> all_warnings(const Comparison& result) {
  std::vector<Warning> out;
  for (const auto& some : {warnings_of_skill(result), warnings_of_facts(result), warnings_of_learning(result), warnings_for(result)})
    out.insert(out.end(), some.begin(), some.end());
  std::stable_sort(out.begin(), out.end(), [](const Warning& a, const Warning& b) { return a.gravity < b.gravity; });
  return out;
}

}  // namespace swarmfit
