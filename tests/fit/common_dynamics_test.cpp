// SPDX-License-Identifier: MIT
#include "fit/compare/common_dynamics.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "libtrack/error.h"
#include "tests/fit/planted.h"

namespace swarmfit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

CompareOptions of(const std::vector<std::string>& models) {
  CompareOptions o;
  for (const auto& name : models) o.models.push_back(parse_model(name));
  o.budget = {"tiny", {8, 2, 1}, {4, 1, 1}, 1, 2, 1};
  o.bootstrap_recordings = 9;
  return o;
}

TEST(CommonDynamics, WhatEveryNoiseOfBswarmSharesIsTheRestOfIts) {
  const auto o = of({"bswarm", "bswarm[noise=perlin]", "bswarm[noise=white]"});
  const Scales scales{100, 50, 200};
  EXPECT_THAT(shared_parameters(o.models, scales, {}), ElementsAre("gamma", "chi_rep", "chi_att", "r_rep", "r_att", "radius"));
  ParameterRequests fixed;
  fixed.fix["gamma"] = true;
  EXPECT_THAT(shared_parameters(o.models, scales, fixed), ElementsAre("chi_rep", "chi_att", "r_rep", "r_att", "radius"));
}

TEST(CommonDynamics, AllModelsGetTheFirstOnesValuesAndSearchTheRest) {
  const Tracks recording = test::planted_swarm(3);
  auto o = of({"bswarm", "bswarm[noise=white]"});
  o.requests.bounds["gamma"] = {0.005, 0.02};
  o.requests.set["bswarm.gamma"] = 0.006;  // where its search starts, and no more
  CompareOptions alone = o;
  alone.models.resize(1);
  const Comparison first = compare(recording, alone);
  const CompareOptions common = with_common_dynamics(recording, o);
  const Comparison both = compare(recording, common);
  ASSERT_EQ(both.run.common.size(), 6u);
  for (const ModelFit& fit : both.models)
    for (const ParameterResult& p : fit.parameters) {
      const bool shared = std::find(both.run.common.begin(), both.run.common.end(), p.name) != both.run.common.end();
      if (!shared) continue;
      EXPECT_FALSE(p.fitted) << fit.model << ' ' << p.name;
      const auto& of_first = first.models.front().parameters;
      const auto same = std::find_if(of_first.begin(), of_first.end(), [&](const ParameterResult& q) { return q.name == p.name; });
      EXPECT_EQ(p.value, same->value) << fit.model << ' ' << p.name;
    }
  EXPECT_THAT(both.run.searched, ElementsAre(ElementsAre("noise", "scale"), ElementsAre("lambda")));
  EXPECT_THAT(both.warnings, ::testing::Contains(HasSubstr("were fitted with bswarm alone")));
}

std::string refusal(const std::vector<std::string>& models, const ParameterRequests& requests = {}) {
  auto o = of(models);
  o.requests = requests;
  try {
    with_common_dynamics(test::planted_swarm(3), o);
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(CommonDynamics, RefusesWhatCannotShare) {
  EXPECT_THAT(refusal({"bswarm", "boids"}), HasSubstr("bswarm and boids are different models"));
  EXPECT_THAT(refusal({"bswarm", "bswarm[noise=none]"}), HasSubstr("bswarm[noise=none] has no searched parameter of its own"));
  ParameterRequests all;
  for (const char* name : {"gamma", "chi_rep", "chi_att", "r_rep", "r_att", "radius"}) all.fix[name] = true;
  EXPECT_THAT(refusal({"bswarm", "bswarm[noise=white]"}, all), HasSubstr("share no parameter"));
}

}  // namespace
}  // namespace swarmfit
