// SPDX-License-Identifier: MIT
#include "fit/experiment/run_features.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/model_fit/parameter_posterior.h"
#include "tests/fit/planted.h"

namespace swarmfit {
namespace {

using Eigen::VectorXd;

// Four animals on a circle about the origin: everything about their accelerations is known.
Tracks circling(double radius, double turn, int frames) {
  TrackColumns c;
  c.names = {"a", "b", "c", "d"};
  c.pos.resize(4 * frames, 3);
  for (int f = 0; f < frames; ++f)
    for (int k = 0; k < 4; ++k) {
      const double angle = turn * f + std::acos(0.0) * k;
      c.track.push_back(static_cast<std::uint32_t>(k));
      c.frame.push_back(f);
      c.pos.row(4 * f + k) << radius * std::cos(angle), radius * std::sin(angle), 0.0;
    }
  TrackMeta meta;
  meta.dims = 2;
  meta.dt = 0.1;
  return {c, meta};
}

TEST(RunFeatures, OfCirclesAreInClosedForm) {
  constexpr double kRadius = 3, kTurn = std::numbers::pi / 20;
  const Tracks recording = circling(kRadius, kTurn, 81);
  ConditionOptions options;
  options.error = ConditionOptions::Error::none;
  const Conditions c = make_conditions(recording, options);
  const Target target(metric_samples(recording, c.metrics), {});
  const VectorXd f = RunFeatures(c, target)(recording);
  const Index n = f.size();
  const double force = c.scales.speed * c.scales.speed / c.scales.extent;
  const double acceleration = 2 * kRadius * (1 - std::cos(kTurn)) / 0.01 / force;
  EXPECT_NEAR(f[n - 1], 2 * std::log(acceleration), 1e-6);
  EXPECT_NEAR(f[n - 2], 0, 1e-3) << "the radius is the recorded one";
  EXPECT_NEAR(f[n - 3] + f[n - 4], 0, 1e-6) << "a neighbour a quarter turn away accelerates at right angles";
  EXPECT_NEAR(f[n - 5], std::cos(kTurn), 1e-9) << "from one frame to the next the acceleration turns";
  double outward = 0;
  for (Index q = n - 22; q < n - 18; ++q) outward = std::min(outward, f[q]);
  EXPECT_NEAR(outward, std::asinh(-acceleration), 1e-6) << "towards the middle of the circle";
}

struct SmallFit {
  ModelChoice model = parse_model("brownian");
  Conditions conditions;
  Target target;
  SearchSpace space;
  Objective objective;
  explicit SmallFit(const Tracks& recording)
      : conditions(make_conditions(recording, {})),
        target(metric_samples(conditions.recording, conditions.metrics), {}),
        space(model, conditions.scales, {}),
        objective(model, conditions, target) {}
};

TEST(RunFeatures, OfSimulationsAreAsManyAndFinite) {
  const SmallFit fit(test::planted_swarm(1));
  const RunFeatures features(fit.conditions, fit.target);
  const VectorXd recorded = features(fit.conditions.recording);
  EXPECT_TRUE(recorded.allFinite());
  for (std::uint64_t k = 0; k < 10; ++k) {
    Point x(fit.space.dimensions());
    for (Index a = 0; a < x.size(); ++a) x[a] = Rng{3}.uniform(Stream::probe, k, static_cast<std::uint32_t>(a));
    const auto run = fit.objective.ensemble().run({fit.space.parameters(x), Rng{k}});
    ASSERT_FALSE(run.blew_up);
    const VectorXd f = features(run.seen);
    EXPECT_EQ(f.size(), recorded.size());
    EXPECT_TRUE(f.allFinite());
  }
}

TEST(ParameterPosterior, NamesWhatItSearchedInPhysicalUnits) {
  const SmallFit fit(test::planted_swarm(1));
  const int before = omp_get_max_threads();
  std::vector<ParameterPosterior> all;
  for (const int threads : {1, 2}) {
    omp_set_num_threads(threads);
    all.push_back(posterior_of(fit.space, fit.objective, Rng{1}, {2, 150, 0.4}));
  }
  omp_set_num_threads(before);
  EXPECT_EQ(all[0].posterior.sample, all[1].posterior.sample);
  ASSERT_EQ(all[0].parameters.size(), 5u);
  const auto bounds = fit.space.describe(fit.space.start(), "mm");
  for (const ParameterInterval& p : all[0].parameters) {
    const auto row = std::find_if(bounds.begin(), bounds.end(), [&](const ParameterResult& r) { return r.name == p.name; });
    ASSERT_NE(row, bounds.end());
    EXPECT_TRUE(row->lower <= p.lower && p.lower < p.median && p.median < p.upper && p.upper <= row->upper) << p.name;
    EXPECT_NE(p.partner, p.name);
  }
  EXPECT_EQ(all[0].parameters[2].name, "D");
  EXPECT_GT(all[0].parameters[2].contraction, 0.9) << "what accelerations are made of is told by any recording";
}

}  // namespace
}  // namespace swarmfit
