// SPDX-License-Identifier: MIT
// The program as its user meets it: exit codes, one-line errors, what goes to standard output, and what a run leaves on disk.
#include "tests/cli/program.h"

#include <algorithm>

namespace swarmfit::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

constexpr const char* kQuick = "--budget quick --max-evaluations 20 --replicates 1 -q ";

TEST_F(Program, ShowsHelpAndVersion) {
  EXPECT_EQ(run("--version").code, 0);
  EXPECT_THAT(run("--version").out, StartsWith("swarmfit "));
  const Result help = run("compare --help");
  EXPECT_EQ(help.code, 0);
  EXPECT_THAT(help.out, AllOf(HasSubstr("--obs-noise"), HasSubstr("--preset"), HasSubstr("--columns")));
}

TEST_F(Program, RefusesBadFlagsInOneLine) {
  expect_refused("", "subcommand");
  expect_refused("describe", "DATA");
  expect_refused("describe demo --no-such-flag", "--no-such-flag");
  expect_refused("compare demo -m bswarm", "fewer than two models");
  expect_refused("compare demo -m bswarm,bswarm", "named twice");
  expect_refused("compare demo -m bswarm,birds", "birds");
  expect_refused("compare demo -m 'bswarm,bswarm[noise=pink]'", "pink");
  expect_refused("compare demo -m bswarm,boids --budget huge", "quick, default, thorough");
  expect_refused("compare demo -m bswarm,boids --set gama=1", "gama");
  expect_refused("compare demo -m bswarm,boids --bounds gamma=2:1", "empty");
  expect_refused("compare demo -m bswarm,boids --obs-noise much", "much");
  expect_refused("compare demo -m bswarm,boids --arena ball", "--arena ball");
  expect_refused("compare demo -m bswarm,boids --lags 1,0", "--lags 1,0");
  expect_refused("compare demo -m bswarm,boids --lags 4,4", "named twice");
  expect_refused("compare demo -m bswarm,boids --lags 5000 --out x", "lags of at most");
  expect_refused("evaluate demo demo --lags 1,fast", "fast");
  expect_refused("recover -m bswarm,boids --lags one", "one");
  expect_refused("fit demo -m bswarm,boids", "exactly one model");
  expect_refused("simulate birds -o x.csv", "birds");
}

TEST_F(Program, NamesThePlaceOfABadRow) {
  write("bad.csv", "frame,particle,x,y\n0,1,2,3\n1,1,oops,3\n");
  expect_refused("describe bad.csv --fps 10 --unit m", "bad.csv:3:5");
  expect_refused("describe missing.csv --fps 10 --unit m", "missing.csv");
  expect_refused("describe bad.csv", "bad.csv");
}

// As a shell writes goats/*.csv.
TEST_F(Program, JoinsFilesThatAreNamed) {
  for (const char* name : {"a.csv", "b.csv"}) write(name, "frame,x,y\n0,1,2\n1,1,3\n2,1,4\n");
  write("notes.md", "not joined");
  const Result joined = run("describe a.csv b.csv --join --fps 10 --unit m --json");
  EXPECT_EQ(joined.code, 0) << joined.err;
  EXPECT_THAT(joined.out, AllOf(HasSubstr("\"tracks\": 2"), HasSubstr("*.csv")));
  expect_refused("describe a.csv b.csv --fps 10 --unit m", "describe: 2 files; expected one, or --join to read them as one recording");
  expect_refused("describe . --fps 10 --unit m", ".: is a folder; expected a file, or --join to read the files in it as one recording");
}

TEST_F(Program, ReadsStandardInput) {
  const Result r = run("describe - --fps 10 --unit m --json", "frame,particle,x,y\n0,1,2,3\n1,1,2.5,3\n2,1,3,3\n");
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("\"schema\": \"swarmfit-summary/1\""));
}

TEST_F(Program, ConvertedDemoReadsBackWithoutFlags) {
  ASSERT_EQ(run("convert demo -o demo.csv").code, 0);
  const Result again = run("convert demo.csv -o again.csv");
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(content(dir_ / "demo.csv"), content(dir_ / "again.csv"));
  const Result same = run("evaluate demo demo.csv --json");
  ASSERT_EQ(same.code, 0) << same.err;
  EXPECT_THAT(same.out, HasSubstr("\"omega\": 0"));
}

