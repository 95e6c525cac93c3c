// SPDX-License-Identifier: MIT
// A parameter recovery as text, JSON, CSV, Markdown and LaTeX.
#pragma once

#include <string>

#include "fit/results/parameter_recovery.h"
#include "reports/study/recovery_report.h"

namespace swarmfit {

PaperTable coverage_table(const ParameterRecovery&, const std::string& caption);  // "coverage": one row per parameter
std::string parameter_recovery_text(const ParameterRecovery&, TextStyle);
std::string parameter_cases_csv(const ParameterRecovery&);                  // one row per recording and parameter
std::string to_json(const ParameterRecovery&, const Settings& conditions);  // "swarmfit-parameter-recovery/1"

// How many of the recordings intervals that hold the truth 95 times in 100 cover.
std::string coverage_band_text(const ParameterRecovery&);
// Whether whole posteriors, not only their intervals, are as wide as they should be.
std::string ranks_text(const ParameterRecovery&);
// " 3 more plants were left out: ..."; empty if none were.
std::string left_out_text(const ParameterRecovery&);

// Writes config.toml, tables/, report.html and recovery.json, which comes last; the page names the program's version. Throws as write_run.
void write_parameter_recovery(const std::string& dir, const ParameterRecovery&, const Settings& settings, const std::string& version);

}  // namespace swarmfit
