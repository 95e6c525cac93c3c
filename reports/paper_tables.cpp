// SPDX-License-Identifier: MIT
#include "reports/paper_tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "libtrack/file.h"
#include "reports/number.h"
#include "reports/words.h"

namespace swarmfit {
namespace {

using Row = std::vector<std::string>;

Row metric_head(const Comparison& c, Row head) {
  for (std::size_t m = 0; m < c.columns.size(); ++m)
    head.push_back(counts(c, m) ? marked(c, m, c.columns[m].symbol()) : c.columns[m].symbol() + " (not scored)");
  return head;
}

template <class Value>
Row metric_row(const Comparison& c, std::string name, Value&& value) {
  Row row{std::move(name)};
  for (std::size_t m = 0; m < c.columns.size(); ++m) row.push_back(value(m));
  return row;
}

std::string with_error(double value, double error, int decimals) {
  const std::string text = fixed(value, decimals);
  return std::isfinite(error) ? text + " ± " + fixed(error, decimals) : text;
}

std::string rank_text(int rank) { return rank > 0 ? std::to_string(rank) : kUndefined; }

// What was compared with what, under which protocol: every caption ends with it.
std::string origin(const Comparison& c) {
  return fmt::format("Recording {}{}, protocol {}, budget {}, seed {}, swarmfit {}.", c.data.path, c.data.synthetic ? " (synthetic)" : "",
                     c.protocol, c.budget.name, c.seed, c.version);
}

PaperTable ranking(const Comparison& c) {
  PaperTable t{
      "ranking",
      "Models by entropy-weighted score E (higher is better), with its 95 % interval over recordings as long as this one, the group "
      "(models with the same letter cannot be told apart; model confidence set, 95 %), the goodness-of-fit p, and the extent, "
      "nearest-neighbour distance and mean speed of the simulated group. " +
          origin(c),
      {"model", "rank", "score", "95 %", "group", "fit p", fmt::format("extent [{}]", c.data.unit), fmt::format("NND [{}]", c.data.unit),
       fmt::format("speed [{}/s]", c.data.unit), "candidates"},
      {}};
  for (const FitResult& r : c.models)
    t.rows.push_back({r.model, rank_text(r.rank), fixed(r.score, 3), score_interval(r), group_letter(r), fixed(r.certainty.goodness_p, 2),
                      rounded(r.extent), rounded(r.spacing), rounded(r.speed), std::to_string(r.evaluations)});
  t.rows.push_back({"recording", "", "", "", "", "", rounded(c.data.extent), rounded(c.data.spacing), rounded(c.data.speed), ""});
  return t;
}

PaperTable energies(const Comparison& c) {
  PaperTable t{"energies",
               "Raw energies (" + what_energy_means(c) + "), ± one standard error, and the p1 and p2 that normalise them. " + origin(c),
               metric_head(c, {"model"}),
               {}};
  for (const FitResult& r : c.models)
    t.rows.push_back(metric_row(c, r.model, [&](std::size_t m) { return with_error(r.raw_energies[m], r.raw_se[m], 3); }));
  t.rows.push_back(metric_row(c, "p1", [&](std::size_t m) { return fixed(c.p1[m], 4); }));
  t.rows.push_back(metric_row(c, "p2", [&](std::size_t m) { return fixed(c.p2[m], 4); }));
  return t;
}

PaperTable weights(const Comparison& c) {
  PaperTable t{"weights",
               "Entropy weights of the metrics, by pass of the calibration; the last row is used. " + lag_weights(c) + origin(c),
               metric_head(c, {"pass"}),
               {}};
  for (const WeightStep& s : c.weight_history)
    t.rows.push_back(metric_row(c, std::to_string(s.pass), [&](std::size_t m) { return fixed(s.weights[m], 4); }));
  t.rows.push_back(metric_row(c, "final", [&](std::size_t m) { return fixed(c.weights[m], 4); }));
  return t;
}

PaperTable parameters(const Comparison& c) {
  PaperTable t{"parameters",
               "Fitted parameters in physical units; * ended on a bound of the search. 95 %: of the posterior. " + origin(c),
               {"model", "parameter", "value", "95 %", "unit", "lower", "upper"},
               {}};
  for (const FitResult& r : c.models)
    for (const ParameterResult& p : r.parameters)
      if (p.fitted)
        t.rows.push_back({r.model, p.name, rounded(p.value, 4) + (p.at_bound ? " *" : ""), interval_text(p.posterior), p.unit,
                          rounded(p.lower), rounded(p.upper)});
  return t;
}

PaperTable sensitivity(const Comparison& c) {
  PaperTable t{
      "sensitivity",
      "Score and rank of every model when one metric is left out of the score; weights of the others keep their ratios. " + origin(c),
      metric_head(c, {"model", "all"}),
      {}};
  for (const FitResult& r : c.models) {
    Row row = metric_row(c, r.model, [&](std::size_t m) {
      const Sensitivity& s = r.sensitivity;
      return std::isfinite(s.without[m]) ? fmt::format("{} ({})", fixed(s.without[m], 3), s.rank_without[m]) : kUndefined;
    });
    row.insert(row.begin() + 1, fmt::format("{} ({})", fixed(r.score, 3), rank_text(r.rank)));
    t.rows.push_back(std::move(row));
  }
  return t;
}

std::string markdown_cell(const std::string& text) {
  std::string out;
  for (const char c : printable(text)) {
    if (c == '|' || c == '\\' || c == '`' || c == '*' || c == '_' || c == '<' || c == '[' || c == ']') out += '\\';
    out += c;
  }
  return out;
}

std::string latex_row(const Row& cells) {
  Row escaped;
  for (const std::string& cell : cells) escaped.push_back(latex_text(cell));
  return fmt::format("    {} \\\\\n", fmt::join(escaped, " & "));
}

}  // namespace

std::vector<PaperTable> paper_tables(const Comparison& c) { return {ranking(c), energies(c), weights(c), parameters(c), sensitivity(c)}; }

std::string to_markdown(const PaperTable& t) {
  const auto line = [](const Row& cells) {
    std::string out = "|";
    for (const std::string& cell : cells) out += ' ' + markdown_cell(cell) + " |";
    return out + '\n';
  };
  std::string out = line(t.head) + "|---|";
  for (std::size_t k = 1; k < t.head.size(); ++k) out += "---:|";
  out += '\n';
  for (const Row& row : t.rows) out += line(row);
  return out + '\n' + markdown_cell(t.caption) + '\n';
}

std::string to_latex(const PaperTable& t) {
  std::string out =
      fmt::format("% needs \\usepackage{{booktabs}}\n\\begin{{table}}\n  \\caption{{{}}}\n  \\label{{tab:{}}}\n  \\centering\n",
                  latex_text(t.caption), t.name);
  out +=
      fmt::format("  \\begin{{tabular}}{{l{}}}\n    \\toprule\n{}    \\midrule\n", std::string(t.head.size() - 1, 'r'), latex_row(t.head));
  for (const Row& row : t.rows) out += latex_row(row);
  return out + "    \\bottomrule\n  \\end{tabular}\n\\end{table}\n";
}

std::string latex_text(std::string_view utf8) {
  using Pair = std::pair<std::string_view, std::string_view>;
  static constexpr std::array kCommands{Pair{"\\", "\\textbackslash{}"},
                                        Pair{"&", "\\&"},
                                        Pair{"%", "\\%"},
                                        Pair{"$", "\\$"},
                                        Pair{"#", "\\#"},
                                        Pair{"_", "\\_"},
                                        Pair{"{", "\\{"},
                                        Pair{"}", "\\}"},
                                        Pair{"~", "\\textasciitilde{}"},
                                        Pair{"^", "\\^{}"},
                                        Pair{"±", "$\\pm$"},
                                        Pair{"–", "--"},
                                        Pair{"²", "$^2$"},
                                        Pair{"³", "$^3$"},
                                        Pair{"⁻", "$^-$"},
                                        Pair{"¹", "$^1$"},
                                        Pair{"ω", "$\\omega$"},
                                        Pair{"α", "$\\alpha$"},
                                        Pair{"μ", "$\\mu$"},
                                        Pair{"η", "$\\eta$"},
                                        Pair{"γ", "$\\gamma$"},
                                        Pair{"√", "$\\sqrt{\\;}$"},
                                        Pair{"·", "$\\cdot$"},
                                        Pair{"×", "$\\times$"},
                                        Pair{"\u202f", "\\,"},
                                        Pair{"<", "$<$"},
                                        Pair{">", "$>$"},
                                        Pair{"|", "$|$"}};
  const std::string text = printable(utf8);
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view rest = std::string_view(text).substr(i);
    const auto* found = std::find_if(kCommands.begin(), kCommands.end(), [&](const Pair& p) { return rest.starts_with(p.first); });
    out += found != kCommands.end() ? found->second : rest.substr(0, 1);
    i += found != kCommands.end() ? found->first.size() : 1;
  }
  return out;
}

void write_table(const std::string& dir, const PaperTable& t) {
  write_file_atomically(dir + '/' + t.name + ".md", to_markdown(t));
  write_file_atomically(dir + '/' + t.name + ".tex", to_latex(t));
}

}  // namespace swarmfit
