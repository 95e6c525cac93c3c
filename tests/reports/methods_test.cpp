// SPDX-License-Identifier: MIT
#include "reports/comparison/methods.h"

#include <gmock/gmock.h>

#include "reports/comparison/html.h"
#include "tests/reports/sample.h"

namespace swarmfit {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

TEST(Methods, InThreeLanguages) {
  const Comparison c = sample_comparison();
  const std::string markdown = methods_markdown(c), latex = methods_latex(c), page = report_html(c);
  EXPECT_THAT(markdown, AllOf(StartsWith("5 models were fitted with swarmfit 0.1.0 to 500 frames of swarm.txt"), HasSubstr("\\[1, 2\\]"),
                              HasSubstr("(p(k+1) − p(k))/dt"), HasSubstr("\n1. Ren J, Wang X"),
                              HasSubstr("\n8. Ren et al. 2016, doi:10.1371/journal.pone.0155698 (bswarm)\n")));
  EXPECT_THAT(latex, AllOf(HasSubstr("(p(k+1) $-$ p(k))/dt"), HasSubstr("\\begin{enumerate}\n  \\item Ren J, Wang X"),
                           HasSubstr("\\end{enumerate}\n")));
  EXPECT_THAT(page, AllOf(HasSubstr("<p>5 models were fitted"), HasSubstr("<li>Gneiting T, Raftery AE (2007)")));
}

TEST(Methods, SayWhatWasKeptFixed) {
  Comparison c = sample_comparison({{"bswarm", 0.9, 0.01, 1.04}});
  c.models[0].parameters[3].unit = "mm/s^2";
  c.models[0].parameters[3].value = 1.5e-7;
  EXPECT_THAT(methods_markdown(c),
              HasSubstr(" These parameters were kept fixed: bswarm: radius 1.5×10⁻⁷ mm/s². Simulation steps per frame: bswarm 2. Seed "));
  EXPECT_THAT(report_html(c), HasSubstr("<b>Kept fixed</b>, not searched: bswarm: radius 1.5e-07 mm/s²."));
  c.models[0].parameters.pop_back();
  EXPECT_THAT(methods_markdown(c), testing::Not(HasSubstr("Kept fixed")));
  EXPECT_THAT(report_html(c), testing::Not(HasSubstr("Kept fixed")));
}

TEST(Methods, SayHowRunsWereCompared) {
  Comparison c = sample_comparison();
  c.recording.binning.pooled = false;
  EXPECT_THAT(methods_markdown(c), HasSubstr("energy score of the recording"));
  c.recording.binning.pooled = true;
  EXPECT_THAT(methods_markdown(c), HasSubstr("all replicates pooled"));
}

TEST(Methods, NamesStayText) {
  Comparison c = sample_comparison();
  c.recording.data.path = "a_b&<i>\"c'.txt";
  EXPECT_THAT(methods_markdown(c), HasSubstr("frames of a\\_b&\\<i>\"c'.txt"));
  EXPECT_THAT(methods_latex(c), HasSubstr("frames of a\\_b\\&$<$i$>$''c'.txt"));
  EXPECT_THAT(report_html(c), HasSubstr("frames of a_b&amp;&lt;i&gt;"));
}

}  // namespace
}  // namespace swarmfit
