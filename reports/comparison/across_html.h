// SPDX-License-Identifier: MIT
// The page of a comparison on several recordings: one summary, and the way to every recording's own report. No scripts; see html.h for
// what is escaped.
#pragma once

#include <string>
#include <vector>

#include "fit/results/across.h"

namespace swarmfit {

// Where a recording's own report lies, and what it says.
struct RecordingPage {
  std::string folder;    // beside the page, holding report.html
  std::string sentence;  // the report's headline
};

// One sentence: who is first on how many recordings. And what to know before quoting it.
std::string across_sentence(const Across&);
std::string across_detail(const Across&);

// `pages`: one per recording, in their order.
std::string across_html(const Across&, const std::vector<RecordingPage>& pages, const std::string& version);

}  // namespace swarmfit
