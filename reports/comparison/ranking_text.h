// SPDX-License-Identifier: MIT
// Rankings as text for the terminal. Pure functions: the program prints what they return. Names and paths of unknown origin are shown
// without control characters.
#pragma once

#include <string>

#include "fit/results/comparison.h"
#include "libeval/evaluation.h"
#include "reports/write/text_table.h"

namespace swarmfit {

enum class Detail { few, all };

// The answer in a sentence, the ranking, and the three gravest warnings. With all: also energies and weights, distributions, a few
// observables that were not fitted, posteriors, what was left out and why, and all warnings by gravity.
std::string ranking_text(const Comparison&, TextStyle, Detail detail = Detail::few);

std::string weights_text(const WeighedTable&, TextStyle);  // entropy weights and scores of a table

}  // namespace swarmfit
