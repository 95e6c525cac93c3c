// SPDX-License-Identifier: MIT
#include "reports/study/recovery_sections.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/comparison/words.h"
#include "reports/study/recovery_counts.h"
#include "reports/write/number.h"
#include "reports/write/plain_text.h"

namespace swarmfit::sections {
namespace {

using Cells = std::vector<HtmlTable::Cell>;

constexpr int kShades = 5;  // as in report.css

// Which colour means right: large counts for the maker, or large counts for the others?
enum class Right { maker, others };

std::string shade(int n, int of, bool right) {
  if (n <= 0 || of <= 0) return "mid none";
  return fmt::format("mid {} q{}", right ? "right" : "wrong", (kShades * n + of - 1) / of);
}

struct Matrix {
  std::string caption, corner, last;
  Right right;
};

// `count` of a planted and a compared model, `last` of a planted one.
template <class Count, class Last>
Html matrix_html(const Recovery& r, const Matrix& m, Count count, Last last) {
  HtmlTable table(m.caption);
  Cells head{column(m.corner)};
  const auto centred = [&](const std::string& text) { head.push_back({.content = escaped(text), .head = true, .also = "mid"}); };
  for (const std::string& model : r.compared) centred(model);
  centred(m.last);
  table.head(head);
  for (std::size_t p = 0; p < r.planted.size(); ++p) {
    Cells cells{name_cell(escaped(r.planted[p]))};
    for (std::size_t k = 0; k < r.compared.size(); ++k) {
      const bool own = r.compared[k] == r.planted[p];
      const int n = count(p, k);
      const std::string look = shade(n, counts_of::recordings(r, p), own == (m.right == Right::maker));
      cells.push_back({.content = escaped(std::to_string(n)), .also = own ? look + " own" : look});
    }
    cells.push_back({.content = escaped(last(p)), .also = "mid"});
    table.row(cells);
  }
  return table.html();
}

std::string of_recordings(const Recovery& r, int n, std::size_t p) { return fmt::format("{} of {}", n, counts_of::recordings(r, p)); }

std::size_t own_place(const Recovery& r, std::size_t p) {
  return static_cast<std::size_t>(std::find(r.compared.begin(), r.compared.end(), r.planted[p]) - r.compared.begin());
}

// In how many recordings of one model another was in the best group: {how many, of how many}; {0, 0} if it made none.
struct Overlap {
  int both = 0, of = 0;
};

Overlap overlap(const Recovery& r, const std::string& maker, const std::string& other) {
  const auto found = std::find(r.planted.begin(), r.planted.end(), maker);
  if (found == r.planted.end()) return {};
  const auto p = static_cast<std::size_t>(found - r.planted.begin());
  return {counts_of::in_best_group(r, p, other), counts_of::grouped(r, p)};
}

std::string overlap_text(const Overlap& a) { return a.of > 0 ? fmt::format("{} of {}", a.both, a.of) : kUndefined; }

HtmlTable::Cell verdict(const Overlap& one, const Overlap& other) {
  if (one.of + other.of == 0) return text_cell(kUndefined);
  if (one.both + other.both == 0) return text_cell("distinguished");
  const bool mostly = 2 * one.both >= std::max(1, one.of) || 2 * other.both >= std::max(1, other.of);
  return {.content = element("b", "", escaped(mostly ? "not distinguished" : "sometimes not distinguished"))};
}

// Least and greatest planted value of one parameter.
struct Planted {
  double least, greatest;
};

Planted planted_range(const Recovery& r, std::size_t planted, std::size_t row) {
  Planted out{r.parameters[planted][row], r.parameters[planted][row]};
  bool first = true;
  for (const RecoveryCase& c : r.cases) {
    if (c.planted != planted) continue;
    const double value = c.parameters[row];
    out = first ? Planted{value, value} : Planted{std::min(out.least, value), std::max(out.greatest, value)};
    first = false;
  }
  return out;
}

// Were the parameters drawn anew for every recording?
bool drawn_anew(const Recovery& r, std::size_t p) {
  for (std::size_t k = 0; k < r.parameters[p].size(); ++k)
    if (const Planted range = planted_range(r, p, k); range.least < range.greatest) return true;
  return false;
}

Html parameter_table(const Recovery& r, std::size_t p) {
  const bool ranges = drawn_anew(r, p);
  HtmlTable table(fmt::format("True parameters of {}", r.planted[p]));
  Cells head{column("parameter"), column("symbol"), column(ranges ? "true value about" : "true value", true)};
  if (ranges) head.insert(head.end(), {column("least", true), column("greatest", true)});
  head.insert(head.end(), {column("unit"), column("meaning")});
  table.head(head);
  for (std::size_t k = 0; k < r.parameters[p].size(); ++k) {
    const PlantedRow& row = r.rows[p][k];
    if (!row.used) continue;
    const Planted range = planted_range(r, p, k);
    Cells cells{name_cell(escaped(row.name)), text_cell(row.symbol), number_cell(rounded(r.parameters[p][k], 4))};
    if (ranges) cells.insert(cells.end(), {number_cell(rounded(range.least, 4)), number_cell(rounded(range.greatest, 4))});
    cells.insert(cells.end(), {text_cell(unit_in_print(row.unit)), text_cell(row.meaning)});
    table.row(cells);
  }
  return table.html();
}

std::vector<std::string> best_group(const RecoveryCase& c) {
  std::vector<std::string> out;
  for (std::size_t k = 0; k < c.order.size(); ++k)
    if (c.group[k] == 1) out.push_back(c.order[k]);
  return out;
}

}  // namespace

Html confusion_matrix(const Recovery& r) {
  const Matrix m{"Rows: true model. Columns: how often each model was ranked first.", "true model \\ ranked first", "recovered",
                 Right::maker};
  return matrix_html(
      r, m, [&](std::size_t p, std::size_t k) { return r.confusion[p][k]; },
      [&](std::size_t p) { return of_recordings(r, counts_of::recovered(r, p), p); });
}

Html confidence_matrix(const Recovery& r) {
  const Matrix m{
      "Columns: how often each model was in the best group, that is, not distinguishable from the best (model confidence set, 95 %).",
      "true model \\ in the best group", "true model in it", Right::maker};
  const auto in_it = [&](std::size_t p, std::size_t k) { return counts_of::in_best_group(r, p, r.compared[k]); };
  return matrix_html(r, m, in_it, [&](std::size_t p) { return of_recordings(r, in_it(p, own_place(r, p)), p); });
}

Html rejection_matrix(const Recovery& r) {
  const Matrix m{"Columns: how often each model was rejected (goodness of fit, p ≤ 0.05).", "true model \\ rejected", "true model rejected",
                 Right::others};
  const auto rejected = [&](std::size_t p, std::size_t k) { return counts_of::rejected(r, p, r.compared[k]); };
  return matrix_html(r, m, rejected, [&](std::size_t p) { return of_recordings(r, rejected(p, own_place(r, p)), p); });
}

Html how_matrices_read() {
  return element(
      "p", "note",
      markup("Framed: the true model. <span class=\"swatch right q4\"></span> blue where large counts are right, <span class=\"swatch "
             "wrong q4\"></span> orange where they are wrong; the stronger the colour, the larger the share of the row's recordings."));
}

Html overlap_table(const Recovery& r) {
  HtmlTable table("Every pair of models: in how many recordings made by one of them the other was in the best group, too.");
  table.head({column("first"), column("second"), column("first is true", true), column("second is true", true), column("verdict")});
  for (std::size_t a = 0; a < r.compared.size(); ++a)
    for (std::size_t b = a + 1; b < r.compared.size(); ++b) {
      const Overlap one = overlap(r, r.compared[a], r.compared[b]), other = overlap(r, r.compared[b], r.compared[a]);
      table.row({name_cell(escaped(r.compared[a])), text_cell(r.compared[b]), number_cell(overlap_text(one)),
                 number_cell(overlap_text(other)), verdict(one, other)});
    }
  return table.sortable().html();
}

Html planted_parameters(const Recovery& r) {
  Html out;
  for (std::size_t p = 0; p < r.planted.size(); ++p) {
    out += Html{p == 0 ? "<details open>" : "<details>"};
    out += element("summary", "", escaped(r.planted[p]));
    out += parameter_table(r, p);
    out += markup("</details>\n");
  }
  return out;
}

Html cases_table(const Recovery& r) {
  HtmlTable table("Result of every recording");
  table.head({column("true model"), column("seed", true), column("ranked first"), column("its score", true),
              column("rank of the true model", true), column("its fit p", true), column("best group")});
  for (const RecoveryCase& c : r.cases) {
    const std::string& maker = r.planted[c.planted];
    const auto place = static_cast<std::size_t>(std::find(c.order.begin(), c.order.end(), maker) - c.order.begin());
    table.row({name_cell(escaped(maker)), number_cell(std::to_string(c.seed)), text_cell(c.order.front()),
               number_cell(fixed(c.scores.front(), 3)), number_cell(c.rank_of_planted > 0 ? std::to_string(c.rank_of_planted) : kUndefined),
               number_cell(place < c.gof_p.size() ? fixed(c.gof_p[place], 2) : kUndefined),
               text_cell(best_group(c).empty() ? kUndefined : enumerate(best_group(c)))});
  }
  Html out = markup("<details><summary>All recordings</summary>");
  out += table.sortable().html();
  out += markup("</details>\n");
  return out;
}

}  // namespace swarmfit::sections
