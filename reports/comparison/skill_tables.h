// SPDX-License-Identifier: MIT
// The tables of what stands beside the score, in the format of reports/comparison/tables.h.
#pragma once

#include "reports/comparison/tables.h"

namespace swarmfit {

//   skill.csv          one row per model and metric: distance to the recording, its floor and null; per model as metric "all" the means
//                      over the metrics of the skill, and the skill
//   leave_one_out.csv  one row per model left out and model ranked without it
//   panel.csv          one row per recording or model and observable that was not fitted
//   vacf.csv           velocity autocorrelation: one row per lag, one column per recording or model
std::vector<NamedTable> skill_tables(const Comparison&);

}  // namespace swarmfit
