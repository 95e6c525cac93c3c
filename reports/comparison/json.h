// SPDX-License-Identifier: MIT
// Results as JSON: docs/results_schema.md documents every key.
//
// Equal values give equal bytes: keys in a fixed order, numbers in a text that reads back as the same double, undefined numbers null, and
// nothing about the time, the machine or the number of threads. Bytes that are not UTF-8 are replaced by U+FFFD.
#pragma once

#include <string>
#include <vector>

#include "fit/results/comparison.h"
#include "libeval/evaluation.h"
#include "libeval/summary.h"
#include "reports/write/list_text.h"

namespace swarmfit {

std::string to_json(const Comparison&);                                       // "swarmfit-results/1": results.json
std::string to_json(const Evaluation&);                                       // "swarmfit-evaluation/1": swarmfit evaluate --json
std::string to_json(const WeighedTable&);                                     // "swarmfit-weights/1": swarmfit weigh --json
std::string to_json(const TrackMeta&, const Summary&);                        // "swarmfit-summary/1": swarmfit describe --json
std::string to_json(const std::string& what, const std::vector<ListEntry>&);  // "swarmfit-list/1": swarmfit models --json

}  // namespace swarmfit
