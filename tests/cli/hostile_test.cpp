// SPDX-License-Identifier: MIT
// Input that nobody should give and circumstances that nobody wants: still one line and the right exit code.
#include <fmt/format.h>

#include <csignal>

#include "cli/setting.h"
#include "tests/cli/program.h"

namespace swarmfit::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

struct Hostile : Program {
  void one_line(const Result& r, const std::string& arguments) const {
    EXPECT_THAT(r.err, StartsWith("swarmfit: ")) << arguments;
    EXPECT_EQ(std::count(r.err.begin(), r.err.end(), '\n'), 1) << arguments << ": " << r.err;
  }
};

TEST_F(Hostile, OutputThatDoesNotArriveIsAFailure) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  write("table.csv", "model,v,a\nA,1,5\nB,2,3\n");
  ASSERT_EQ(run("simulate boids --agents 4 --frames 20 -o film.csv").code, 0);
  const std::string quick = " --frames 0:15 --max-evaluations 10 --replicates 1 -q ";
  ASSERT_EQ(run("fit film.csv -m brownian -o done" + quick).code, 0);
  for (const std::string& job :
       {std::string("models --json"), std::string("models"), std::string("models boids --page"), std::string("formats"),
        std::string("--help"), std::string("fit --help"), std::string("--version"), std::string("describe film.csv"),
        std::string("convert film.csv -o -"), std::string("simulate boids --agents 4 --frames 9 -o -"),
        std::string("evaluate film.csv film.csv"), std::string("weigh table.csv"), std::string("report done --format md"),
        "fit film.csv -m brownian -o a" + quick, "compare film.csv -m brownian,langevin -o b" + quick,
        "power film.csv -m brownian,langevin --seeds 2 -o c" + quick,
        std::string("recover -m brownian,langevin --seeds 1 --agents 4 --frames 30 --max-evaluations 10 -q -o d")}) {
    for (const std::string& to : {std::string(">/dev/full"), std::string(">&-")}) {
      const Result r = run(job + ' ' + to);
      EXPECT_EQ(r.code, 1) << job << to;
      one_line(r, job + to);
      EXPECT_THAT(r.err, HasSubstr("standard output")) << job << to;
    }
  }
}

