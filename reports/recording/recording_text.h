// SPDX-License-Identifier: MIT
// Recordings as text for the terminal. Pure functions: the program prints what they return. Names and paths of unknown origin are shown
// without control characters.
#pragma once

#include <string>

#include "libeval/evaluation.h"
#include "libeval/summary.h"
#include "libtrack/tracks.h"
#include "reports/write/text_table.h"

namespace swarmfit {

std::string describe_text(const TrackMeta&, const Summary&, TextStyle);  // what is in a recording and what is wrong with it
std::string first_rows_text(const Tracks&, TextStyle);                   // five rows as understood: individual, frame, time, position
std::string evaluation_text(const Evaluation&, TextStyle);               // energies and what lies behind them

}  // namespace swarmfit