TEST_F(Program, SimulatesTheSameTwice) {
  ASSERT_EQ(run("simulate bswarm --agents 10 --frames 20 --seed 3 -o a.csv").code, 0);
  ASSERT_EQ(run("simulate bswarm --agents 10 --frames 20 --seed 3 --threads 1 -o b.csv").code, 0);
  ASSERT_EQ(run("simulate bswarm --agents 10 --frames 20 --seed 4 -o c.csv").code, 0);
  EXPECT_EQ(content(dir_ / "a.csv"), content(dir_ / "b.csv"));
  EXPECT_NE(content(dir_ / "a.csv"), content(dir_ / "c.csv"));
}

TEST_F(Program, WeighsATable) {
  write("table.csv", "model,v,a\nA,1,5\nB,2,3\nC,4,4\n");
  const Result r = run("weigh table.csv --json");
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("\"weights\""));
  expect_refused("weigh -", "standard input:2:3", "model,v\nA,x\n");
}

TEST_F(Program, ListsModelsAndFormats) {
  EXPECT_THAT(run("models").out, AllOf(HasSubstr("bswarm"), HasSubstr("boids"), HasSubstr("gamma")));
  EXPECT_THAT(run("formats").out, HasSubstr("endings"));
  EXPECT_THAT(run("models --json").out, StartsWith("{"));
}

TEST_F(Program, CompareLeavesACompleteRunWithTheSameBytesForAnyNumberOfThreads) {
  const std::string job = std::string("compare demo -m bswarm,boids --frames 0:80 ") + kQuick;
  const Result one = run(job + "--threads 1 --out one");
  ASSERT_EQ(one.code, 0) << one.err;
  EXPECT_THAT(one.err, IsEmpty());
  EXPECT_THAT(one.out, HasSubstr("bswarm"));
  ASSERT_EQ(run(job + "--threads 3 --out three").code, 0);
  for (const char* file :
       {"results.json", "history.csv", "report.html", "config.toml", "tables/energies.csv", "tables/parameters.csv", "tables/pdfs.csv",
        "tables/ranking.csv", "tables/weights.csv", "figures/densities.svg", "figures/scores.svg", "figures/captions.md", "methods.tex"}) {
    EXPECT_FALSE(content(dir_ / "one" / file).empty()) << file;
    EXPECT_EQ(content(dir_ / "one" / file), content(dir_ / "three" / file)) << file;
  }
  EXPECT_TRUE(fs::exists(dir_ / "one/timing.json"));
}

TEST_F(Program, ReportsARunInTheFormatsOfAPaper) {
  ASSERT_EQ(run(std::string("compare demo -m brownian,langevin --frames 0:60 ") + kQuick + "--out a").code, 0);
  const Result r = run("report a/ --format svg,tex");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_THAT(r.out, AllOf(HasSubstr("a-paper/scores.svg\n"), HasSubstr("a-paper/ranking.tex\n"), HasSubstr("a-paper/methods.tex\n")));
  EXPECT_EQ(content(dir_ / "a-paper/scores.svg"), content(dir_ / "a/figures/scores.svg"));

  // A converter that says what it was asked: nothing but its output file is ours.
  fs::create_directories(dir_ / "bin");
  write("bin/rsvg-convert", "#!/bin/sh\n[ $# -lt 2 ] || echo \"$5\" >\"$4\"\n");
  fs::permissions(dir_ / "bin/rsvg-convert", fs::perms::owner_all);
  const std::string path = "--version >/dev/null; PATH=bin:/bin:/usr/bin '" SWARMFIT_PROGRAM "' ";
  ASSERT_EQ(run(path + "report a --format pdf --out 'in here' -q").code, 0);
  EXPECT_EQ(content(dir_ / "in here/scores.pdf"), "a/figures/scores.svg\n");
  EXPECT_TRUE(std::none_of(fs::directory_iterator(dir_ / "in here"), fs::directory_iterator(),
                           [](const auto& file) { return file.path().extension() == ".part"; }));
  write("bin/rsvg-convert", "#!/bin/sh\n[ $# -lt 2 ]\n");
  const Result broken = run(path + "report a --format pdf --out broken");
  EXPECT_EQ(broken.code, 1);
  EXPECT_THAT(broken.err, HasSubstr("rsvg-convert cannot write it"));
  const Result missing = run("--version >/dev/null; PATH=/nowhere '" SWARMFIT_PROGRAM "' report a --format pdf --out missing");
  EXPECT_EQ(missing.code, 1) << "not bad input, but impossible here";
  EXPECT_THAT(missing.err, AllOf(StartsWith("swarmfit: --format pdf: rsvg-convert does not run"), HasSubstr("librsvg2-bin")));
  EXPECT_FALSE(fs::exists(dir_ / "missing"));

  expect_refused("report a", "--format is required");
  expect_refused("report a --format doc", "doc");
  expect_refused("report nowhere --format md", "holds no run");
  fs::remove(dir_ / "a/results.json");
  expect_refused("report a --format md", "has not finished");
}

