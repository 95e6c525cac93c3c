// SPDX-License-Identifier: MIT
// Positions of white-noise models have the statistics of the continuous process, at one step per frame as at four.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/swarm/lane.h"

namespace swarmfit {
namespace {

struct Second {
  double variance, correlation;  // of second differences over dt^1.5, and of neighbouring ones
};

// 400 agents without friction or forces to speak of, 60 frames: 70 000 second differences, a standard error of 0.5 to 0.9 %.
Second second_differences(const char* name, std::vector<std::pair<const char*, double>> values, int steps) {
  constexpr double dt = 0.01;
  const Made made = make(name);
  Lane lane = crowd(made, 400, 1e6, 0);
  for (const auto& [parameter, value] : values) set(made, lane, parameter, value);
  Recorded out;
  lane.out = &out;
  run(made, {.frame_dt = dt, .substeps = steps, .frames = 60}, lane);
  double square = 0, product = 0, n = 0, pairs = 0;
  const auto bend = [&](std::size_t k) { return Rows(out.moments[k + 1].pos - 2 * out.moments[k].pos + out.moments[k - 1].pos); };
  for (std::size_t k = 1; k + 1 < out.moments.size(); ++k) {
    square += bend(k).square().sum();
    n += static_cast<double>(3 * out.moments[k].pos.rows());
    if (k + 2 >= out.moments.size()) continue;
    product += (bend(k) * bend(k + 1)).sum();
    pairs += static_cast<double>(3 * out.moments[k].pos.rows());
  }
  const double unit = dt * dt * dt;
  return {square / n / unit, product / pairs / (square / n)};
}

// Of a velocity with the variance 2 D t: 2/3 · 2 D, and 1/4 (the integral of a Wiener process).
TEST(ContinuousNoise, Brownian) {
  for (const int steps : {1, 4}) {
    const Second s = second_differences("brownian[confinement=none,interaction=none]", {{"gamma1", 0}, {"gamma2", 0}, {"D", 0.5}}, steps);
    EXPECT_NEAR(s.variance, 2.0 / 3, 0.02) << steps;
    EXPECT_NEAR(s.correlation, 0.25, 0.02) << steps;
  }
}

TEST(ContinuousNoise, BswarmWithWhiteAndGaussianNoise) {
  for (const char* noise : {"white", "gaussian"})
    for (const int steps : {1, 4}) {
      const std::string name = std::string("bswarm[interaction=off,avoidance=none,noise=") + noise + "]";
      const Second s = second_differences(name.c_str(), {{"gamma", 0}, {"lambda", 1}}, steps);
      EXPECT_NEAR(s.variance, 2.0 / 3, 0.02) << noise << steps;
      EXPECT_NEAR(s.correlation, 0.25, 0.02) << noise << steps;
    }
}

// Printed literally, a kick belongs to its step.
TEST(ContinuousNoise, LiteralKicksAreNotContinuous) {
  const Second s = second_differences("bswarm[interaction=off,avoidance=none,noise=gaussian,noise_scaling=literal]",
                                      {{"gamma", 0}, {"lambda_literal", 10}}, 1);
  EXPECT_NEAR(s.variance, 1, 0.03);  // 10 = 1 / sqrt(dt)
  EXPECT_NEAR(s.correlation, 0, 0.02);
  EXPECT_TRUE(parse_model("bswarm[noise=white,noise_scaling=literal]")
                  .spec->is_map(parse_model("bswarm[noise=white,noise_scaling=literal]").options));
  EXPECT_FALSE(parse_model("bswarm[noise=white]").spec->is_map(parse_model("bswarm[noise=white]").options));
  EXPECT_FALSE(parse_model("bswarm[noise_scaling=literal]").spec->is_map(parse_model("bswarm[noise_scaling=literal]").options));
}

}  // namespace
}  // namespace swarmfit
