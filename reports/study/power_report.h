// SPDX-License-Identifier: MIT
// What a recording could tell apart, as text, JSON, CSV, Markdown and LaTeX.
#pragma once

#include <string>

#include "fit/results/power.h"
#include "reports/study/recovery_report.h"

namespace swarmfit {

std::string power_sentence(const Power&);                          // the answer in words
std::string power_text(const Power&, TextStyle);                   // that, both matrices, and the pairs
PaperTable pairs_table(const Power&, const std::string& caption);  // "pairs": one row per planted model and rival
std::string pairs_csv(const Power&);
std::string to_json(const Power&, const Settings& settings);  // "swarmfit-power/1"

// Writes config.toml, tables/, report.html and power.json, which comes last. Throws as write_run.
void write_power(const std::string& dir, const Power&, const Settings& settings);

}  // namespace swarmfit
