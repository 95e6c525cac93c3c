// SPDX-License-Identifier: MIT
// The summary of one comparison on several recordings, as text, JSON, CSV, Markdown and LaTeX.
#pragma once

#include <string>
#include <vector>

#include "fit/results/across.h"
#include "reports/comparison/across_html.h"
#include "reports/comparison/paper_tables.h"
#include "reports/write/text_table.h"

namespace swarmfit {

std::string across_text(const Across&, TextStyle);    // models by mean rank, with rank and score on every recording
std::string to_json(const Across&);                   // "swarmfit-across/1"
std::string across_csv(const Across&);                // one row per model and recording: model, recording, rank, score
std::vector<PaperTable> paper_tables(const Across&);  // across_ranking, across_weights

// Writes tables/, report.html and summary.json of a run on several recordings; the runs themselves lie in folders of their own beside them.
// summary.json comes last. Throws RunError.
void write_across(const std::string& dir, const Across&, const std::vector<RecordingPage>& pages, const std::string& version);

}  // namespace swarmfit