TEST_F(Program, ConfigOfARunRepeatsIt) {
  const Result first = run(std::string("compare demo -m 'boids,bswarm[noise=white]' --frames 0:99 --steps 2 --set tau=0.3 ") +
                           "--bounds bswarm.gamma=0.001:0.1 " + kQuick + "--out a");
  ASSERT_EQ(first.code, 0) << first.err;
  const Result again = run("compare --config a/config.toml -q --out b");
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(content(dir_ / "a/results.json"), content(dir_ / "b/results.json"));
}

// What a kill at any moment leaves is tried by tests/acceptance/kill_and_resume.
TEST_F(Program, AnInterruptedRunGoesOn) {
  const std::string job = "compare demo -m brownian,langevin --budget quick --frames 0:99 -q ";
  ASSERT_EQ(run(job + "--out whole").code, 0);
  const Result broken =
      run("--version >version; { '" SWARMFIT_PROGRAM "' " + job +
          "--out broken & while [ ! -s broken/checkpoint ] && kill -0 $!; do sleep 0.01; done; kill -TERM $!; wait $!; }");
  EXPECT_EQ(broken.code, 130);
  EXPECT_THAT(broken.err, HasSubstr("to continue: swarmfit resume broken"));
  const std::string checkpoint = content(dir_ / "broken/checkpoint"), config = content(dir_ / "broken/config.toml");
  EXPECT_THAT(checkpoint, StartsWith("swarmfit checkpoint"));

  std::string other = config;
  other.replace(other.find("seed = 1"), 8, "seed = 2");
  write("broken/config.toml", other);
  expect_refused("resume broken", "config.toml has changed");
  write("broken/config.toml", config);
  write("broken/checkpoint", "not one of ours");
  expect_refused("resume broken", "is not a checkpoint");
  write("broken/checkpoint", checkpoint);
  ASSERT_EQ(run("resume broken --threads 2 -q").code, 0);
  for (const char* file : {"results.json", "history.csv", "report.html", "config.toml", "figures/convergence.svg", "figures/captions.tex"})
    EXPECT_EQ(content(dir_ / "whole" / file), content(dir_ / "broken" / file)) << file;
  EXPECT_FALSE(fs::exists(dir_ / "broken/checkpoint"));
  expect_refused("resume broken", "is complete");
  expect_refused("resume nowhere", "holds no run");
}

// Stopped after the first comparison of several, and stopped again: the rest is computed once, the files are the same.
TEST_F(Program, StudiesGoOnToo) {
  for (const auto& [job, result] : std::vector<std::pair<std::string, std::string>>{
           {"power demo --frames 0:60 -m brownian,langevin --seeds 2 --max-evaluations 10 ", "power.json"},
           {"recover -m brownian,langevin --seeds 2 --agents 6 --frames 50 --max-evaluations 10 ", "recovery.json"},
           {"recover --parameters -m langevin --seeds 3 --agents 6 --frames 40 ", "recovery.json"}}) {
    fs::remove_all(dir_ / "broken");
    fs::remove(dir_ / "log");  // what it waits for is a line of this job's
    ASSERT_EQ(run(job + "-q --out whole").code, 0);
    const Result stopped =
        run("--version >version; { '" SWARMFIT_PROGRAM "' " + job +
            "--out broken 2>log & while ! grep -q '^1/' log && kill -0 $!; do sleep 0.01; done; kill -TERM $!; wait $!; }");
    EXPECT_EQ(stopped.code, 130) << job;
    EXPECT_THAT(content(dir_ / "log"), HasSubstr("to continue: swarmfit resume broken"));
    EXPECT_EQ(run("resume broken --max-time 0.001").code, 130) << job;
    EXPECT_FALSE(fs::exists(dir_ / "broken" / result));
    int code = 130;
    for (int k = 0; k < 9 && code == 130; ++k) code = run("resume broken --max-time 0.001 -q").code;
    ASSERT_EQ(code, 0) << job << "however short the time, it gets on";
    for (const std::string& file : {result, std::string("report.html"), std::string("config.toml"), std::string("tables/cases.csv")})
      EXPECT_EQ(content(dir_ / "whole" / file), content(dir_ / "broken" / file)) << job << file;
    EXPECT_FALSE(fs::exists(dir_ / "broken/checkpoint"));
    expect_refused("resume broken", "is complete");
  }
}

