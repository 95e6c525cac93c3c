// SPDX-License-Identifier: MIT
// The rules themselves: each must let a good file pass and catch a deliberate breach. Rules on made-up files, one breach per case.
#include "tests/house/rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace swarmfit::house {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Source source(std::string path, std::string text) { return {std::move(path), std::move(text)}; }

TEST(ReadingASource, FindsIncludesButNotThoseInComments) {
  const auto found = includes_of(
      source("fit/a.cpp", "// #include \"cli/x.h\"\n/* \n#include <nlopt.hpp>\n*/\n#include <vector>\n # include \"fit/b.h\"\n"));
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].name, "vector");
  EXPECT_FALSE(found[0].quoted);
  EXPECT_EQ(found[0].line, 5);
  EXPECT_EQ(found[1].name, "fit/b.h");
  EXPECT_TRUE(found[1].quoted);
}

TEST(ReadingASource, BlanksCommentsAndLiteralsAndNothingElse) {
  EXPECT_EQ(code_of(source("fit/a.cpp", "a; // b\nc /* d\n e */ f")), "a;     \nc     \n      f");
  EXPECT_EQ(code_of(source("fit/a.cpp", R"cpp(f("x\"y", 'z') + 1'000 + g)cpp")), "f(      ,    ) + 1'000 + g");
  EXPECT_EQ(code_of(source("fit/a.cpp", "R\"x(a\")b)x\" + c")), std::string(11, ' ') + " + c");
}

TEST(Arrows, PointOnlyFromRightToLeft) {
  EXPECT_THAT(check_arrows(source("libeval/a.cpp", "#include \"libeval/a.h\"\n#include \"libtrack/tracks.h\"\n")), IsEmpty());
  EXPECT_THAT(check_arrows(source("libeval/a.cpp", "\n#include \"libswarm/state.h\"\n")),
              ElementsAre("libeval/a.cpp:2: libeval/ may not include libswarm/state.h"));
  EXPECT_THAT(check_arrows(source("libtrack/a.h", "#include \"libswarm/state.h\"\n")), ElementsAre(HasSubstr("may not include")));
  EXPECT_THAT(check_arrows(source("libswarm/a.h", "#include \"fit/optimise/differential_evolution.h\"\n")),
              ElementsAre(HasSubstr("may not include")));
  EXPECT_THAT(check_arrows(source("fit/a.h", "#include \"reports/comparison/html.h\"\n")), ElementsAre(HasSubstr("may not include")));
  EXPECT_THAT(check_arrows(source("reports/a.cpp", "#include \"libswarm/model.h\"\n")), ElementsAre(HasSubstr("may not include")));
  EXPECT_THAT(check_arrows(source("cli/a.cpp", "#include \"tests/x.h\"\n")), ElementsAre(HasSubstr("may not include")));
}

TEST(Arrows, IncludesAreWrittenFromTheRoot) {
  EXPECT_THAT(check_arrows(source("fit/a.cpp", "#include \"genetic.h\"\n")), ElementsAre(HasSubstr("must be written")));
  EXPECT_THAT(check_arrows(source("fit/a.cpp", "#include \"fit/../cli/x.h\"\n")), ElementsAre(HasSubstr("must be written")));
  EXPECT_THAT(check_arrows(source("fit/a.cpp", "#include <fit/optimise/differential_evolution.h>\n")),
              ElementsAre(HasSubstr("must be written")));
}

TEST(Arrows, WithinARoomTheyPointDown) {
  EXPECT_THAT(check_sub_rooms(source("fit/compare/a.cpp", "#include \"fit/compare/b.h\"\n#include \"fit/infer/c.h\"\n")), IsEmpty());
  EXPECT_THAT(check_sub_rooms(source("fit/infer/a.h", "#include \"fit/compare/b.h\"\n")), ElementsAre(HasSubstr("lies higher")));
  EXPECT_THAT(check_sub_rooms(source("libtrack/a.cpp", "#include \"libtrack/read/b.h\"\n")), ElementsAre(HasSubstr("lies higher")));
  EXPECT_THAT(check_sub_rooms(source("libswarm/models/a.cpp", "#include \"libswarm/model.h\"\n")), IsEmpty());
  EXPECT_THAT(check_sub_rooms(source("reports/a.cpp", "")), ElementsAre(HasSubstr("no sub-room")));
  EXPECT_THAT(check_sub_rooms(source("fit/attic/a.cpp", "")), ElementsAre(HasSubstr("no sub-room")));
  EXPECT_THAT(check_sub_rooms(source("cli/a.cpp", "#include \"fit/study/b.h\"\n")), IsEmpty());
}

// A header that may be included may itself include what may not.
TEST(Arrows, AreFollowedToTheEnd) {
  const std::vector<Source> honest{source("reports/run/a.h", "#include \"fit/study/b.h\"\n"),
                                   source("fit/study/b.h", "#include \"fit/results/c.h\"\n"),
                                   source("fit/results/c.h", "#include \"libeval/d.h\"\n")};
  EXPECT_THAT(check_reach(honest), IsEmpty());
  std::vector<Source> sly = honest;
  sly[2] = source("fit/results/c.h", "#include \"libswarm/d.h\"\n");
  EXPECT_THAT(check_reach(sly),
              ElementsAre(AllOf(HasSubstr("reports/run/a.h"), HasSubstr("reaches libswarm/d.h through fit/results/c.h"))));
}

TEST(Arrows, NewRoomsAreAQuestion) { EXPECT_THAT(check_arrows(source("utils/a.cpp", "")), ElementsAre(HasSubstr("no room"))); }

TEST(Libraries, StayInTheirRooms) {
  EXPECT_THAT(check_libraries(source("fit/a.cpp", "#include <nlopt.hpp>\n#include <Eigen/Core>\n#include <vector>\n")), IsEmpty());
  EXPECT_THAT(check_libraries(source("libeval/a.cpp", "#include <nlopt.hpp>\n")), ElementsAre(HasSubstr("no business in libeval/")));
  EXPECT_THAT(check_libraries(source("cli/a.cpp", "#include <matio.h>\n")), ElementsAre(HasSubstr("no business in cli/")));
  EXPECT_THAT(check_libraries(source("libswarm/a.cpp", "#include <Random123/philox.h>\n")), ElementsAre(HasSubstr("no business")));
  EXPECT_THAT(check_libraries(source("fit/a.cpp", "#include <gsl/gsl_rng.h>\n")), ElementsAre(HasSubstr("not a library of the table")));
}

TEST(Libraries, HeavyOnesStayOutOfHeaders) {
  EXPECT_THAT(check_libraries(source("fit/a.h", "#include <nlohmann/json_fwd.hpp>\n")), IsEmpty());
  EXPECT_THAT(check_libraries(source("fit/a.h", "#include <nlohmann/json.hpp>\n")), ElementsAre(HasSubstr("belongs into a .cpp")));
  EXPECT_THAT(check_libraries(source("fit/a.h", "#include <nlopt.hpp>\n")), ElementsAre(HasSubstr("belongs into a .cpp")));
}

TEST(Libraries, OneFileIncludesCli11) {
  const auto one = source("cli/main.cpp", "#include <CLI/App.hpp>\n#include <CLI/Config.hpp>\n");
  EXPECT_THAT(check_cli11({one, source("cli/fit.cpp", "")}), IsEmpty());
  EXPECT_THAT(check_cli11({one, source("cli/fit.cpp", "#include <CLI/CLI.hpp>\n")}), testing::SizeIs(2));
}

class BannedCall : public testing::TestWithParam<const char*> {};

TEST_P(BannedCall, IsCaughtBelowCliOnly) {
  EXPECT_THAT(check_calls(source("fit/a.cpp", GetParam())), testing::SizeIs(1)) << GetParam();
  EXPECT_THAT(check_calls(source("cli/a.cpp", GetParam())), IsEmpty());
  EXPECT_THAT(check_calls(source("fit/a.cpp", std::string("// ") + GetParam())), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Rules, BannedCall,
                         testing::Values("std::cout << x;", "std::cerr << x;", "#include <iostream>", "printf(format);",
                                         "fmt::print(format);", "std::fputs(x, stderr);", "auto t = std::chrono::steady_clock::now();",
                                         "system_clock::now();", "auto t = time(nullptr);", "std::time(&t);", "omp_get_wtime();",
                                         "std::getenv(x);", "choice.spec->make(setup);", "std::random_device d;", "rand();",
                                         "std::mt19937_64 g;", "std::normal_distribution<> n;", "std::shuffle(a, b, g);",
                                         "Eigen::ArrayXd::Random(3);", "x.setRandom();"));

TEST(Calls, LookalikesPass) {
  EXPECT_THAT(
      check_calls(source(
          "fit/a.cpp", "s.time(); tracks.time(0, 1); snprintf(b, n, f); x.brand(2); fmt::format(f); rng.sample(3); std::chrono::year y;")),
      IsEmpty());
}

TEST(Form, LicenceLineAndPragma) {
  EXPECT_THAT(check_form(source("fit/a.h", "// SPDX-License-Identifier: MIT\n#pragma once\n")), IsEmpty());
  EXPECT_THAT(check_form(source("fit/a.h", "// SPDX-License-Identifier: MIT\n#ifndef A\n")), ElementsAre(HasSubstr("#pragma once")));
  EXPECT_THAT(check_form(source("fit/a.cpp", "#include <vector>\n")), ElementsAre(HasSubstr("SPDX")));
}

TEST(TestSources, AreAllBuilt) {
  const std::string cmake = "\nroom_tests(fit fit)\n";
  EXPECT_THAT(check_tests_are_built({source("tests/fit/a_test.cpp", ""), source("tests/eval/b.h", "")}, cmake), IsEmpty());
  EXPECT_THAT(check_tests_are_built({source("tests/long/a.cpp", "")}, cmake + "add_executable(a long/a.cpp)"), IsEmpty());
  EXPECT_THAT(check_tests_are_built({source("tests/eval/a_test.cpp", "")}, cmake), ElementsAre(HasSubstr("no line of")));
  EXPECT_THAT(check_tests_are_built({source("tests/fit/deeper/a_test.cpp", "")}, cmake), ElementsAre(HasSubstr("no line of")));
}

TEST(Tidy, EveryCheckThatIsOffHasItsReason) {
  EXPECT_THAT(check_tidy_reasons("# misc-a: noise\n\nChecks: 'misc-*,-misc-a'\n"), IsEmpty());
  EXPECT_THAT(check_tidy_reasons("# misc-a: noise\n\nChecks: >\n  misc-*,\n  -misc-a,\n  -misc-b\n"),
              ElementsAre(HasSubstr("misc-b is off")));
}

}  // namespace
}  // namespace swarmfit::house
