// SPDX-License-Identifier: MIT
#include "reports/methods.h"

#include <gmock/gmock.h>

#include "reports/html.h"
#include "tests/reports/sample.h"

namespace swarmfit {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

TEST(Methods, AreThoseOfTheReport) {
  const std::string page = report_html(sample_comparison());
  const std::string markdown = methods_markdown(page), latex = methods_latex(page);
  EXPECT_THAT(markdown, AllOf(StartsWith("5 models were fitted with swarmfit 0.1.0 to 500 frames of swarm.txt"), HasSubstr("\\[1, 2\\]"),
                              HasSubstr("v<sub>k</sub> = (p<sub>k+1</sub> − p<sub>k</sub>)/dt"), HasSubstr("\n1. Ren J, Wang X"),
                              HasSubstr("\n6. Ren et al. 2016, doi:10.1371/journal.pone.0155698 (bswarm)\n")));
  EXPECT_THAT(latex, AllOf(HasSubstr("v\\textsubscript{k} = (p\\textsubscript{k+1} $-$ p\\textsubscript{k})/dt"),
                           HasSubstr("\\begin{enumerate}\n  \\item Ren J, Wang X"), HasSubstr("\\end{enumerate}\n")));
  EXPECT_THAT(markdown, Not(testing::ContainsRegex("&[a-z#]|\\{\\{|<p>|<li>")));
  EXPECT_THAT(methods_markdown("<p>no section</p>"), IsEmpty());
}

TEST(Methods, NamesStayText) {
  Comparison c = sample_comparison();
  c.data.path = "a_b&<i>\"c'.txt";
  const std::string page = report_html(c);
  EXPECT_THAT(methods_markdown(page), HasSubstr("frames of a\\_b&\\<i>\"c'.txt"));
  EXPECT_THAT(methods_latex(page), HasSubstr("frames of a\\_b\\&$<$i$>$''c'.txt"));
}

}  // namespace
}  // namespace swarmfit
