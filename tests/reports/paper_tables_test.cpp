// SPDX-License-Identifier: MIT
#include "reports/comparison/paper_tables.h"

#include <gmock/gmock.h>

#include "tests/reports/sample.h"

namespace swarmfit {
namespace {

using testing::HasSubstr;
using testing::Not;

PaperTable named(const std::string& name) {
  for (const PaperTable& t : paper_tables(sample_comparison()))
    if (t.name == name) return t;
  ADD_FAILURE() << "no table " << name;
  return {};
}

TEST(PaperTables, EveryRowIsAsLongAsItsHead) {
  for (const PaperTable& t : paper_tables(sample_comparison())) {
    EXPECT_FALSE(t.rows.empty()) << t.name;
    for (const auto& row : t.rows) EXPECT_EQ(row.size(), t.head.size()) << t.name << ": " << row.front();
  }
}

TEST(PaperTables, EnergiesAreModelsByMetricsWithTheirNormalisation) {
  const PaperTable t = named("energies");
  ASSERT_EQ(t.rows.size(), 5u + 3);
  EXPECT_EQ(t.head.size(), 1u + kMetrics);
  EXPECT_EQ(t.rows[0][0], "bswarm");
  EXPECT_THAT(t.rows[0][1], HasSubstr(" ± "));
  EXPECT_EQ(t.rows[5][0], "least (p1)");
  EXPECT_EQ(t.rows[7][0], "weight");
  EXPECT_EQ(t.rows[7][1], "0.2100");
  EXPECT_EQ(t.rows[7][4], "–") << "not in the score";
  EXPECT_EQ(t.head[4], "α (not scored)");
}

TEST(PaperTables, OnlyFittedParametersAreListed) {
  const PaperTable t = named("parameters");
  EXPECT_EQ(t.rows.size(), 5u * 3);
  EXPECT_EQ(t.rows[1][3], "2310 *") << "the mark of a bound";
  EXPECT_THAT(to_latex(t), HasSubstr("\\begin{tabular}{lllrrrlrr}"));
  EXPECT_THAT(to_markdown(t), HasSubstr("|---|---|---|---:|---:|---:|---|---:|---:|"));
}

TEST(PaperTables, MarkdownByHand) {
  const PaperTable t{"x", "A *caption*.", {"model", "v"}, {{"a[b|c]", "1 ± 2"}}};
  EXPECT_EQ(to_markdown(t), "| model | v |\n|---|---:|\n| a\\[b\\|c\\] | 1 ± 2 |\n\nA \\*caption\\*.\n");
}

TEST(PaperTables, LatexByHand) {
  const PaperTable t{"x", "50 %.", {"model", "ω"}, {{"ab_c", "1 ± 2"}}};
  EXPECT_EQ(to_latex(t),
            "% needs \\usepackage{booktabs}\n\\begin{table}\n  \\caption{50 \\%.}\n  \\label{tab:x}\n  \\centering\n"
            "  \\footnotesize\\setlength{\\tabcolsep}{3pt}\n  \\begin{tabular}{lr}\n    \\toprule\n    model & $\\omega$ \\\\\n    "
            "\\midrule\n    ab\\_c & 1 $\\pm$ 2 \\\\\n"
            "    \\bottomrule\n  \\end{tabular}\n\\end{table}\n");
}

TEST(PaperTables, WideTablesTakeBothColumnsOfAPage) {
  EXPECT_THAT(to_latex(named("energies")), testing::AllOf(HasSubstr("\\begin{table*}"), HasSubstr("\\end{table*}")));
  EXPECT_THAT(to_latex({"x", "", {"model", "v"}, {{"boids", "1"}}}), HasSubstr("\\begin{table}"));
}

TEST(PaperTables, TheRankingHasGroupsSkillAndTheHeldOutHalf) {
  Comparison c = sample_comparison();
  c.models[0].likeness.skill = {-0.07, 0.02};
  PaperTable t = paper_tables(c).front();
  EXPECT_THAT(t.head, testing::ElementsAre("model", "rank", "score", "95 %", "fit p", "skill", "fitted", "candidates"));
  EXPECT_THAT(t.rows[0], testing::ElementsAre("bswarm", "1 a", "0.912", "0.88 to 0.93", "0.50", "−0.07 ± 0.02", "3", "2423"));
  c.recording.hold_out.ways = {{1, 240, 261, 500, {}, {}}, {261, 500, 1, 240, {}, {}}};
  c.models[0].standing.in_sample.score = 0.962;
  t = paper_tables(c).front();
  EXPECT_EQ(t.head[6], "in sample");
  EXPECT_EQ(t.rows[0][6], "0.962");
  EXPECT_THAT(t.caption, HasSubstr("frames 261 to 500"));
}

TEST(PaperTables, PowersAndMinusSignsAreLatex) {
  EXPECT_EQ(latex_text("10⁻¹² mm/s¹·⁵"), "10$^{-12}$ mm/s$^{1.5}$");
  EXPECT_EQ(latex_text("τ_v, χ_rep"), "$\\tau_{v}$, $\\chi_{\\mathrm{rep}}$");
  EXPECT_EQ(latex_text("r_rep C_r"), "r\\_rep C\\_r");
  EXPECT_EQ(latex_text("chi_rep x_ a_b_c"), "chi\\_rep x\\_ a\\_b\\_c") << "names stay names";
  EXPECT_EQ(latex_text("a·b² · −3"), "a$\\cdot$b$^{2}$ $\\cdot$ $-$3");
}

TEST(PaperTables, TextOfUnknownOriginStaysText) {
  EXPECT_EQ(latex_text("\\input{x} & 100% $y$ #1 ~^"), "\\textbackslash{}input\\{x\\} \\& 100\\% \\$y\\$ \\#1 \\textasciitilde{}\\^{}");
  EXPECT_THAT(latex_text("a\nb"), Not(HasSubstr("\n")));
  EXPECT_THAT(to_markdown({"x", "", {"model"}, {{"<script>"}}}), HasSubstr("\\<script>"));
}

}  // namespace
}  // namespace swarmfit
