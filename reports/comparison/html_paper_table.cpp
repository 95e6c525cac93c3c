// SPDX-License-Identifier: MIT
#include "reports/comparison/html_paper_table.h"

#include "reports/comparison/words.h"
#include "reports/write/plain_text.h"

namespace swarmfit {

HtmlTable on_screen(const PaperTable& t, bool best_first) {
  const auto number = [&](std::size_t k) { return k < t.align.size() ? t.align[k] == 'r' : k > 0; };
  HtmlTable out(t.caption);
  out.sortable();
  std::vector<HtmlTable::Cell> head;
  for (std::size_t k = 0; k < t.head.size(); ++k) head.push_back(column(printable(t.head[k]), number(k)));
  out.head(head);
  for (const auto& row : t.rows) {
    std::vector<HtmlTable::Cell> cells{name_cell(escaped(printable(row.front())))};
    for (std::size_t k = 1; k < row.size(); ++k) cells.push_back(number(k) ? number_cell(row[k]) : text_cell(printable(row[k])));
    out.row(cells, best_first && &row == &t.rows.front() ? "first" : "");
  }
  return out;
}

}  // namespace swarmfit
