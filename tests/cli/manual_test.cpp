// SPDX-License-Identifier: MIT
// The pages and completions that are made from the table of settings.
#include "cli/setting.h"
#include "libswarm/model_spec.h"
#include "tests/cli/program.h"

namespace swarmfit::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class Manual : public test::Program {};

std::string with_hyphens_escaped(std::string text) {
  for (std::size_t at = 0; (at = text.find('-', at)) != text.npos; at += 2) text.insert(at, "\\");
  return text;
}

TEST_F(Manual, SettingsPageIsWhatTheProgramPrints) {
  EXPECT_EQ(test::content(test::fs::path(SWARMFIT_SOURCE_DIR) / "docs/reference/settings.md"), run("manual markdown").out)
      << "out of date; run docs/make_models";
}

TEST_F(Manual, ManPageNamesEveryCommandAndSetting) {
  const auto page = run("manual man");
  ASSERT_EQ(page.code, 0);
  EXPECT_THAT(page.out, StartsWith(".TH SWARMFIT 1"));
  for (const Command& command : commands()) EXPECT_THAT(page.out, HasSubstr("\n\\fB" + std::string(command.name) + "\\fR")) << command.name;
  for (const Setting& s : settings()) EXPECT_THAT(page.out, HasSubstr("\\fB" + with_hyphens_escaped(flag_of(s)) + "\\fR")) << s.name;
}

TEST_F(Manual, CompletionsNameEveryCommandAndFlag) {
  for (const std::string shell : {"bash", "zsh", "fish"}) {
    const auto script = run("completion " + shell);
    ASSERT_EQ(script.code, 0) << shell;
    for (const Command& command : commands()) EXPECT_THAT(script.out, HasSubstr(std::string(command.name))) << shell;
    for (const Setting& s : settings()) {
      if (is_positional(s)) continue;
      EXPECT_THAT(script.out, HasSubstr((shell == "fish" ? "-l " : "--") + std::string(s.name))) << shell;
    }
  }
}

TEST_F(Manual, RefusesOtherShellsAndFormats) {
  expect_refused("completion tcsh", "SHELL: 'tcsh' is not known; expected bash, zsh, fish");
  expect_refused("manual pdf", "FORMAT: 'pdf' is not known; expected man or markdown");
}

TEST_F(Manual, ModelPagesHoldTheirEquations) {
  const auto pages = test::fs::path(SWARMFIT_SOURCE_DIR) / "docs/models";
  std::size_t count = 0;
  for (const auto& entry : test::fs::directory_iterator(pages / "equations")) {
    const std::string equations = test::content(entry.path());
    EXPECT_THAT(equations, HasSubstr("$$")) << entry.path();
    EXPECT_THAT(test::content(pages / entry.path().filename()), HasSubstr("## Equations\n\n" + equations)) << entry.path();
    ++count;
  }
  EXPECT_EQ(count, models().size());
}

}  // namespace
}  // namespace swarmfit::cli
