// SPDX-License-Identifier: MIT
// A model recovery as text, JSON, CSV, Markdown and LaTeX.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "fit/results/recovery.h"
#include "reports/comparison/paper_tables.h"
#include "reports/write/run_folder.h"
#include "reports/write/text_table.h"

namespace swarmfit {

std::string recovery_text(const Recovery&, TextStyle);             // both matrices
std::string table_text(const PaperTable&, TextStyle);              // aligned, without the caption
std::string to_json(const Recovery&, const Settings& conditions);  // "swarmfit-recovery/1"
std::string recovery_csv(const Recovery&);                         // one row per case and model: true_model, seed, rank, model, score, ...
PaperTable confusion_table(const Recovery&, const std::string& caption);   // "confusion"
PaperTable confidence_table(const Recovery&, const std::string& caption);  // "confidence": how often in the best group

// Both matrices as .md and .tex; the settings other than the models go into their captions.
void write_matrices(const std::string& dir, const Recovery&, const Settings& settings);

// Writes config.toml, tables/, report.html and recovery.json, which comes last; the page names the program's version. Throws as write_run.
void write_recovery(const std::string& dir, const Recovery&, const Settings& settings, const std::string& version);

}  // namespace swarmfit
