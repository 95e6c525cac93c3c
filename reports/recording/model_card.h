// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "fit/results/comparison.h"
#include "reports/write/html_table.h"

namespace swarmfit {

// A model with its parameters, as a page introduces it.
struct ModelCard {
  std::string name, summary, citation;
  std::vector<ParameterResult> parameters;
};

// One sentence, where it is published, and the table of parameters, folded in.
Html model_card(const ModelCard&);

}  // namespace swarmfit