// One simulation of hours: nobody waits for its end.
TEST_F(Program, ASignalEndsALongSimulation) {
  const Result stopped = run("--version >version; timeout -s TERM -k 20 1 '" SWARMFIT_PROGRAM
                             "' sweep vicsek --agents 100 --frames 10000000 --axis eta=1 --seeds 1 -q -o long");
  EXPECT_EQ(stopped.code, 124) << "ended by the first signal, not killed";
  EXPECT_THAT(stopped.err, HasSubstr("swarmfit: interrupted; nothing was written"));
}

TEST_F(Program, ARunStopsWhenItsTimeIsUpAndGoesOn) {
  const std::string job = "compare demo -m brownian,langevin --budget quick --frames 0:60 -q ";
  ASSERT_EQ(run(job + "--out whole").code, 0);
  const Result stopped = run(job + "--max-time 0.001 --out timed");
  EXPECT_EQ(stopped.code, 130);
  EXPECT_THAT(stopped.err, HasSubstr("to continue: swarmfit resume timed"));
  EXPECT_EQ(run("resume timed --max-time 1ms").code, 2);
  EXPECT_EQ(run("resume timed --max-time 0.001").code, 130);
  ASSERT_EQ(run("resume timed --max-time 1h -q").code, 0);
  EXPECT_EQ(content(dir_ / "whole/results.json"), content(dir_ / "timed/results.json"));
}

TEST_F(Program, ARefusedRunLeavesAnEarlierOneAlone) {
  const std::string job = std::string("compare demo -m brownian,langevin --frames 0:60 --out a ") + kQuick;
  ASSERT_EQ(run(job).code, 0);
  const std::string results = content(dir_ / "a/results.json");
  expect_refused(job + "--bounds k=3:1", "the interval is empty");
  EXPECT_EQ(content(dir_ / "a/results.json"), results);
}

TEST_F(Program, SeveralRecordingsGetAFolderEachAndASummary) {
  fs::create_directories(dir_ / "again");
  ASSERT_EQ(run("convert demo --frames 0:60 -o film.csv -q").code, 0);
  ASSERT_EQ(run("convert demo --frames 100:160 -o again/film.csv -q").code, 0);
  const Result r = run(std::string("compare film.csv again/film.csv -m bswarm,boids ") + kQuick + "--out s");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("Rank (score) on 2 recordings"));
  for (const char* file : {"summary.json", "report.html", "config.toml", "tables/across.csv", "film/results.json", "film-2/results.json"})
    EXPECT_FALSE(content(dir_ / "s" / file).empty()) << file;
  EXPECT_THAT(content(dir_ / "s/film-2/config.toml"), HasSubstr("DATA = [\"again/film.csv\"]"));
  ASSERT_EQ(run("compare --config s/config.toml -q --out t").code, 0);
  EXPECT_EQ(content(dir_ / "s/summary.json"), content(dir_ / "t/summary.json"));
  expect_refused(std::string("compare film.csv no.csv -m bswarm,boids ") + kQuick + "--out u", "no.csv");
  EXPECT_FALSE(fs::exists(dir_ / "u")) << "nothing is simulated or written before all recordings are read";
  expect_refused("fit film.csv again/film.csv -m boids", "expected one recording");
}

TEST_F(Program, OneKindOfAnimalByItself) {
  std::string all = "id,frame,x,y,kind\n", sheep = all;
  for (int frame = 0; frame < 12; ++frame)
    for (int animal = 0; animal < 4; ++animal) {
      const std::string row = std::to_string(animal) + ',' + std::to_string(frame) + ',' +
                              std::to_string(animal * 3 + 0.1 * frame * animal) + ',' +
                              std::to_string(0.2 * frame - 0.01 * frame * frame * animal) + ',' + (animal == 1 ? "1" : "0") + '\n';
      all += row;
      if (animal != 1) sheep += row;
    }
  write("all.csv", all);
  write("sheep.csv", sheep);
  const std::string how = " --fps 10 --unit m --json";
  const auto facts = [&](const std::string& arguments) {
    const Result r = run(arguments);
    EXPECT_EQ(r.code, 0) << r.err;
    return r.out;
  };
  EXPECT_THAT(facts("describe all.csv --kind 0" + how),
              AllOf(HasSubstr("\"tracks\": 3"), HasSubstr("12 rows of other kinds than 0 were left out")));
  EXPECT_THAT(facts("describe all.csv" + how), HasSubstr("\"tracks\": 4"));
  const auto numbers = [&](const std::string& files) {
    const std::string said = facts("evaluate " + files + how);
    return said.substr(std::min(said.size(), said.find("\"normalisation\"")));  // without names and hashes of the files
  };
  EXPECT_EQ(numbers("all.csv all.csv --kind 0"), numbers("sheep.csv sheep.csv"));
  EXPECT_NE(numbers("all.csv all.csv"), numbers("sheep.csv sheep.csv"));
  expect_refused("describe all.csv --kind wolf --fps 10 --unit m",
                 "--kind wolf: no individual in all.csv is of that kind; expected one of 0, 1");
}

