// SPDX-License-Identifier: MIT
// Tables of a comparison as a supplement prints them: rounded, in Markdown and in LaTeX (booktabs).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fit/results/comparison.h"
#include "reports/write/list_text.h"
#include "reports/write/paper_text.h"

namespace swarmfit {

// Cells are plain UTF-8 text; the first column is left-aligned, the others right-aligned, unless `align` says otherwise.
struct PaperTable {
  std::string name;     // "ranking": the file's name without extension
  std::string caption;  // one or two sentences that make it readable alone
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;  // each as long as head
  std::string align{};                         // "llr": a letter per column; empty: as said above
};

// ranking, scales, parameters, and per lag energies, weights and sensitivity (energies_lag4 beyond the first lag): the same numbers as the
// CSV tables, in the shape of Ren et al. 2016, Tables S1-S20.
std::vector<PaperTable> paper_tables(const Comparison&);

std::string to_markdown(const PaperTable&);
// A table environment, table* for one that is wider than a column; needs \usepackage{booktabs}. Text of any origin is shown as text.
std::string to_latex(const PaperTable&);

// DIR/NAME.md and DIR/NAME.tex.
void write_table(const std::string& dir, const PaperTable&);

}  // namespace swarmfit
