// SPDX-License-Identifier: MIT
// Distributions in a line of text: ▁▃▆█▅▂▁▁, each scaled to its own peak.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "libeval/energy.h"
#include "libeval/summary.h"
#include "reports/write/text_table.h"

namespace swarmfit {

// One character per count, the largest ████ high; an en dash if all are zero or there are none.
std::string sparkline(const std::vector<std::uint64_t>& counts);

// What is drawn on common axes, a row each, the recording first. Pointers must outlive the call.
struct Shapes {
  struct Row {
    std::string name;
    const PerColumn<Distribution>* distributions;
    Paint paint = Paint::plain;
  };
  std::vector<Row> rows;
  std::vector<Column> columns;
  PerColumn<double> axis_lower, axis_width;  // of the histograms
  std::string unit;                          // of length
};

// A table of the columns of one lag, which begin with `first`: sparklines on the part of the axis in which the recording can be seen, what
// lies beyond counted at its ends, and that part in the metric's unit. Not wider than 80 columns for names of at most 29. Empty without
// Unicode: there is nothing like it in ASCII.
std::string shapes_text(const Shapes&, std::size_t first, const std::string& title, TextStyle);

// Those of a recording by itself, from 5 to 95 %, after an empty line. Empty without Unicode.
std::string shapes_text(const Summary&, TextStyle);

// What to know before reading such a table.
std::string what_shapes_mean(const Binning&);

}  // namespace swarmfit
