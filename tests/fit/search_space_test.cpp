// SPDX-License-Identifier: MIT
#include "fit/model_fit/search_space.h"

#include <gmock/gmock.h>

#include "libtrack/error.h"

namespace swarmfit {
namespace {

using ::testing::HasSubstr;

const Scales kScales{100, 50, 200};  // L = 100, NND = 50, V = 200: T = 0.5, A = 400

std::size_t row(const ModelChoice& model, const char* name) { return static_cast<std::size_t>(model.spec->find(name)); }

TEST(SearchSpace, BoundsAreStatedInTheRecordingsScales) {
  const auto model = parse_model("bswarm");
  const SearchSpace space(model, kScales, {});
  const auto at_zero = space.parameters(Point::Zero(space.dimensions()));
  const auto at_one = space.parameters(Point::Ones(space.dimensions()));
  const auto& gamma = model.spec->parameters[row(model, "gamma")];
  EXPECT_NEAR(at_zero[row(model, "gamma")], gamma.fit.lower / 100, 1e-15);  // 1/L
  EXPECT_NEAR(at_one[row(model, "gamma")], gamma.fit.upper / 100, 1e-12);
  const auto& chi = model.spec->parameters[row(model, "chi_att")];
  EXPECT_NEAR(at_one[row(model, "chi_att")], chi.fit.upper * 400, 1e-9);  // A = L/T²
  const auto& radius = model.spec->parameters[row(model, "r_rep")];
  EXPECT_NEAR(at_one[row(model, "r_rep")], radius.fit.upper * 50, 1e-9);  // NND
}

TEST(SearchSpace, PointIsTheInverseOfParameters) {
  const auto model = parse_model("bswarm");
  const SearchSpace space(model, kScales, {});
  Point x(space.dimensions());
  for (Index k = 0; k < x.size(); ++k) x[k] = (static_cast<double>(k) + 0.5) / static_cast<double>(x.size());
  EXPECT_LT((space.point(space.parameters(x)) - x).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(SearchSpace, LogarithmicAxisIsHalvedAtItsGeometricMean) {
  const auto model = parse_model("bswarm");
  const SearchSpace space(model, kScales, {});
  const auto middle = space.parameters(Point::Constant(space.dimensions(), 0.5));
  const auto& gamma = model.spec->parameters[row(model, "gamma")];
  EXPECT_NEAR(middle[row(model, "gamma")], std::sqrt(gamma.fit.lower * gamma.fit.upper) / 100, 1e-12);
}

// Tables S17 to S20 of Ren et al. 2016.
TEST(SearchSpace, PublishedParametersAlone) {
  const auto searched = [](const char* name, const ParameterRequests& requests) {
    const auto model = parse_model(name);
    std::vector<std::string> out;
    const SearchSpace space(model, kScales, requests);
    for (const std::size_t p : space.searched()) out.push_back(model.spec->parameters[p].name);
    return out;
  };
  ParameterRequests published;
  published.published = true;
  EXPECT_THAT(searched("bswarm", published),
              testing::UnorderedElementsAre("gamma", "noise", "scale", "chi_rep", "chi_att", "r_rep", "r_att"));
  EXPECT_THAT(searched("noise_aware", published), testing::UnorderedElementsAre("scale", "gain"));
  EXPECT_THAT(searched("boids", published), testing::UnorderedElementsAre("speed", "radius"));
  EXPECT_THAT(searched("rvo", published), testing::UnorderedElementsAre("neighbour_distance", "max_neighbours", "radius", "max_speed"));
  EXPECT_THAT(searched("brownian", published), testing::UnorderedElementsAre("gamma1", "gamma2", "D", "C_r"));
  EXPECT_EQ(searched("langevin", published), searched("langevin", {})) << "the paper did not fit it";
  published.bounds["tau"] = {0.1, 1};
  EXPECT_THAT(searched("boids", published), testing::Contains("tau")) << "a request wins";
}

// A hundredth of the upper bound is a tenth of the way: weak forces have room.
TEST(SearchSpace, StrengthsFromZeroAreSearchedByTheirSquareRoots) {
  const auto model = parse_model("bswarm");
  const SearchSpace space(model, kScales, {});
  const auto tenth = space.parameters(Point::Constant(space.dimensions(), 0.1));
  const auto& chi = model.spec->parameters[row(model, "chi_att")];
  ASSERT_EQ(chi.fit.lower, 0);
  EXPECT_NEAR(tenth[row(model, "chi_att")], chi.fit.upper * 400 / 100, 1e-9);
}

// A speed that everybody keeps can be read off the recording, and is searched around what that shows.
TEST(SearchSpace, AConstantSpeedIsSearchedAmongRecordedOnes) {
  for (const char* name : {"boids", "vicsek", "zonal"}) {
    const auto model = parse_model(name);
    const auto range = [&](double unlike) {
      const SearchSpace space(model, {100, 50, 200, unlike}, {});
      const std::size_t p = row(model, "speed");
      return std::pair{space.parameters(Point::Zero(space.dimensions()))[p], space.parameters(Point::Ones(space.dimensions()))[p]};
    };
    EXPECT_NEAR(range(0).first, 200 * std::exp(-0.005), 1e-9) << name;
    EXPECT_NEAR(range(0).second, 200 * std::exp(0.005), 1e-9) << name;
    EXPECT_NEAR(range(0.1).second, 200 * std::exp(0.305), 1e-9) << name;
    EXPECT_EQ(range(1).second, 4 * 200) << name;  // as the table says
  }
  ParameterRequests requests;
  requests.bounds["speed"] = {1, 1000};  // who asks for more gets it
  const auto model = parse_model("boids");
  const SearchSpace space(model, {100, 50, 200, 0}, requests);
  EXPECT_NEAR(space.parameters(Point::Ones(space.dimensions()))[row(model, "speed")], 1000, 1e-9);
}

TEST(SearchSpace, AnAxisFromElsewhereIsLinear) {
  ParameterRequests requests;
  requests.bounds["gamma1"] = {-10, 10};
  const auto model = parse_model("brownian");
  const SearchSpace space(model, kScales, requests);
  EXPECT_NEAR(space.parameters(Point::Constant(space.dimensions(), 0.25))[row(model, "gamma1")], -5, 1e-12);
}

TEST(SearchSpace, OnlyParametersThatTheSettingsUseAreSearched) {
  const auto curl = parse_model("bswarm"), white = parse_model("bswarm[noise=white]"), alone = parse_model("bswarm[interaction=off]");
  const auto searches = [](const ModelChoice& m, const char* name) {
    const auto rows = SearchSpace(m, kScales, {}).searched();
    return std::count(rows.begin(), rows.end(), row(m, name)) == 1;
  };
  EXPECT_TRUE(searches(curl, "scale"));
  EXPECT_FALSE(searches(curl, "lambda"));
  EXPECT_FALSE(searches(white, "scale"));
  EXPECT_TRUE(searches(white, "lambda"));
  EXPECT_FALSE(searches(alone, "chi_att"));
}

TEST(SearchSpace, SaysWhatALowerBoundMeansWhereAFitEndsThere) {
  const auto model = parse_model("bswarm");
  const SearchSpace space(model, kScales, {});
  const auto meaning = [&](double u) {
    for (const auto& r : space.describe(Point::Constant(space.dimensions(), u), "mm"))
      if (r.name == "scale") return r.at_lower;
    return std::string("no scale");
  };
  EXPECT_THAT(meaning(0), HasSubstr("white noise"));
  EXPECT_EQ(meaning(0.5), "");
  EXPECT_EQ(meaning(1), "");
}

TEST(SearchSpace, SetFixAndBoundsAreObeyed) {
  const auto model = parse_model("bswarm");
  ParameterRequests requests;
  requests.set["gamma"] = 0.03;
  requests.fix["bswarm.scale"] = true;
  requests.bounds["chi_ali"] = {10, 20};
  const SearchSpace space(model, kScales, requests);
  const auto low = space.parameters(Point::Zero(space.dimensions()));
  const auto high = space.parameters(Point::Ones(space.dimensions()));
  EXPECT_EQ(low[row(model, "gamma")], 0.03);
  EXPECT_EQ(high[row(model, "gamma")], 0.03);
  EXPECT_EQ(low[row(model, "scale")], high[row(model, "scale")]);
  EXPECT_EQ(low[row(model, "chi_ali")], 10);
  EXPECT_EQ(high[row(model, "chi_ali")], 20);
}

TEST(SearchSpace, DescribeMarksWhatLiesOnABound) {
  const auto model = parse_model("bswarm");
  const SearchSpace space(model, kScales, {});
  Point x = Point::Constant(space.dimensions(), 0.5);
  x[0] = 0.999;
  const auto rows = space.describe(x, "mm");
  EXPECT_EQ(rows.front().name, "gamma");
  EXPECT_TRUE(rows.front().at_bound);
  EXPECT_EQ(rows.front().unit, "1/mm");
  EXPECT_FALSE(rows[1].at_bound);
}

TEST(SearchSpace, EmptyBoundsAreRefused) {
  ParameterRequests requests;
  requests.bounds["gamma"] = {2, 1};
  EXPECT_THROW(SearchSpace(parse_model("bswarm"), kScales, requests), InputError);
}

std::string refusal(const char* model, const ParameterRequests& requests) {
  try {
    SearchSpace(parse_model(model), kScales, requests);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(SearchSpace, IllegalValuesAreRefused) {
  const auto set = [](const char* name, double value) { return ParameterRequests{{{name, value}}, {}, {}}; };
  EXPECT_THAT(refusal("boids", set("speed", -5)), HasSubstr("`set` speed=-5: is not allowed; expected a number greater than 0"));
  EXPECT_THAT(refusal("boids", set("speed", 0)), HasSubstr("greater than 0"));
  EXPECT_THAT(refusal("bswarm", set("chi_rep", -1)), HasSubstr("at least 0"));
  EXPECT_THAT(refusal("rvo", set("max_neighbours", 2.5)), HasSubstr("a whole number"));
  EXPECT_THAT(refusal("boids", set("tau", std::nan(""))), HasSubstr("not allowed"));
  EXPECT_THAT(refusal("boids", {{}, {}, {{"radius", {-1, 1}}}}), HasSubstr("`bounds` radius=-1"));
  EXPECT_EQ(refusal("brownian", set("gamma1", -5)), "") << "friction";
  EXPECT_EQ(refusal("boids", {{}, {}, {{"radius", {0, 1}}}}), "");
}

// Neither recordings nor scenes have stimuli yet.
TEST(SearchSpace, RefusesWhatWouldDoNothing) {
  EXPECT_EQ(refusal("bswarm", {{{"chi_res", 4}}, {}, {}}),
            "`set` chi_res=4: would do nothing, as there are no stimuli here; expected 0, or no chi_res");
  EXPECT_THAT(refusal("bswarm", {{}, {}, {{"r_res", {0, 3}}}}), HasSubstr("`bounds` r_res=3: would do nothing"));
  EXPECT_EQ(refusal("bswarm", {{{"chi_res", 0}}, {}, {}}), "");
  EXPECT_EQ(refusal("bswarm", {{}, {{"chi_res", true}}, {}}), "");
}

TEST(CheckRequests, NamesTheParametersThereAre) {
  ParameterRequests requests;
  requests.set["gama"] = 1;
  try {
    check_requests(requests, {parse_model("bswarm")});
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("`set` gama"));
    EXPECT_THAT(e.what(), HasSubstr("gamma"));
  }
}

}  // namespace
}  // namespace swarmfit
