// SPDX-License-Identifier: MIT
#include "reports/comparison/paper_tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "libtrack/file.h"
#include "reports/comparison/quantities.h"
#include "reports/comparison/words.h"
#include "reports/write/number.h"
#include "reports/write/text_table.h"

namespace swarmfit {
namespace {

using Row = std::vector<std::string>;

// The columns of one lag: a table of their own, since those of all would not fit a page.
struct Columns {
  std::string suffix, title;  // of the table's name and caption; empty for the first
  std::vector<std::size_t> of;
};

std::vector<Columns> by_lag(const Comparison& c) {
  std::vector<Columns> out;
  for (std::size_t first = 0; first < c.recording.columns.size(); first += out.size() == 1 ? kMetrics : kMotionMetrics) {
    const int lag = c.recording.columns[first].lag;
    const bool several = c.recording.columns.size() > kMetrics;
    out.push_back({first == 0 ? "" : fmt::format("_lag{}", lag), several ? fmt::format("Motion at {}. ", lag_name(c, lag)) : "", {}});
    const std::size_t count = std::min(first == 0 ? kMetrics : kMotionMetrics, c.recording.columns.size() - first);
    for (std::size_t m = first; m < first + count; ++m) out.back().of.push_back(m);
  }
  return out;
}

Row metric_head(const Comparison& c, const Columns& columns, Row head) {
  for (const std::size_t m : columns.of)
    head.push_back(counts(c, m) ? marked(c, m, c.recording.columns[m].symbol()) : c.recording.columns[m].symbol() + " (not scored)");
  return head;
}

template <class Value>
Row metric_row(const Columns& columns, std::string name, Value&& value) {
  Row row{std::move(name)};
  for (const std::size_t m : columns.of) row.push_back(value(m));
  return row;
}

std::string rank_text(int rank) { return rank > 0 ? std::to_string(rank) : kUndefined; }

PaperTable ranking(const Comparison& c) {
  PaperTable t{"ranking",
               "Models by entropy-weighted score E (higher is better), with its 95 % interval across recordings of this length, the group "
               "(models with the same letter are not distinguishable; model confidence set, 95 %), the goodness-of-fit p, and the skill. ",
               {"model"},
               {}};
  const auto columns = ranking_columns(c, Audience::page);
  for (const Quantity* q : columns) t.head.emplace_back(q->head);
  if (const std::string skill = what_skill_means(c); !skill.empty()) t.caption += "Skill: " + skill + ' ';
  t.caption += in_print(what_held_out_means(c)) + ' ';
  t.caption += origin(c);
  for (const ModelFit& r : c.models) {
    Row row = {r.model};
    for (const Quantity* q : columns) row.push_back(in_print(q->print(c, r, Audience::page)));
    t.rows.push_back(std::move(row));
  }
  const Estimate& walker = c.recording.skill.walker;
  if (std::isfinite(walker.value)) {
    Row row = {std::string(kWalk)};
    for (const Quantity* q : columns) row.push_back(q->key == "skill" ? in_print(walker_skill(walker)) : kUndefined);
    t.rows.push_back(std::move(row));
  }
  return t;
}

PaperTable scales(const Comparison& c) {
  PaperTable t{
      "scales",
      "Extent (root-mean-square radius), nearest-neighbour distance (NND) and mean speed of the recorded and the simulated groups. " +
          origin(c),
      {"model", fmt::format("extent [{}]", c.recording.data.unit), fmt::format("NND [{}]", c.recording.data.unit),
       fmt::format("speed [{}/s]", c.recording.data.unit)},
      {{"recording", rounded(c.recording.data.extent), rounded(c.recording.data.spacing), rounded(c.recording.data.speed)}}};
  for (const ModelFit& r : c.models)
    t.rows.push_back({r.model, rounded(r.likeness.extent), rounded(r.likeness.spacing), rounded(r.likeness.speed)});
  return t;
}

PaperTable energies(const Comparison& c, const Columns& columns) {
  PaperTable t{"energies" + columns.suffix,
               "Raw energies (" + what_energy_means(c) +
                   "), ± one standard error, their least value and range over the models (p1 and p2, which normalise them), and their "
                   "weights in the score. " +
                   columns.title + origin(c),
               metric_head(c, columns, {"model"}),
               {}};
  for (const ModelFit& r : c.models)
    t.rows.push_back(metric_row(columns, r.model, [&](std::size_t m) { return with_error(r.runs.raw_energies[m], r.runs.raw_se[m], 3); }));
  t.rows.push_back(metric_row(columns, "least (p1)", [&](std::size_t m) { return fixed(c.ranking.p1[m], 4); }));
  t.rows.push_back(metric_row(columns, "range (p2)", [&](std::size_t m) { return fixed(c.ranking.p2[m], 4); }));
  t.rows.push_back(
      metric_row(columns, "weight", [&](std::size_t m) { return counts(c, m) ? fixed(c.ranking.weights[m], 4) : kUndefined; }));
  return t;
}

PaperTable weights(const Comparison& c, const Columns& columns) {
  PaperTable t{
      "weights" + columns.suffix,
      "Entropy weights of the metrics, by pass of the calibration; the last row is used. " + lag_weights(c) + columns.title + origin(c),
      metric_head(c, columns, {"pass"}),
      {}};
  for (const WeightStep& s : c.ranking.weight_history)
    t.rows.push_back(metric_row(columns, std::to_string(s.pass), [&](std::size_t m) { return fixed(s.weights[m], 4); }));
  t.rows.push_back(metric_row(columns, "final", [&](std::size_t m) { return fixed(c.ranking.weights[m], 4); }));
  return t;
}

PaperTable parameters(const Comparison& c) {
  const bool posterior = std::any_of(c.models.begin(), c.models.end(), [](const ModelFit& r) { return r.posterior.simulations > 0; });
  PaperTable t{"parameters",
               fmt::format("Fitted parameters in physical units; * ended on a bound of the search.{}{} ",
                           c.recording.hold_out.used() ? " Halves: smallest and largest value of the fits to halves of the recording." : "",
                           posterior ? " 95 %: central interval of the posterior." : "") +
                   origin(c),
               {"model", "parameter", "symbol", "value", "halves", "95 %", "unit", "lower", "upper"},
               {},
               "lllrrrlrr"};
  for (const ModelFit& r : c.models)
    for (const ParameterResult& p : r.parameters)
      if (p.fitted)
        t.rows.push_back({r.model, p.name, p.symbol, in_print(rounded(p.value, 4)) + (p.at_bound ? " *" : ""), in_print(halves_text(p)),
                          in_print(interval_text(p.posterior)), unit_in_print(p.unit), in_print(rounded(p.lower)),
                          in_print(rounded(p.upper))});
  return t;
}

PaperTable sensitivity(const Comparison& c, const Columns& columns) {
  PaperTable t{"sensitivity" + columns.suffix,
               "Score and rank of every model when one metric is left out of the score; weights of the others keep their ratios. " +
                   columns.title + origin(c),
               metric_head(c, columns, {"model", "all"}),
               {}};
  for (const ModelFit& r : c.models) {
    Row row = metric_row(columns, r.model, [&](std::size_t m) {
      const Sensitivity& s = r.standing.sensitivity;
      return std::isfinite(s.without[m]) ? fmt::format("{} ({})", in_print(fixed(s.without[m], 3)), s.rank_without[m]) : kUndefined;
    });
    row.insert(row.begin() + 1,
               fmt::format("{} ({})", in_print(fixed(r.standing.in_sample.score, 3)), rank_text(r.standing.in_sample.rank)));
    t.rows.push_back(std::move(row));
  }
  return t;
}

std::string latex_row(const Row& cells) {
  Row escaped;
  for (const std::string& cell : cells) escaped.push_back(latex_text(cell));
  return fmt::format("    {} \\\\\n", fmt::join(escaped, " & "));
}

// One letter per column: the first to the left, the others to the right, if nothing else is said.
std::string alignment(const PaperTable& t) { return t.align.empty() ? 'l' + std::string(t.head.size() - 1, 'r') : t.align; }

// Does it need both columns of a page? By its longest cells.
bool wide(const PaperTable& t) {
  constexpr std::size_t kColumn = 56;  // characters in 85 mm
  std::size_t sum = 0;
  for (std::size_t k = 0; k < t.head.size(); ++k) {
    std::size_t longest = display_width(t.head[k]);
    for (const Row& row : t.rows) longest = std::max(longest, display_width(row[k]));
    sum += longest + 1;
  }
  return sum > kColumn;
}

}  // namespace

std::vector<PaperTable> paper_tables(const Comparison& c) {
  std::vector<PaperTable> out = {ranking(c), scales(c), parameters(c)};
  for (const Columns& columns : by_lag(c)) {
    out.push_back(energies(c, columns));
    out.push_back(weights(c, columns));
    out.push_back(sensitivity(c, columns));
  }
  return out;
}

std::string to_markdown(const PaperTable& t) {
  const auto line = [](const Row& cells) {
    std::string out = "|";
    for (const std::string& cell : cells) out += ' ' + markdown_text(cell) + " |";
    return out + '\n';
  };
  std::string out = line(t.head) + '|';
  for (const char side : alignment(t)) out += side == 'l' ? "---|" : "---:|";
  out += '\n';
  for (const Row& row : t.rows) out += line(row);
  return out + '\n' + markdown_text(t.caption) + '\n';
}

std::string to_latex(const PaperTable& t) {
  const std::string_view environment = wide(t) ? "table*" : "table";
  std::string out = fmt::format(
      "% needs \\usepackage{{booktabs}}\n\\begin{{{}}}\n  \\caption{{{}}}\n  \\label{{tab:{}}}\n  \\centering\n  "
      "\\footnotesize\\setlength{{\\tabcolsep}}{{3pt}}\n",
      environment, latex_text(t.caption), t.name);
  out += fmt::format("  \\begin{{tabular}}{{{}}}\n    \\toprule\n{}    \\midrule\n", alignment(t), latex_row(t.head));
  for (const Row& row : t.rows) out += latex_row(row);
  return out + fmt::format("    \\bottomrule\n  \\end{{tabular}}\n\\end{{{}}}\n", environment);
}

void write_table(const std::string& dir, const PaperTable& t) {
  write_file_atomically(dir + '/' + t.name + ".md", to_markdown(t));
  write_file_atomically(dir + '/' + t.name + ".tex", to_latex(t));
}

}  // namespace swarmfit
