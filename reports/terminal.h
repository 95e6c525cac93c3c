// SPDX-License-Identifier: MIT
// Results as text for the terminal. Pure functions: the program prints what they return. Names and paths of unknown origin are shown
// without control characters.
#pragma once

#include <string>
#include <vector>

#include "fit/results.h"
#include "libeval/evaluation.h"
#include "libeval/summary.h"
#include "reports/text_table.h"
#include "reports/values.h"

namespace swarmfit {

// The ranked table: the answer in a sentence, then per model its score with interval and group, its skill and the raw energy of every
// metric; the weights beneath; a few observables that were not fitted; what was left out and why; warnings.
std::string ranking_text(const Comparison&, TextStyle);

std::string describe_text(const TrackMeta&, const Summary&, TextStyle);  // what is in a recording and what is wrong with it
std::string evaluation_text(const Evaluation&, TextStyle);               // energies and what lies behind them
std::string weights_text(const WeighedTable&, TextStyle);                // entropy weights and scores of a table
std::string list_text(const std::vector<ListEntry>&, TextStyle);         // models, scenarios, formats

}  // namespace swarmfit
