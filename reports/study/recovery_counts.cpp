// SPDX-License-Identifier: MIT
#include "reports/study/recovery_counts.h"

#include <algorithm>

#include "fit/results/estimate.h"

namespace swarmfit::counts_of {
namespace {

// Recordings of the planted model of which `holds` is true.
template <class Holds>
int count(const Recovery& r, std::size_t planted, Holds holds) {
  return static_cast<int>(
      std::count_if(r.cases.begin(), r.cases.end(), [&](const RecoveryCase& c) { return c.planted == planted && holds(c); }));
}

// Is `holds` true of this model's place in the ranking?
template <class Holds>
bool of_model(const RecoveryCase& c, const std::string& model, Holds holds) {
  for (std::size_t k = 0; k < c.order.size(); ++k)
    if (c.order[k] == model) return holds(k);
  return false;
}

}  // namespace

int recordings(const Recovery& r, std::size_t planted) {
  return count(r, planted, [](const RecoveryCase&) { return true; });
}

int recovered(const Recovery& r, std::size_t planted) {
  return count(r, planted, [](const RecoveryCase& c) { return c.rank_of_planted == 1; });
}

int grouped(const Recovery& r, std::size_t planted) {
  return count(r, planted, [](const RecoveryCase& c) { return std::find(c.group.begin(), c.group.end(), 1) != c.group.end(); });
}

int in_best_group(const Recovery& r, std::size_t planted, const std::string& model) {
  return count(r, planted, [&](const RecoveryCase& c) { return of_model(c, model, [&](std::size_t k) { return c.group[k] == 1; }); });
}

int rejected(const Recovery& r, std::size_t planted, const std::string& model) {
  return count(r, planted, [&](const RecoveryCase& c) { return of_model(c, model, [&](std::size_t k) { return c.gof_p[k] <= kAlpha; }); });
}

}  // namespace swarmfit::counts_of