// Every flag of the commands that do not simulate for long, with words that are legal for some: exit code 0 or 2, and never more than a
// line.
TEST_F(Hostile, NoWordEndsTheProgramOtherwise) {
  ASSERT_EQ(run("simulate boids --agents 4 --frames 20 -o film.csv").code, 0);
  const std::string fits = " film.csv -m brownian --max-evaluations 10 --replicates 1 --max-time 0.000001 -q";
  const std::vector<std::pair<std::string, std::string>> jobs = {
      {"describe", " film.csv"},
      {"convert", " film.csv -o out.csv"},
      {"simulate", " boids -o out.csv"},
      {"evaluate", " film.csv film.csv"},
      {"fit", fits},
      {"recover", " -m brownian,langevin --max-evaluations 6 --agents 4 --frames 20 --max-time 0.000001 -q"}};
  int refused = 0;
  for (const auto& [name, rest] : jobs) {
    const auto command = std::find_if(cli::commands().begin(), cli::commands().end(), [&, n = name](const auto& c) { return c.name == n; });
    for (const cli::Setting& s : cli::settings()) {
      if ((s.in & command->bit) == 0 || cli::is_positional(s) || s.name == "help") continue;
      const std::string flag = "--" + std::string(s.name);
      if (rest.find(flag + ' ') != std::string::npos || s.letter != 0) continue;
      for (const std::string word : {"", "nan", "inf", "-1", "1e300", "two\nlines", "p=nan", "nan:1", "\\"}) {
        std::string arguments = name;
        arguments += rest + ' ' + flag + (s.allowed.kind == cli::Allowed::Kind::flag ? "='" : " '") + word + '\'';
        const Result r = run(arguments);
        EXPECT_TRUE(r.code == 0 || r.code == 2 || r.code == 130) << arguments << ": " << r.code << r.err;
        if (r.code != 2) continue;
        one_line(r, arguments);
        EXPECT_THAT(r.out, IsEmpty()) << arguments;
        EXPECT_LT(r.err.size(), 600U) << r.err;
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 300);
}

// OMP_NUM_THREADS is as good as --threads, which has a limit.
TEST_F(Hostile, TheEnvironmentCannotAskForAMillionThreads) {
  const std::string job = " simulate boids --agents 3000 --frames 2 -q -o film.csv";
  const Result r = run("--version >/dev/null; OMP_NUM_THREADS=1000000 timeout 60 '" SWARMFIT_PROGRAM "'" + job);
  EXPECT_EQ(r.code, 0) << r.err;
}

// Each once crashed, ran for minutes, or was taken as something else.
TEST_F(Hostile, NumbersBeyondAllSenseAreRefusedAtOnce) {
  expect_refused("describe demo --threads 100000", "--threads: '100000' is not allowed; expected a whole number from 0 to 1024");
  expect_refused("describe demo --seed 18446744073709551616", "--seed: ");
  expect_refused("describe demo --seed -1", "--seed: ");
  expect_refused("describe demo --fps 1e-320", "--fps: ");
  expect_refused("describe demo --fill-gaps 2147483647", "--fill-gaps: ");
  expect_refused("describe demo --times nan:inf", "--times: ");
  expect_refused("evaluate demo demo --bins 2147483647", "--bins: ");
  expect_refused("convert demo --smooth 1e9 -o -", "--smooth: '1e9' is not allowed; expected a number from 0 to 10000");
  expect_refused("simulate boids --dropout nan -o -", "--dropout: 'nan' is not allowed; expected a number from 0 to 1");
  expect_refused("simulate boids --set radius=nan -o -", "--set: 'radius=nan': 'nan' is not a number");
  expect_refused("fit demo -m boids --population 1e9", "--population: ");
  expect_refused("fit demo -m boids --replicates 1000000000", "--replicates: ");
  expect_refused("fit demo -m boids --set radius=inf", "--set: ");
  expect_refused("fit demo -m boids --bounds radius=1:nan", "--bounds: ");
  expect_refused("fit demo -m boids --bounds radius=1:1e999", "--bounds: ");
  expect_refused("fit demo -m boids --error-limit nan", "--error-limit: ");
  expect_refused("fit demo -m boids --max-time 1e300h", "--max-time: '1e300h' is not allowed; expected a time above 0");
  expect_refused("recover -m boids,brownian --extent -1", "--extent: '-1' is not allowed; expected a number above 1e-09, at most 1e+09");
  expect_refused("recover -m boids,brownian --fps 1e9", "recover: at this --fps a group takes 4.44e+08 frames to move by its --extent");
  expect_refused("compare demo -m boids,brownian --scoring foo", "--scoring: 'foo' is not known; expected proper or pooled");
}

// A shell's variable that is not set: the message must say which word was empty.
TEST_F(Hostile, EmptyNamesAreRefused) {
  expect_refused("describe ''", "DATA: '' is not allowed; expected a name");
  expect_refused("describe demo '' --join", "DATA: ''");
  expect_refused("convert demo -o ''", "--out: ''");
  expect_refused("evaluate demo ''", "SIM: ''");
  expect_refused("resume ''", "RUN_DIR: ''");
}

TEST_F(Hostile, WhatTheTerminalWouldObeyIsShown) {
  const Result r = run("describe \"$(printf 'no\\n\\033[31mfile')\"");
  EXPECT_EQ(r.code, 2);
  EXPECT_THAT(r.err, AllOf(HasSubstr("no\\x0a\\x1b[31mfile"), testing::Not(HasSubstr("\033"))));
  one_line(r, "describe");
}

// Characters that TOML writes in other ways than the shell: the run goes on, and its config.toml repeats it.
TEST_F(Hostile, OddCharactersSurviveConfigAndResume) {
  ASSERT_EQ(run("simulate langevin --agents 6 --frames 60 --start-radius 5 --unit mm -o film.csv").code, 0);
  const std::string name = "q\"uo#te, [\\x] µ.csv";
  fs::rename(dir_ / "film.csv", dir_ / name);
  const std::string job = "compare '" + name + "' -m brownian,langevin --max-evaluations 20 --replicates 1 --budget quick -q ";
  const Result whole = run(job + "-o whole");
  ASSERT_EQ(whole.code, 0) << whole.err;
  EXPECT_EQ(run(job + "--max-time 0.001 -o timed").code, 130);
  const Result resumed = run("resume timed -q");
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  const Result again = run("compare --config whole/config.toml -q -o again");
  ASSERT_EQ(again.code, 0) << again.err;
  for (const char* other : {"timed", "again"}) EXPECT_EQ(content(dir_ / "whole/results.json"), content(dir_ / other / "results.json"));

  const std::string studied = "recover -m brownian,langevin --seeds 1 --agents 6 --frames 40 --max-evaluations 10 --unit 'u\"\\#' -q ";
  ASSERT_EQ(run(studied + "-o r").code, 0);
  const Result repeated = run("recover --config r/config.toml -q -o s");
  ASSERT_EQ(repeated.code, 0) << repeated.err;
  EXPECT_EQ(content(dir_ / "r/recovery.json"), content(dir_ / "s/recovery.json"));
}

// Each once wrote over another's results, ran until memory was full, or ended without a word.
TEST_F(Hostile, AFolderBelongsToOneRun) {
  ASSERT_EQ(run("simulate langevin --agents 6 --frames 60 --start-radius 5 --unit mm -o film.csv").code, 0);
  fs::create_directories(dir_ / "busy");
  const std::string job = " fit film.csv -m brownian --max-evaluations 10 --replicates 1 -q -o busy";
  std::ofstream(dir_ / "twice.sh") << "flock busy '" SWARMFIT_PROGRAM "'" << job << "\n";
  const Result r = run("--version >/dev/null; sh twice.sh");
  EXPECT_EQ(r.code, 2) << r.err;
  EXPECT_THAT(r.err, HasSubstr("busy: another run is writing to it; expected"));
  EXPECT_TRUE(fs::is_empty(dir_ / "busy"));
  EXPECT_EQ(run(job.substr(1)).code, 0);
}

TEST_F(Hostile, InputThatNeverEndsIsRefused) {
  expect_refused("describe /dev/zero", "/dev/zero: is a device; expected a file, or a pipe");
  expect_refused("describe /dev/urandom", "is a device");
  expect_refused("describe /dev/full --columns id,x", "is a device");
}

TEST_F(Hostile, AFileThatMayNotGrowIsAFailedWrite) {
  const Result r = run("--version >/dev/null; ulimit -f 1; '" SWARMFIT_PROGRAM "' convert demo -o big.csv");
  EXPECT_EQ(r.code, 1) << r.err;
  EXPECT_THAT(r.err, HasSubstr("big.csv: cannot be written: File too large"));
  EXPECT_FALSE(fs::exists(dir_ / "big.csv"));
}

TEST_F(Hostile, LinksStayLinksAndReadOnlyFilesStayAsTheyAre) {
  write("target.csv", "old");
  fs::create_symlink("target.csv", dir_ / "link.csv");
  ASSERT_EQ(run("convert demo --frames 0:3 -o link.csv").code, 0);
  EXPECT_TRUE(fs::is_symlink(dir_ / "link.csv"));
  EXPECT_THAT(content(dir_ / "target.csv"), StartsWith("# synthetic"));
  if (geteuid() == 0) GTEST_SKIP() << "root may write everything";
  write("kept.csv", "old");
  fs::permissions(dir_ / "kept.csv", fs::perms::owner_read);
  EXPECT_EQ(run("convert demo -o kept.csv").code, 1);
  EXPECT_EQ(content(dir_ / "kept.csv"), "old");
}

// While a recording is read there is nothing to save: the first signal ends the program.
TEST_F(Hostile, ASignalEndsReading) {
  const Result r = run("--version >/dev/null; mkfifo pipe; sleep 60 >pipe & filler=$!; '" SWARMFIT_PROGRAM
                       "' describe pipe & reader=$!; sleep 0.5; kill -TERM $reader; wait $reader; code=$?; kill $filler; exit $code");
  EXPECT_EQ(r.code, 128 + SIGTERM) << r.err;
}

TEST_F(Hostile, ASignalEndsSimulate) {
  const Result r =
      run("--version >/dev/null; timeout -s INT -k 20 1 '" SWARMFIT_PROGRAM "' simulate boids --agents 1000 --frames 1000000 -o film.csv");
  EXPECT_EQ(r.code, 124) << "ended by the first signal, not killed";
  EXPECT_FALSE(fs::exists(dir_ / "film.csv"));
}

TEST_F(Hostile, FramesFarApartAreAGap) {
  write("far.csv", "id,frame,x,y\na,0,0,0\na,1,1,0\na,1000000000,2,0\na,1000000001,3,0\n");
  EXPECT_EQ(run("describe far.csv --fps 25 --unit m").code, 0);
  EXPECT_EQ(run("convert far.csv --fps 25 --unit m --stride 2 -o near.csv").code, 0);
  expect_refused("describe far.csv --fps 25 --unit m --resample 1e9", "--resample 1e+09: that makes more than");
  // Everybody would be simulated through the hole.
  for (const char* hole : {"1000000", "1000000000", "8999999999999990"}) {
    std::string rows = "id,frame,x,y\n";
    for (const char* id : {"a", "b"})
      for (int f = 0; f < 6; ++f)
        rows += fmt::format("{},{},{},{}\n{},{},{},{}\n", id, f, f * f, id[0] - 'a', id, std::stoll(hole) + f, f * f, id[0] - 'a');
    write("hole.csv", rows);
    for (const char* presence : {"recorded", "constant"})
      expect_refused(
          fmt::format("fit hole.csv --fps 25 --unit m -m brownian --presence {} -q -o hole", presence),
          "only 12 show somebody, and all would be simulated; expected a recording without such holes (--frames takes a part of it)");
    EXPECT_EQ(run("describe hole.csv --fps 25 --unit m").code, 0);
  }
  write("late.csv", "id,t,x,y\na,1,0,0\na,2,1,0\na,3,1,0\na,1e30,1,0\n");
  expect_refused("describe late.csv --unit m --time-unit s", "more frames than can be counted");
}

// Cleaning is a setting like any other: a run that has it repeats itself, and says so in what it leaves.
TEST_F(Hostile, CleaningIsInConfigAndResults) {
  ASSERT_EQ(run("simulate langevin --agents 6 --frames 80 --start-radius 5 --unit mm -o film.csv").code, 0);
  const std::string rest = " -m brownian --max-evaluations 10 --replicates 1 -q -o ";
  ASSERT_EQ(run("fit film.csv --scale 0.1,0.2cm/mm --flip-y --stride 2 --longer-than 3 --tracks 0,1,2,4" + rest + "a").code, 0);
  const Result again = run("fit --config a/config.toml -q -o b");
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(content(dir_ / "a/results.json"), content(dir_ / "b/results.json"));
  const std::string results = content(dir_ / "a/results.json");
  for (const char* note :
       {"lengths were multiplied by 0.1, 0.2", "y was flipped", "one frame of 2 was kept", "2 individuals were left out by name"})
    EXPECT_THAT(results, HasSubstr(note));
  for (const char* file : {"a.csv", "a.h5", "a.npz"}) {
    ASSERT_EQ(run("convert film.csv --cut-jumps 1e6 --unwrap 1e9 --flip-y -o " + std::string(file)).code, 0);
    const Result r = run("describe " + std::string(file) + " --json");
    EXPECT_THAT(r.out, AllOf(HasSubstr("y was flipped"), HasSubstr("periodic boundaries of a box"))) << r.err;
  }
  expect_refused("convert film.csv --scale 0.001m/mm -o a.sqlite",
                 "--to jupedsim: it holds motion in two dimensions; expected another format");
}

}  // namespace
}  // namespace swarmfit::test
