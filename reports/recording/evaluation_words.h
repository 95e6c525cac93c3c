// SPDX-License-Identifier: MIT
// What there is to say of an evaluation, row by row: shared by the terminal and the page.
#pragma once

#include <string>

#include "libeval/evaluation.h"
#include "reports/write/text_table.h"

namespace swarmfit {

// The first row is the heading: symbol, metric, energy, recording, simulation, mean ratio, sd ratio, unit.
TextRows energy_rows(const Evaluation&);
// Order parameters, likewise: what, recording, simulation.
TextRows order_rows(const Evaluation&);
std::string energy_words(const Evaluation&);  // between which numbers an energy lies
std::string lag_words(const Evaluation&);     // over which times motion is measured

// In which metric the two are most alike, and in which least.
std::string evaluation_sentence(const Evaluation&);

}  // namespace swarmfit
