// SPDX-License-Identifier: MIT
// The table of keys against what files say, the reader asks for and the manual tells.
#include "libswarm/scenario/keys.h"

#include <gmock/gmock.h>

#include "libswarm/scenario/node.h"
#include "libswarm/scenario/read.h"
#include "libswarm/temperature.h"
#include "libtrack/error.h"
#include "libtrack/file.h"

namespace swarmfit {
namespace {

// Every key below this node; those of tables with names of their own are theirs.
void expect_known(const Node& node, const std::string& heading, const std::string& file) {
  const auto* entries = std::get_if<Node::Entries>(&node.value);
  for (std::size_t k = 0; entries && k < entries->keys.size(); ++k) {
    const std::string& key = entries->keys[k];
    const Node& value = entries->values[k];
    if (heading == "parameters" || heading == "schedule") continue;
    const std::string inner = heading.empty() ? key : heading + "." + key;
    const auto* items = std::get_if<Node::Array>(&value.value);
    const bool names = heading == "expect";
    const bool argument = heading.starts_with("expect.");
    if (!names && !argument) {
      EXPECT_NE(find_scenario_key("[" + heading + "]", key), nullptr) << file << ": " << heading << " " << key;
    }
    if (items && !items->empty() && std::holds_alternative<Node::Entries>(items->front().value))
      for (const Node& item : *items) expect_known(item, inner, file);
    else
      expect_known(value, inner, file);
  }
}

TEST(ScenarioKeys, KnowWhatFilesSay) {
  for (const ScenarioFile& file : scenario_files())
    expect_known(parse_toml(std::string(file.name), std::string(file.text)), "", std::string(file.name));
}

TEST(ScenarioKeys, StandInTheManual) {
  const std::string manual = read_file(SWARMFIT_SOURCE_DIR "/docs/scenarios.md");
  for (const ScenarioKey& key : scenario_keys())
    EXPECT_TRUE(manual.find("`" + std::string(key.name) + "`") != manual.npos || manual.find("[" + std::string(key.name)) != manual.npos)
        << key.of << " " << key.name;
}

TEST(ScenarioKeys, AreAskedForByTheReader) {
  // What the reader refuses, it lists those that it asked for: a key of the table that nobody asks for is missing there.
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      read_scenario("a.toml", "title = \"t\"\nmodel = \"bswarm\"\n" + text);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  const std::string root = refusal("[nonsense]\n");
  for (const ScenarioKey& key : scenario_keys()) {
    if (!key.of.empty() || key.name == "bounds") continue;
    EXPECT_THAT(root, ::testing::HasSubstr(std::string(key.name)));
  }
  const std::string stimulus = refusal("[[stimulus]]\nkind = \"repel\"\nat = [0, 0, 0]\nnonsense = 1\n");
  for (const char* name : {"kind", "path", "lead", "ring", "wander", "at", "velocity", "from", "until"})
    EXPECT_THAT(stimulus, ::testing::HasSubstr(name));
}

TEST(ScenarioKeys, RangesAndWordsHold) {
  const auto read = [](const std::string& text) { read_scenario("a.toml", "title = \"t\"\nmodel = \"brownian\"\n" + text); };
  EXPECT_THROW(read("fps = 0\n"), InputError);
  EXPECT_THROW(read("frames = 10000001\n"), InputError);
  EXPECT_THROW(read("[start]\nshape = \"ring\"\nradius = 0\n"), InputError) << "a ball may have none, a ring not";
  EXPECT_THROW(read("[start]\nshape = \"cube\"\n"), InputError);
  EXPECT_NO_THROW(read("seed = 9223372036854775807\n"));
}

// The parabola's top and its ends, from the spec of the paper; and what a file makes of it.
TEST(Temperature, SaysHowManyInsectsThereAre) {
  EXPECT_NEAR(insects_at(22.2), 19.43, 0.005);
  EXPECT_GT(insects_at(8.75), 0);
  EXPECT_EQ(insects_at(8.73), 0);
  EXPECT_GT(insects_at(35.65), 0);
  EXPECT_EQ(insects_at(35.67), 0);
  const std::string top = "title = \"t\"\nmodel = \"brownian\"\n";
  EXPECT_EQ(read_scenario("a.toml", top + "[temperature]\ncelsius = 22.2\nvolume = 10\n").agents(), 194);
  EXPECT_THAT([&] { read_scenario("a.toml", top + "[temperature]\ncelsius = 40\n"); },
              ::testing::ThrowsMessage<InputError>(
                  ::testing::HasSubstr("a.toml:4:11: [temperature] celsius = 40 makes 0 insects; expected 1 to 10000000")));
  EXPECT_THROW(read_scenario("a.toml", top + "agents = 5\n[temperature]\ncelsius = 20\n"), InputError);
  const auto refused = [&](const std::string& lines) {
    try {
      read_scenario("a.toml", top + "agents = 5\n[temperature]\n" + lines);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused("celsius = 20\nfollow = \"l_r\"\nunit_volume = 2\n"), "");
  EXPECT_THAT(refused("celsius = 20\nfollow = \"wings\"\n"),
              ::testing::HasSubstr("a.toml:6:10: [temperature] follow: wings: brownian has no such parameter"));
  EXPECT_THAT(refused("celsius = 20\nfollow = \"l_r, gamma1\"\n"),
              ::testing::HasSubstr("gamma1 is not a length; expected radii of brownian"));
  EXPECT_THAT(refused("celsius = 20\nfollow = \" \"\n"), ::testing::HasSubstr("expected radii"));
  EXPECT_THAT(refused("celsius = 50\nfollow = \"l_r\"\n"), ::testing::HasSubstr("leaves no insects"));
  EXPECT_THAT(refused("celsius = 20\nfollow = \"l_r\"\nvolume = 2\n"), ::testing::HasSubstr("volume"));
}

}  // namespace
}  // namespace swarmfit
