// SPDX-License-Identifier: MIT
// What there is to say of a recording, row by row: shared by the terminal and the page of describe.
#pragma once

#include <string>
#include <vector>

#include "libeval/summary.h"
#include "reports/write/text_table.h"

namespace swarmfit {

// What, how much, and a remark.
TextRows contents_rows(const TrackMeta&, const Summary&);
// The first row is the heading: what, median, 5 to 95 %, least and most, mean, standard deviation, unit, remark.
TextRows quantile_rows(const TrackMeta&, const Summary&);
std::string localisation_words(const TrackMeta&, const Localisation&);
std::string suspicion_words(const Suspicion&);

}  // namespace swarmfit
