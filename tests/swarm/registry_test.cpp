// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

#include "libswarm/model.h"
#include "libtrack/error.h"

namespace swarmfit {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string error_of(std::string_view text) {
  try {
    parse_model(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(Registry, FilesAndLinesAgree) {
  const std::filesystem::path room = std::filesystem::path(SWARMFIT_SOURCE_DIR) / "libswarm";
  std::set<std::string> files, lines, names;
  for (const auto& entry : std::filesystem::directory_iterator(room / "models"))
    if (entry.path().extension() == ".cpp") files.insert(entry.path().stem());
  std::ifstream def(room / "models.def");
  for (std::string line; std::getline(def, line);)
    if (std::smatch m; std::regex_match(line, m, std::regex(R"(MODEL\((\w+)\))"))) lines.insert(m[1]);
  for (const ModelSpec& spec : models()) names.emplace(spec.name);
  EXPECT_EQ(files, lines);
  EXPECT_EQ(names, lines);
}

TEST(ParseModel, CompletesAndNames) {
  const ModelChoice plain = parse_model("bswarm");
  EXPECT_EQ(plain.name, "bswarm");
  EXPECT_EQ(plain.options.at("noise"), "curl");
  const ModelChoice other = parse_model("bswarm[avoidance=none,noise=white,interaction=on]");
  EXPECT_EQ(other.name, "bswarm[noise=white,avoidance=none]");  // table order, defaults left out
  EXPECT_EQ(parse_model(other.name).options, other.options);
  EXPECT_EQ(other.spec, plain.spec);
  EXPECT_EQ(parse_model("langevin").options.size(), 0u);
}

TEST(ParseModel, ErrorsNameWhatIsLegal) {
  EXPECT_THAT(error_of("bswrm"), AllOf(HasSubstr("'bswrm'"), HasSubstr("expected one of bswarm, boids")));
  EXPECT_THAT(error_of("bswarm[nose=white]"), AllOf(HasSubstr("'nose'"), HasSubstr("expected one of noise, interaction")));
  EXPECT_THAT(error_of("bswarm[noise=pink]"),
              AllOf(HasSubstr("'pink'"), HasSubstr("expected one of curl, perlin, gaussian, white, ou, none")));
  EXPECT_THAT(error_of("bswarm[noise=white"), HasSubstr("no closing bracket"));
  EXPECT_THAT(error_of("bswarm[white]"), HasSubstr("'white' is not a setting"));
  EXPECT_THAT(error_of("bswarm[noise=white,noise=curl]"), HasSubstr("given twice"));
  EXPECT_THAT(error_of("langevin[noise=white]"), AllOf(HasSubstr("'noise'"), HasSubstr("no options")));
  EXPECT_THAT(error_of(""), HasSubstr("expected one of"));
}

// Described while the program runs, from text that is gone afterwards.
TEST(ParseModel, FindsModelsThatTheCallerDescribes) {
  std::vector<ModelSpec> mine(1);
  {
    const std::string name = "described in " + std::to_string(2026), value = "rather slow and quite long for a string";
    mine[0].name = name;
    mine[0].options = {{.name = "how", .values = {"fast", value}, .meaning = "pace"}};
    mine[0].parameters = {{.name = name + "'s own", .when = "how=fast"}};
  }
  const ModelChoice choice = parse_model("described in 2026[how=rather slow and quite long for a string]", mine);
  EXPECT_EQ(choice.spec, mine.data());
  EXPECT_EQ(choice.name, "described in 2026[how=rather slow and quite long for a string]");
  EXPECT_EQ(mine[0].find("described in 2026's own"), 0);
  EXPECT_FALSE(mine[0].uses(0, choice.options));
  EXPECT_EQ(parse_model("boids", mine).spec->name, "boids");
  EXPECT_THAT(error_of("described in 2026"), HasSubstr("unknown"));
}

TEST(ModelSpec, UsesFollowsTheOptions) {
  const auto uses = [](std::string_view model, std::string_view parameter) {
    const ModelChoice choice = parse_model(model);
    return choice.spec->uses(static_cast<std::size_t>(choice.spec->find(parameter)), choice.options);
  };
  EXPECT_TRUE(uses("bswarm", "gamma"));
  EXPECT_TRUE(uses("bswarm", "scale"));
  EXPECT_TRUE(uses("bswarm[noise=perlin]", "scale"));
  EXPECT_FALSE(uses("bswarm[noise=white]", "scale"));
  EXPECT_TRUE(uses("bswarm[noise=white]", "lambda"));
  EXPECT_FALSE(uses("bswarm[noise=white,noise_scaling=literal]", "lambda"));  // both conditions must hold
  EXPECT_FALSE(uses("bswarm", "lambda"));
  EXPECT_FALSE(uses("bswarm[interaction=off]", "chi_rep"));
  EXPECT_FALSE(uses("bswarm[avoidance=none]", "radius"));
  EXPECT_EQ(models()[0].find("no such"), -1);
}

TEST(Parameter, ScalesByPowers) {
  const Scales scales{.extent = 3, .spacing = 5, .speed = 2};  // T = 1.5
  const auto scale = [&](Unit unit, Parameter::Length length = Parameter::Length::extent) {
    Parameter p{};
    p.unit = unit;
    p.length = length;
    return p.scale(scales);
  };
  EXPECT_DOUBLE_EQ(scale({-1, 0}), 1. / 3);
  EXPECT_DOUBLE_EQ(scale({1, -2}), 3 / 2.25);
  EXPECT_DOUBLE_EQ(scale({1, 0}, Parameter::Length::spacing), 5);
  EXPECT_DOUBLE_EQ(scale({1, -1.5}), 3 / std::pow(1.5, 1.5));
  EXPECT_DOUBLE_EQ(scale({0, 0}), 1);
}

TEST(UnitNames, ReadLikeUnits) {
  EXPECT_EQ(to_string(Unit{1, 0}, "mm"), "mm");
  EXPECT_EQ(to_string(Unit{1, -2}, "mm"), "mm/s^2");
  EXPECT_EQ(to_string(Unit{-1, 0}, "m"), "1/m");
  EXPECT_EQ(to_string(Unit{1, -1.5}, "m"), "m/s^1.5");
  EXPECT_EQ(to_string(Unit{0, 1}, "m"), "s");
  EXPECT_EQ(to_string(Unit{0, 0}, "m"), "");
  EXPECT_EQ(to_string(Unit{-1, -1}, "m"), "1/(m·s)");
}

}  // namespace
TEST(Registry, VariantsSayWhatSetsThemApart) {
  EXPECT_EQ(summary_of(parse_model("vicsek")), "alignment with noise at constant speed");
  EXPECT_EQ(summary_of(parse_model("bswarm[noise=none,avoidance=none]")).substr(0, 61),
            "bswarm with no noise and no collision avoidance. Insect swarm");
  for (const ModelSpec& spec : models())
    for (const Option& o : spec.options)
      for (const std::string& value : o.values)
        EXPECT_EQ(summary_of(parse_model(spec.name + '[' + o.name + '=' + value + ']')).starts_with(spec.name + " with "),
                  value != o.values.front())
            << spec.name << ' ' << o.name << ' ' << value;
}

}  // namespace swarmfit
