// SPDX-License-Identifier: MIT
// The table of settings, as a whole: what every entry refuses, what config.toml keeps of it, what a protocol sets.
#include "cli/setting.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "cli/config_file.h"
#include "cli/program.h"
#include "libtrack/error.h"

namespace swarmfit::cli {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::Pair;
using Kind = Allowed::Kind;
using Words = std::vector<std::string>;

// The fewest words with which the command can be given, the name of `but` left out.
Words shortest(const Command& command, std::string_view but = "") {
  Words words{std::string(command.name)};
  for (const Setting& s : settings()) {
    if ((s.in & command.bit) == 0 || !s.required || s.name == but) continue;
    if (!is_positional(s)) words.push_back(flag_of(s));
    words.emplace_back(s.allowed.kind == Kind::choice ? s.allowed.choices.front() : "demo");
  }
  return words;
}

// What is said of these words; empty if nothing is wrong.
std::string complaint(const Words& words) {
  try {
    parse(words);
    return "";
  } catch (const InputError& e) {
    return e.what();
  }
}

std::string complaint_of(const Command& command, const Setting& s, const std::string& word) {
  Words words = shortest(command, s.name);
  if (s.allowed.kind == Kind::flag) {
    words.push_back(flag_of(s) + "=" + word);
  } else {
    words.push_back(flag_of(s));
    words.push_back(word);
  }
  return complaint(words);
}

template <class Visit>
void for_each_flag(Visit visit) {
  for (const Command& command : commands())
    for (const Setting& s : settings())
      if ((s.in & command.bit) != 0 && !is_positional(s)) visit(command, s);
}

bool is_number(const Setting& s) { return s.allowed.kind == Kind::whole || s.allowed.kind == Kind::number || s.allowed.kind == Kind::time; }

TEST(SettingTable, NamesASettingOncePerCommandAndSaysWhatItIs) {
  std::size_t count = 0;
  for (const Command& command : commands()) {
    std::set<std::string_view> names;
    for (const Setting& s : settings()) {
      if ((s.in & command.bit) == 0) continue;
      EXPECT_TRUE(names.insert(s.name).second) << command.name << ' ' << s.name;
      EXPECT_FALSE(s.help.empty()) << s.name;
      ++count;
    }
  }
  EXPECT_GT(count, 150U);
  for (const Setting& s : settings()) {
    EXPECT_NE(s.in & (kAll | kManual | kCompletion), 0U) << s.name;
    for (const std::string_view value : {s.initial, s.ren2016, s.elsewhere.initial}) {
      if (value.empty()) continue;
      EXPECT_THAT(checked(s, {std::string(value)}), ElementsAre(value)) << s.name << ": a default that is refused";
    }
  }
}

// Whatever is given: it is legal, or one line names the flag and says what was expected.
TEST(SettingTable, EveryFlagTakesAWordOrSaysWhatItExpected) {
  for_each_flag([](const Command& command, const Setting& s) {
    for (const std::string word :
         {"", "nan", "inf", "-inf", "-1", "1e300", "1e999", "0x10", "text", "1 2", "p=nan", "p=inf:1", "p=1:nan"}) {
      const std::string said = complaint_of(command, s, word);
      if (said.empty()) continue;
      const auto flag = flag_of(s), name = fmt::format("`{}`", s.name);
      EXPECT_TRUE(said.starts_with(flag) || said.starts_with(name)) << command.name << ' ' << flag << " '" << word << "': " << said;
      EXPECT_THAT(said, AnyOf(HasSubstr("expected"), HasSubstr("see --help"))) << command.name << ' ' << flag << " '" << word << "'";
      EXPECT_THAT(said, Not(HasSubstr("\n"))) << command.name << ' ' << flag;
      EXPECT_LT(said.size(), 400U) << said;
    }
  });
}

TEST(SettingTable, EveryNumberHasAnIntervalAndKeepsToIt) {
  for_each_flag([](const Command& command, const Setting& s) {
    if (!is_number(s)) return;
    const Allowed& a = s.allowed;
    ASSERT_TRUE(std::isfinite(a.lower) && std::isfinite(a.upper) && a.lower < a.upper) << s.name;
    for (const std::string word : {"", "nan", "inf", "-inf", "-1", "1e300", "1e999", "text", "1,5", "1 2", "0x1p3"}) {
      if (word == "-1" && a.lower <= -1) continue;
      EXPECT_THAT(complaint_of(command, s, word), HasSubstr("is not allowed; expected a"))
          << command.name << " --" << s.name << ' ' << word;
    }
    if (a.kind == Kind::whole) {
      EXPECT_THAT(complaint_of(command, s, "2.5"), HasSubstr("expected a whole number"));
    }
    if (a.open) {
      EXPECT_THAT(complaint_of(command, s, fmt::format("{}", a.lower)), HasSubstr("expected a")) << s.name;
    }
    if (a.upper < 1e18) {  // a double tells the next whole number
      EXPECT_EQ(complaint_of(command, s, fmt::format("{:.0f}", a.upper)), "") << command.name << ' ' << s.name;
      EXPECT_THAT(complaint_of(command, s, fmt::format("{:.0f}", 2 * a.upper + 1)), HasSubstr("expected a")) << s.name;
    }
  });
}

TEST(SettingTable, EveryChoiceIsTakenAndNoOther) {
  for_each_flag([](const Command& command, const Setting& s) {
    if (s.allowed.kind != Kind::choice) return;
    for (const auto choice : s.allowed.choices)
      EXPECT_THAT(complaint_of(command, s, std::string(choice)), Not(HasSubstr("is not known"))) << s.name;
    EXPECT_THAT(complaint_of(command, s, "foo"),
                AllOf(HasSubstr(flag_of(s) + ": 'foo' is not known; expected "), HasSubstr(s.allowed.choices.back())));
  });
}

TEST(SettingTable, SeedsHave64BitsAndTimesHaveUnits) {
  EXPECT_EQ(parse({"describe", "demo", "--seed", "18446744073709551615"})->common.seed, 18446744073709551615ULL);
  EXPECT_EQ(complaint({"describe", "demo", "--seed", "18446744073709551616"}),
            "--seed: '18446744073709551616' is not allowed; expected a whole number from 0 to 18446744073709551615");
  EXPECT_EQ(parse({"resume", "d", "--max-time", "1.5 MIN"})->max_time, 90);
  EXPECT_EQ(parse({"resume", "d", "--max-time", "2h"})->max_time, 7200);
  EXPECT_THAT(complaint({"resume", "d", "--max-time", "1ms"}), HasSubstr("90, 45min or 12h"));
  EXPECT_THAT(complaint({"resume", "d", "--max-time", "1e300h"}), HasSubstr("at most 1e+09 s"));
}

// ---- config.toml --------------------------------------------------------------------------------------------------------------

const Words kOdd = {"q\"uote'", "back\\slash\\n", "two\nlines\r", "tab\t", "Schwärme µm 群", "# no comment", "a,b",
                    "[x]",      " blanks ",       "a = b",        "'",     "\x7f\x01"};

// Legal values that are not the default, one list per file that is to be tried.
std::vector<Words> samples(const Setting& s) {
  const Allowed& a = s.allowed;
  if (a.kind == Kind::flag) return {{"true"}};
  if (a.kind == Kind::choice) return {{std::string(a.choices.back())}};
  if (a.kind == Kind::whole && a.upper > 1e19) return {{"18446744073709551615"}, {"9223372036854775807"}, {"9223372036854775808"}};
  if (a.kind == Kind::whole) return {{fmt::format("{:.0f}", a.upper)}, {fmt::format("{:.0f}", a.lower)}};
  if (a.kind == Kind::number)
    return {{fmt::format("{}", a.upper)}, {fmt::format("{}", a.lower + 0.1)}, {fmt::format("{}", a.lower + 1e-7)}};
  if (a.many) return {kOdd};
  std::vector<Words> all;
  for (const auto& word : kOdd) all.push_back({word});
  return all;
}

TEST(ConfigFile, KeepsEveryValueOfEverySetting) {
  int tried = 0;
  for (const Command& command : commands()) {
    if ((command.bit & kComparisons) == 0) continue;
    for (const Setting& s : settings()) {
      if ((s.in & command.bit) == 0 || !s.travels) continue;
      for (const Words& words : samples(s)) {
        Values values;
        values.set(s.name, words);
        const std::string text = config_toml(std::string(command.name), config_of(command.bit, values));
        const Values back = read_config("config.toml", text, command);
        EXPECT_EQ(back.words(s.name), words) << text;
        EXPECT_EQ(text, config_toml(std::string(command.name), config_of(command.bit, back)));
        ++tried;
      }
    }
  }
  EXPECT_GT(tried, 300);
}

struct WithFile : testing::Test {
  std::string path = (fs::temp_directory_path() /
                      fmt::format("swarmfit_{}_{}.toml", getpid(), testing::UnitTest::GetInstance()->current_test_info()->name()))
                         .string();
  void TearDown() override { fs::remove(path); }
  void write(const std::string& text) const { std::ofstream(path, std::ios::binary) << text; }
};

TEST_F(WithFile, RepeatsWhatWasGiven) {
  for (const Words& words : std::vector<Words>{
           {"compare",
            kOdd[0],
            kOdd[1],
            kOdd[4],
            "-m",
            "bswarm[noise=white],boids",
            "--unit",
            kOdd[2],
            "--columns",
            kOdd[5],
            "--delimiter",
            "\\",
            "--fps",
            "29.97",
            "--set",
            "tau=0.3",
            "boids.radius=1",
            "--bounds",
            "bswarm[noise=white].gamma=0.001:0.1",
            "--fix",
            "k,l",
            "--holdout",
            "yes",
            "--posterior",
            "--error-limit",
            "0.25",
            "--lags",
            "4,1",
            "--scoring",
            "pooled",
            "--bins",
            "77",
            "--seed",
            "18446744073709551615",
            "--common"},
           {"power", "[x]", "--preset", "noise", "--protocol", "ren2016", "--normalisation", "none", "--seeds", "7", "--steps", "12"},
           {"recover", "-m", "brownian,langevin", "--unit", kOdd[1], "--set", "brownian.tau=0.5", "--lags", "1,4", "--scoring", "pooled"},
           {"fit", "demo", "-m", "boids", "--arena", "box", "--smooth", "0.30"}}) {
    const auto given = parse(words);
    write(config_toml(given->command, given->config));
    const auto again = parse({given->command, "--config", path});
    EXPECT_EQ(again->config, given->config);
    EXPECT_EQ(again->recordings, given->recordings);
    EXPECT_EQ(again->read.unit, given->read.unit);
    EXPECT_EQ(again->compare.requests.bounds, given->compare.requests.bounds);
    EXPECT_EQ(again->compare.seed, given->compare.seed);
  }
}

TEST_F(WithFile, FlagsWinOverTheFile) {
  write("[fit]\nDATA = [\"a.csv\"]\nmodel = \"boids\"\nseed = 4\nset = [\"p=1\", \"q=2\"]\nposterior = true\nlags = 4\n");
  const auto a = parse({"fit", "b.csv", "--seed", "5", "--set", "r=3", "--config", path});
  EXPECT_THAT(a->recordings, ElementsAre("b.csv"));
  EXPECT_EQ(a->common.seed, 5U);
  EXPECT_THAT(a->compare.requests.set, ElementsAre(Pair("r", 3)));
  EXPECT_TRUE(a->compare.posterior);
  EXPECT_THAT(a->compare.lags, ElementsAre(4));
}

TEST_F(WithFile, SaysWhereAFileIsWrong) {
  const auto said = [&](const std::string& text) {
    write(text);
    return complaint({"fit", "demo", "-m", "boids", "--config", path});
  };
  EXPECT_THAT(said("[fit]\nseed = 1\nsed = 2\n"),
              AllOf(HasSubstr(path + ":3:"), HasSubstr("'sed' is not a setting of fit; expected one of DATA, model")));
  EXPECT_THAT(said("[fit]\nunit = \"m\nseed = 1\n"), AllOf(HasSubstr(path + ":2:"), HasSubstr("expected TOML")));
  EXPECT_THAT(said("[compare]\nseed = 1\n"), HasSubstr("says nothing of fit; expected settings under [fit]"));
  EXPECT_THAT(said("seed = 1\n"), HasSubstr("expected settings under [fit]"));
  EXPECT_THAT(said("[fit]\nseed = {a = 1}\n"), HasSubstr("neither text nor number"));
  EXPECT_THAT(said("[fit]\nbins = nan\n"), HasSubstr("--bins: 'nan' is not allowed; expected a whole number"));
  EXPECT_THAT(said("[fit]\nbins = [1, 2]\n"), HasSubstr("--bins: 2 values; expected one"));
  EXPECT_THAT(complaint({"fit", "demo", "-m", "boids", "--config", "no.toml"}), HasSubstr("no.toml"));
}

// As the version before this table wrote them.
TEST_F(WithFile, ReadsWhatEarlierVersionsWrote) {
  const std::string compare =
      "# A run of swarmfit: `swarmfit compare --config config.toml --out NEW_FOLDER` repeats it.\n[compare]\nDATA = [\"demo\"]\n"
      "model = [\"boids\", \"bswarm[noise=white]\"]\nframes = \"0:80\"\nseed = 1\nprotocol = \"default\"\nbudget = \"quick\"\n"
      "max-evaluations = 20\nreplicates = 1\nset = [\"tau=0.3\"]\nbounds = [\"bswarm.gamma=0.001:0.1\"]\npresence = \"recorded\"\n"
      "arena = \"open\"\nobs-noise = \"estimate\"\nerror-limit = 0.5\nresolution = \"recording\"\nscoring = \"proper\"\n"
      "calibration = \"mean\"\nlags = \"1\"\nsteps = \"auto\"\nvelocity = \"difference\"\nnormalisation = \"reference\"\n";
  write(compare);
  // The bytes, too, but for what can be set since then.
  std::string today = config_toml("compare", parse({"compare", "--config", path})->config);
  for (const std::string line :
       {"search = \"full\"\n", "searched = \"all\"\n", "entry = \"estimated\"\n", "holdout = \"auto\"\n", "searches = 1\n"}) {
    const auto at = today.find(line);
    ASSERT_NE(at, today.npos) << line;
    today.erase(at, line.size());
  }
  EXPECT_EQ(today, compare);
  const std::string recover =
      "# A run of swarmfit: `swarmfit recover --config config.toml --out NEW_FOLDER` repeats it.\n[recover]\n"
      "model = [\"brownian\", \"langevin\"]\nplant = [\"brownian\", \"langevin\"]\nseed = 1\nseeds = 2\nagents = 6\nframes = 50\nfps = "
      "100\n"
      "dims = 3\nfilm-noise = 0\ndropout = 0\nspread = 2\nextent = 100\nspacing = 70\nspeed = 225\nunit = \"mm\"\nprotocol = \"default\"\n"
      "budget = \"quick\"\nmax-evaluations = 10\nlags = \"1,4\"\nresolution = \"none\"\n";
  write(recover);
  const std::string now = config_toml("recover", parse({"recover", "--config", path})->config);
  EXPECT_TRUE(same_config(now, recover)) << now;
  EXPECT_FALSE(same_config(now, recover + "scoring = \"pooled\"\n"));
}

// The models and parameters of the paper, and no others; docs/ren2016.md.
TEST(Protocol, Ren2016IsTheLetter) {
  const auto names = [](const Arguments& a) {
    std::vector<std::string> out;
    for (const ModelChoice& model : a.compare.models) out.push_back(model.name);
    return out;
  };
  const auto models = parse({"compare", "demo", "--preset", "models", "--protocol", "ren2016"});
  EXPECT_THAT(names(*models), ElementsAre("bswarm", "noise_aware", "boids", "rvo", "brownian"));
  EXPECT_TRUE(models->compare.evolution_only);
  EXPECT_TRUE(models->compare.requests.published);
  EXPECT_EQ(models->compare.conditions.entry, EntryVelocity::difference);
  const auto noises = parse({"compare", "demo", "--protocol", "ren2016", "--preset", "noise"});
  EXPECT_THAT(names(*noises), ElementsAre("bswarm", "bswarm[noise=perlin]", "bswarm[noise=gaussian,noise_scaling=literal]",
                                          "bswarm[noise=white,noise_scaling=literal]"));
  const auto ours = parse({"compare", "demo", "--preset", "models"});
  EXPECT_THAT(names(*ours), testing::Contains("langevin"));
  EXPECT_FALSE(ours->compare.evolution_only);
  EXPECT_FALSE(parse({"compare", "demo", "--preset", "models", "--protocol", "ren2016", "--search", "full"})->compare.evolution_only);
}

TEST(ConfigFile, RefusesWhatNoTomlFileCanHold) {
  EXPECT_THAT(complaint({"fit", "demo", "-m", "boids", "--unit", "\xff"}), AllOf(HasSubstr("--unit: "), HasSubstr("expected text")));
}

// ---- protocols ----------------------------------------------------------------------------------------------------------------

TEST(Protocol, SetsWhatIsNotGivenAndOnlyThat) {
  const auto value = [](const Arguments& a, const std::string& name) {
    for (const auto& [key, toml] : a.config)
      if (key == name) return toml;
    return std::string();
  };
  const auto plain = parse({"fit", "demo", "-m", "boids"}), literal = parse({"fit", "demo", "-m", "boids", "--protocol", "ren2016"});
  for (const Setting& s : settings()) {
    if (s.ren2016.empty()) continue;
    EXPECT_THAT(value(*plain, std::string(s.name)), HasSubstr(s.initial));
    EXPECT_THAT(value(*literal, std::string(s.name)), HasSubstr(s.ren2016));
  }
  EXPECT_EQ(value(*plain, "scoring"), "\"proper\"");
  EXPECT_EQ(value(*literal, "scoring"), "\"pooled\"");
  EXPECT_EQ(value(*parse({"fit", "demo", "-m", "boids", "--normalisation", "separate"}), "scoring"), "\"pooled\"");
  const auto mixed = parse({"fit", "demo", "-m", "boids", "--protocol", "ren2016", "--normalisation", "reference"});
  EXPECT_EQ(value(*mixed, "scoring"), "\"proper\"");
  EXPECT_EQ(value(*mixed, "lags"), "\"1\"");
  EXPECT_EQ(literal->compare.budget.passes, 10);
  EXPECT_FALSE(literal->compare.conditions.rounding);
  EXPECT_TRUE(literal->compare.binning.pooled);
  const auto recovered = parse({"recover", "-m", "boids,brownian", "--protocol", "ren2016"});
  EXPECT_EQ(recovered->compare.error_limit, 1) << "it governs what recover does not offer";
  EXPECT_EQ(recovered->compare.binning.normalisation, Normalisation::separate);
  EXPECT_EQ(value(*recovered, "lags"), "") << "recover keeps what was given";
  EXPECT_THAT(complaint({"fit", "demo", "-m", "boids", "--scoring", "proper", "--normalisation", "separate"}),
              HasSubstr("expected --scoring pooled"));
  const auto pair = parse({"evaluate", "demo", "demo"});
  EXPECT_THAT(pair->compare.lags, ElementsAre(1));
}

}  // namespace
}  // namespace swarmfit::cli
