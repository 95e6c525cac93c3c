// SPDX-License-Identifier: MIT
#include "reports/run/run_directory.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <set>

#include "libtrack/error.h"
#include "libtrack/file.h"
#include "reports/comparison/figures.h"
#include "reports/comparison/html.h"
#include "reports/comparison/json.h"
#include "reports/comparison/paper_tables.h"
#include "reports/comparison/tables.h"
#include "reports/run/run_files.h"
#include "reports/write/run_folder.h"
#include "tests/reports/sample.h"

namespace swarmfit {
namespace {

namespace fs = std::filesystem;
using testing::UnorderedElementsAreArray;

class RunDirectory : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::path(testing::TempDir()) / ("run_directory_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(root_);
    fs::create_directories(root_);
  }
  void TearDown() override { fs::remove_all(root_); }
  std::string dir(const std::string& name = "run") const { return (root_ / name).string(); }

  static std::set<std::string> files(const std::string& dir) {
    std::set<std::string> out;
    for (const auto& entry : fs::recursive_directory_iterator(dir))
      if (entry.is_regular_file()) out.insert(fs::relative(entry.path(), dir).string());
    return out;
  }

  fs::path root_;
};

// config.toml cannot be written because its temporary name is taken: what a kill at that moment leaves.
TEST_F(RunDirectory, OldResultsAreGoneBeforeTheSettingsChange) {
  const Comparison c = sample_comparison();
  const auto obstacle = dir() + fmt::format("/config.toml.{}.part", getpid());
  const auto interrupted = [&](const std::function<void()>& begin) {
    write_run(dir(), c);
    fs::create_directories(obstacle + "/full");
    EXPECT_THROW(begin(), RunError);
    EXPECT_FALSE(fs::exists(dir() + "/results.json"));
    fs::remove_all(dir());
  };
  interrupted([&] { write_run(dir(), c); });
  interrupted([&] { begin_run(dir(), "# A run of swarmfit\n"); });
  interrupted([&] { begin_study(dir(), "power", {}); });
}

TEST_F(RunDirectory, HoldsEverythingAndNoLeftovers) {
  const Comparison c = sample_comparison();
  write_run(dir("new/run"), c);
  std::vector<std::string> expected = {"config.toml", "history.csv", "report.html",         "results.json",
                                       "methods.md",  "methods.tex", "figures/captions.md", "figures/captions.tex"};
  for (const Figure& f : figures(c)) expected.push_back("figures/" + f.name + ".svg");
  for (const NamedTable& t : result_tables(c)) expected.push_back("tables/" + t.name);
  for (const PaperTable& t : paper_tables(c))
    for (const char* extension : {".md", ".tex"}) expected.push_back("tables/" + t.name + extension);
  EXPECT_THAT(files(dir("new/run")), UnorderedElementsAreArray(expected));
  EXPECT_EQ(read_file(dir("new/run") + "/results.json"), to_json(c));
  EXPECT_EQ(read_file(dir("new/run") + "/report.html"), report_html(c));
}

TEST_F(RunDirectory, SameResultSameBytes) {
  write_run(dir("a"), sample_comparison());
  write_run(dir("b"), sample_comparison());
  for (const std::string& name : files(dir("a"))) EXPECT_EQ(read_file(dir("a") + '/' + name), read_file(dir("b") + '/' + name)) << name;
}

TEST_F(RunDirectory, ReplacesAnEarlierRun) {
  write_run(dir(), sample_comparison());
  Comparison other = sample_comparison();
  other.run.seed = 7;
  write_run(dir(), other);
  EXPECT_EQ(read_file(dir() + "/results.json"), to_json(other));
}

TEST_F(RunDirectory, FiguresOfAnEarlierRunGoAndThoseOfOthersStay) {
  write_run(dir(), sample_at_lags());
  ASSERT_TRUE(fs::exists(dir() + "/figures/density_v_lag4.svg"));
  std::ofstream(dir() + "/figures/mine.svg") << "<svg/>";
  write_run(dir(), sample_comparison());
  EXPECT_FALSE(fs::exists(dir() + "/figures/density_v_lag4.svg"));
  EXPECT_TRUE(fs::exists(dir() + "/figures/density_v.svg"));
  EXPECT_TRUE(fs::exists(dir() + "/figures/mine.svg"));
}

TEST_F(RunDirectory, FilesComeInTheFormatThatIsAsked) {
  write_run(dir(), sample_comparison());
  const auto names = [&](const char* format) {
    std::vector<std::string> out;
    for (const RunFile& f : run_files(dir(), format)) {
      EXPECT_TRUE(fs::is_regular_file(f.path)) << f.path;
      out.push_back(f.name);
    }
    return out;
  };
  EXPECT_THAT(names("html"), testing::ElementsAre("report.html"));
  EXPECT_THAT(names("pdf"), testing::AllOf(testing::SizeIs(12), testing::Contains("scores.pdf"), testing::Each(testing::EndsWith(".pdf"))));
  EXPECT_THAT(names("svg"), testing::SizeIs(12));
  EXPECT_THAT(names("tex"), testing::IsSupersetOf({"captions.tex", "energies.tex", "methods.tex", "ranking.tex"}));
  EXPECT_THAT(names("md"), testing::IsSupersetOf({"captions.md", "energies.md", "methods.md", "ranking.md"}));
  EXPECT_THAT(names("csv"), testing::AllOf(testing::Contains("pdfs.csv"), testing::Not(testing::Contains("history.csv"))));
}

TEST_F(RunDirectory, OnlyFinishedRunsAreReported) {
  EXPECT_THROW(run_files(dir("nowhere"), "md"), InputError);
  write_run(dir(), sample_comparison());
  fs::remove_all(dir() + "/figures");
  EXPECT_THROW(run_files(dir(), "svg"), InputError) << "a run of an older version";
  EXPECT_NO_THROW(run_files(dir(), "csv"));
  fs::remove(dir() + "/results.json");
  EXPECT_THROW(run_files(dir(), "csv"), InputError);
}

TEST_F(RunDirectory, RefusesAFolderOfSomethingElse) {
  fs::create_directories(dir());
  std::ofstream(dir() + "/thesis.tex") << "ten years of work";
  EXPECT_THROW(check_run_directory(dir()), InputError);
  EXPECT_THROW(write_run(dir(), sample_comparison()), InputError);
  std::ofstream(dir() + "/config.toml") << "# A config of another program\n";
  EXPECT_THROW(check_run_directory(dir()), InputError);
  EXPECT_THAT(files(dir()), testing::ElementsAre("config.toml", "thesis.tex"));
}

TEST_F(RunDirectory, RefusesAFile) {
  std::ofstream(dir()) << "x";
  EXPECT_THROW(check_run_directory(dir()), InputError);
}

TEST_F(RunDirectory, AcceptsNewAndEmptyFolders) {
  EXPECT_NO_THROW(check_run_directory(dir("nowhere/yet")));
  fs::create_directories(dir());
  EXPECT_NO_THROW(check_run_directory(dir()));
}

TEST(ConfigToml, HoldsEverySettingAsItWasGiven) {
  Comparison c;
  c.run.command = "compare";
  c.run.config = {{"DATA", "\"a \\\"b\\\".txt\""}, {"model", "[\"bswarm\", \"boids\"]"}, {"seed", "1"}};
  EXPECT_EQ(config_toml(c.run.command, c.run.config),
            "# A run of swarmfit: `swarmfit compare --config config.toml --out NEW_FOLDER` repeats it.\n"
            "[compare]\nDATA = \"a \\\"b\\\".txt\"\nmodel = [\"bswarm\", \"boids\"]\nseed = 1\n");
}

}  // namespace
}  // namespace swarmfit
