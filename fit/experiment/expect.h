// SPDX-License-Identifier: MIT
// What a scenario expects of its motion, held against a film of it.
#pragma once

#include <vector>

#include "fit/experiment/plant.h"

namespace swarmfit {

struct Finding {
  std::string name, measure;
  double value;         // NaN: it is not defined
  double above, below;  // what it should be, both included
  std::string published;
  bool met() const { return value >= above && value <= below; }
};

// One for each expectation, in order. Throws InputError "file:line:column: ..." on a measure that there is not.
std::vector<Finding> findings(const Scenario& scene, const Film& made);

// The same error without a film.
void check_expectations(const Scenario& scene);

}  // namespace swarmfit