TEST_F(Program, RecoverCountsWhoWinsOnWhoseRecording) {
  const std::string job = "recover -m bswarm,boids --seeds 1 --agents 6 --frames 50 --max-evaluations 10 -q ";
  const Result r = run(job + "--out r");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_THAT(r.out, AllOf(HasSubstr("true model \\ ranked first"), HasSubstr("of 1")));
  ASSERT_EQ(run("recover --config r/config.toml -q --out again").code, 0);
  EXPECT_EQ(content(dir_ / "r/tables/cases.csv"), content(dir_ / "again/tables/cases.csv"));
  ASSERT_EQ(run(job + R"(--unit 'm"m\x' --out odd)").code, 0);
  EXPECT_THAT(content(dir_ / "odd/config.toml"), HasSubstr("unit = \"m\\\"m\\\\x\"\n"));
  ASSERT_EQ(run("recover --config odd/config.toml -q --out odder").code, 0);
  EXPECT_EQ(content(dir_ / "odd/config.toml"), content(dir_ / "odder/config.toml"));
  ASSERT_EQ(run(job + "--resolution none --out bare").code, 0);
  EXPECT_THAT(content(dir_ / "bare/config.toml"), HasSubstr("resolution = \"none\""));
  EXPECT_NE(content(dir_ / "r/tables/cases.csv"), content(dir_ / "bare/tables/cases.csv"));
  expect_refused("recover -m bswarm", "fewer than two models");
  expect_refused("recover --parameters -m bswarm,boids", "exactly one model");
  expect_refused("recover -m bswarm,boids --plant brownies", "brownies");
  expect_refused("recover -m bswarm,boids --set speed=3", "model.parameter=value");
  for (const char* asked : {"recover -m bswarm,boids --set bswarm.chi_res=3", "simulate bswarm --out s.csv --set chi_res=3"})
    expect_refused(asked, "--set chi_res=3: would do nothing, as there are no stimuli here; expected 0, or no chi_res");
}

TEST_F(Program, PowerPlantsInTheRecordingsOwnConditions) {
  const std::string job = "power demo --frames 0:60 -m bswarm,boids --seeds 2 --max-evaluations 10 -q ";
  const Result r = run(job + "--out p");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_THAT(r.out, AllOf(HasSubstr("A recording like this one"), HasSubstr("ranked before"), HasSubstr("of 2")));
  ASSERT_EQ(run("power --config p/config.toml -q --out again").code, 0);
  EXPECT_EQ(content(dir_ / "p/power.json"), content(dir_ / "again/power.json"));
  expect_refused("power demo -m bswarm", "fewer than two models");
  expect_refused("power demo demo -m bswarm,boids", "expected one recording");
}

TEST_F(Program, ProtocolSwitchesDefaultsAndFlagsWin) {
  const std::string job = std::string("compare demo -m bswarm,boids --frames 0:60 --protocol ren2016 ") + kQuick;
  ASSERT_EQ(run(job + "--out literal").code, 0);
  EXPECT_THAT(content(dir_ / "literal/config.toml"),
              AllOf(HasSubstr("protocol = \"ren2016\""), HasSubstr("normalisation = \"separate\""), HasSubstr("obs-noise = \"0\""),
                    HasSubstr("resolution = \"none\""), HasSubstr("calibration = \"last\""), HasSubstr("error-limit = 1"),
                    HasSubstr("lags = \"1\"")));
  EXPECT_THAT(content(dir_ / "literal/results.json"), AllOf(HasSubstr("\"protocol\": \"ren2016\""), HasSubstr("\"passes\": 10")));
  ASSERT_EQ(run(job + "--normalisation reference --obs-noise 0.3 --out mixed").code, 0);
  EXPECT_THAT(content(dir_ / "mixed/config.toml"), AllOf(HasSubstr("normalisation = \"reference\""), HasSubstr("obs-noise = \"0.3\"")));
  ASSERT_EQ(run("compare --config mixed/config.toml -q --out again").code, 0);
  EXPECT_EQ(content(dir_ / "mixed/results.json"), content(dir_ / "again/results.json"));
}

TEST_F(Program, LagsAreChosenAgainTheSame) {
  const std::string job = std::string("compare film.csv -m bswarm,boids ") + kQuick;
  ASSERT_EQ(run("simulate langevin --agents 8 --frames 120 --start-radius 5 --obs-noise 0.01 -o film.csv").code, 0);
  const Result chosen = run(job + "--verbose --out chosen");
  ASSERT_EQ(chosen.code, 0) << chosen.err;
  EXPECT_THAT(chosen.out, HasSubstr("Motion is measured at lag 1"));
  EXPECT_THAT(content(dir_ / "chosen/config.toml"), HasSubstr("lags = \"auto\""));
  ASSERT_EQ(run("compare --config chosen/config.toml -q --out again").code, 0);
  EXPECT_EQ(content(dir_ / "chosen/results.json"), content(dir_ / "again/results.json"));
  ASSERT_EQ(run(job + "--protocol ren2016 --lags 8,2 --out given").code, 0);
  EXPECT_THAT(content(dir_ / "given/config.toml"), HasSubstr("lags = \"8,2\""));
  EXPECT_THAT(run("evaluate film.csv film.csv --lags 1,4 --json").out, HasSubstr("\"mu@4\": 0"));
  EXPECT_THAT(run("evaluate film.csv film.csv --lags auto").out, HasSubstr("Motion is measured at lag"));
  ASSERT_EQ(run("weigh chosen/tables/raw_energies.csv").code, 0);
}

TEST_F(Program, DoesNotTouchAForeignFolder) {
  fs::create_directories(dir_ / "mine");
  write("mine/thesis.txt", "years of work");
  expect_refused(std::string("compare demo -m bswarm,boids ") + kQuick + "--out mine", "mine");
  EXPECT_EQ(content(dir_ / "mine/thesis.txt"), "years of work");
}

TEST_F(Program, FitsOneModel) {
  const Result r = run(std::string("fit demo -m boids --json ") + kQuick + "--out f");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_THAT(r.out, AllOf(HasSubstr("\"command\": \"fit\""), HasSubstr("\"rank\": 1")));
}

// Every job does its share, in any order; together they come to the files of one.
TEST_F(Program, MergesPartsOfAStudy) {
  const std::string study = "recover -m brownian,langevin --seeds 2 --agents 6 --frames 40 --max-evaluations 5 -q ";
  const Result whole = run(study + "--out whole");
  ASSERT_EQ(whole.code, 0) << whole.err;
  for (const char* part : {"3", "1", "2"}) {
    const Result r = run(study + "--out part-" + part + " --part " + part + "/3");
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_THAT(r.out, IsEmpty());
    EXPECT_FALSE(fs::exists(dir_ / ("part-" + std::string(part)) / "recovery.json")) << "a part is no result";
  }
  const Result merged = run("merge part-2 part-1 part-3 -q --out together");
  EXPECT_EQ(merged.code, 0) << merged.err;
  EXPECT_EQ(merged.out, whole.out);
  for (const char* file : {"recovery.json", "config.toml", "report.html"})
    EXPECT_EQ(content(dir_ / "together" / file), content(dir_ / "whole" / file)) << file;

  expect_refused("merge part-1 part-3 --out other", "part 2 of 3 is missing");
  expect_refused("merge part-1 part-1 part-2 part-3 --out other", "expected each part once");
  expect_refused("merge whole part-1 --out other", "whole: no finished part");
  run("recover -m brownian,langevin --seeds 3 --agents 6 --frames 40 --max-evaluations 5 -q --out else --part 1/3");
  expect_refused("merge part-2 part-3 else --out other", "another study");
  EXPECT_FALSE(fs::exists(dir_ / "other"));
  for (const char* part : {"0/3", "4/3", "1", "a/b", "1/3x", "1/"})
    expect_refused(study + "--out other --part " + part, "expected k/n with k from 1 to n");
}

}  // namespace
}  // namespace swarmfit::test
