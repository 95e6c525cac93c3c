// SPDX-License-Identifier: MIT
// Rankings as text for the terminal. Pure functions: the program prints what they return. Names and paths of unknown origin are shown
// without control characters.
#pragma once

#include <string>

#include "fit/results/comparison.h"
#include "libeval/evaluation.h"
#include "reports/write/text_table.h"

namespace swarmfit {

// The ranked table: the answer in a sentence, then per model its score with interval and group, its skill and the raw energy of every
// metric; the weights beneath; a few observables that were not fitted; what was left out and why; warnings.
std::string ranking_text(const Comparison&, TextStyle);

std::string weights_text(const WeighedTable&, TextStyle);  // entropy weights and scores of a table

}  // namespace swarmfit
