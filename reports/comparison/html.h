// SPDX-License-Identifier: MIT
// The report of a comparison: one HTML page that needs no network, no server and nobody's trust.
//
// Text that comes from data (paths, names, messages) is escaped; numbers for the charts travel as JSON in which "<" is written \u003c;
// the content policy of the page forbids everything but the style sheet and the scripts that were built in, by their hashes. Without
// JavaScript the tables tell the same as the charts.
#pragma once

#include <string>

#include "fit/results/comparison.h"

namespace swarmfit {

std::string report_html(const Comparison&);

}  // namespace swarmfit
