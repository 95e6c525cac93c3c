// SPDX-License-Identifier: MIT
#pragma once

#include "reports/comparison/paper_tables.h"
#include "reports/write/html_table.h"

namespace swarmfit {

// A table for print as one for the screen, which sorts by its headings: the first column names the row, the others are numbers unless the
// table's `align` says otherwise.
HtmlTable on_screen(const PaperTable&, bool best_first = false);

}  // namespace swarmfit
