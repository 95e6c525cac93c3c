// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "libswarm/exponential.h"
#include "tests/swarm/lane.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;
using Values = std::map<std::string, double>;

constexpr Index kAgents = 1900;

#define EXPECT_NEAR3(a, b, tolerance) EXPECT_LT(((a) - (b)).abs().maxCoeff(), tolerance) << (a).transpose() << " not " << (b).transpose()

Lane lane_with(const Made& made, const Values& values, Index agents = 0, double speed = 1, int dims = 3) {
  Lane lane = crowd(made, agents, 1, speed, 1, dims);
  for (const auto& [name, value] : values) set(made, lane, name, value);
  return lane;
}

// One step without noise: the acceleration of each agent. Forces are taken in the middle of the step, so it is short: kShort of a value at
// most.
constexpr double kShort = 1e-4;
Rows acceleration(const std::string& model, const std::vector<std::pair<Array3d, Array3d>>& agents, Values values, double dt = 1e-6) {
  values["D"] = 0;
  const Made made = make(model);
  Lane lane = lane_with(made, values);
  for (const auto& [pos, vel] : agents) lane.state.spawn(0, pos, vel);
  const Rows before = lane.state.vel;
  run(made, {.frame_dt = dt, .frames = 2}, lane);
  return (lane.state.vel - before) / dt;
}

Array3d first(const Rows& rows) { return rows.row(0).transpose(); }

// ---- free particles -----------------------------------------------------------------------------------------------------------

// Stationary speeds: P(v) ~ v^(dims-1) exp(-(gamma2 v^4 / 4 - gamma1 v² / 2) / D), by the trapezoidal rule.
struct Speeds {
  std::vector<double> cumulative;
  double mean = 0, square = 0;
  static constexpr double kStep = 1e-3;

  Speeds(double gamma1, double gamma2, double d, int dims) {
    double sum = 0;
    for (int k = 0; k < 8000; ++k) {
      const double v = k * kStep, v2 = v * v;
      const double p = (dims == 2 ? v : v2) * std::exp(-(gamma2 * v2 * v2 / 4 - gamma1 * v2 / 2) / d);
      cumulative.push_back(sum += p);
      mean += p * v;
      square += p * v2;
    }
    mean /= sum;
    square /= sum;
    for (double& c : cumulative) c /= sum;
  }
  double below(double v) const { return cumulative[std::min<std::size_t>(static_cast<std::size_t>(v / kStep), cumulative.size() - 1)]; }
};

struct Published {
  const char* table;
  double gamma1, gamma2, d, mean, square;
};
const Published kPublished[]{{"S17", 0.2156, 3.8959, 0.9585, 0.826, 0.757},
                             {"S18", 0.3542, 1.0877, 3.1650, 1.550, 2.660},
                             {"S19", 0.2262, 2.8262, 2.6353, 1.148, 1.461},
                             {"S20", 0.4925, 0.9870, 0.9208, 1.225, 1.650}};

TEST(BrownianFree, IntegralsOfTheStationaryLaw) {
  for (const auto& p : kPublished) {
    const Speeds law(p.gamma1, p.gamma2, p.d, 3);
    EXPECT_NEAR(law.mean, p.mean, 6e-4) << p.table;
    EXPECT_NEAR(law.square, p.square, 6e-4) << p.table;
  }
}

// 1900 speeds after several relaxation times: Kolmogorov's distance at level 1e-3, one moment for each setting. Means over 8
// moments: standard error 0.4 %.
TEST(BrownianFree, SpeedsHaveTheStationaryLaw) {
  for (const int dims : {2, 3})
    for (const auto& p : kPublished) {
      SCOPED_TRACE(std::string(p.table) + " in " + std::to_string(dims));
      const Made made = make("brownian[confinement=none,interaction=none]", dims);
      Lane lane = lane_with(made, {{"gamma1", p.gamma1}, {"gamma2", p.gamma2}, {"D", p.d}}, kAgents, 1, dims);
      run(made, {.frame_dt = 0.5, .substeps = 100, .frames = 5}, lane);
      Recorded out;
      lane.out = &out;
      run(made, {.frame_dt = 0.5, .substeps = 100, .first_frame = 4, .frames = 8}, lane);
      const Speeds law(p.gamma1, p.gamma2, p.d, dims);
      double mean = 0, square = 0;
      for (const auto& m : out.moments) {
        mean += m.vel.square().rowwise().sum().sqrt().mean() / static_cast<double>(out.moments.size());
        square += m.vel.square().rowwise().sum().mean() / static_cast<double>(out.moments.size());
      }
      EXPECT_NEAR(mean / law.mean, 1, 0.015);
      EXPECT_NEAR(square / law.square, 1, 0.03);
      std::vector<double> speed;
      for (Index i = 0; i < kAgents; ++i) speed.push_back(std::sqrt(lane.state.vel.row(i).square().sum()));
      std::sort(speed.begin(), speed.end());
      double distance = 0;
      for (std::size_t k = 0; k < speed.size(); ++k)
        distance = std::max(distance, std::abs(law.below(speed[k]) - (static_cast<double>(k) + 0.5) / kAgents));
      EXPECT_LT(distance, 1.95 / std::sqrt(static_cast<double>(kAgents)));
    }
}

// Linear friction g: <v²> = D / g per component, <(x(t) - x(0))²> = 2 D / g² (t - (1 - e^(-g t)) / g) from a stationary start; from
// ballistic (g t = 0.1) to diffusive (g t = 10). 5700 components: ±9.4 % is 5 standard errors. Whatever the step.
TEST(BrownianFree, PassiveDiffusion) {
  const double g = 2, d = 1.5;
  for (const int substeps : {1, 4}) {
    const Made made = make("brownian[confinement=none,interaction=none]");
    Lane lane = lane_with(made, {{"gamma1", -g}, {"gamma2", 0}, {"D", d}});
    for (std::uint32_t i = 0; i < kAgents; ++i) lane.state.spawn(0, {0, 0, 0}, std::sqrt(d / g) * gaussian_noise(Rng{5}, 0, i));
    Recorded out;
    lane.out = &out;
    run(made, {.frame_dt = 0.01, .substeps = substeps, .frames = 501}, lane);
    for (const std::size_t frame : {5u, 25u, 100u, 500u}) {
      const double t = 0.01 * static_cast<double>(frame);
      const double expected = 2 * d / (g * g) * (t - (1 - std::exp(-g * t)) / g);
      EXPECT_NEAR(out.moments[frame].pos.square().mean() / expected, 1, 0.094) << t;
      EXPECT_NEAR(out.moments[frame].vel.square().mean() / (d / g), 1, 0.094) << t;
    }
  }
}

// Equipartition in the harmonic well: k <x²> = <v²> = D / g.
TEST(BrownianConfined, Equipartition) {
  const Made made = make("brownian[interaction=none]");
  Lane lane = lane_with(made, {{"gamma1", -2}, {"gamma2", 0}, {"D", 1.5}, {"k", 5}}, kAgents);
  run(made, {.frame_dt = 0.1, .substeps = 20, .frames = 101}, lane);
  EXPECT_NEAR(lane.state.pos.square().mean() / (1.5 / 2 / 5), 1, 0.094);
  EXPECT_NEAR(lane.state.vel.square().mean() / (1.5 / 2), 1, 0.094);
}

// ---- forces -------------------------------------------------------------------------------------------------------------------

TEST(BrownianForce, Rayleigh) {
  const Values values{{"gamma1", 0.5}, {"gamma2", 2}};
  EXPECT_NEAR3(first(acceleration("brownian[confinement=none]", {{{9, 9, 9}, {0, 0.3, 0.4}}}, values)), Array3d(0, 0, 0), kShort);
  EXPECT_NEAR3(first(acceleration("brownian[confinement=none]", {{{9, 9, 9}, {0, 3, 4}}}, values)), Array3d(0, -148.5, -198), 198 * kShort);
}

TEST(BrownianForce, HarmonicAboutTheCentre) {
  const Values values{{"k", 3}};
  EXPECT_NEAR3(first(acceleration("brownian", {{{1, -2, 4}, {0, 0, 0}}}, values)), Array3d(-3, 6, -12), 12 * kShort);
  EXPECT_NEAR3(first(acceleration("brownian[confinement=none]", {{{1, -2, 4}, {0, 0, 0}}}, values)), Array3d(0, 0, 0), 1e-15);
  State seen;
  seen.spawn(0, {2, 2, 2}, {0, 0, 0});
  seen.spawn(0, {4, 0, 2}, {0, 0, 0});
  const Tracks reference = recording_of(seen);
  const Made made = make("brownian", 3, &reference);
  Lane lane = lane_with(made, {{"k", 3}, {"D", 0}, {"gamma1", 0}, {"gamma2", 0}});
  lane.state.spawn(0, {3, 1, 1}, {0, 0, 0});  // below (3, 1, 2)
  run(made, {.frame_dt = 0.01, .frames = 2}, lane);
  EXPECT_NEAR3(first(lane.state.vel), Array3d(0, 0, 0.03), 1e-15);
  EXPECT_NEAR3(first(lane.state.pos), Array3d(3, 1, 1.00015), 1e-15);  // with the mean of both velocities
}

TEST(BrownianForce, RepulsionAndMorse) {
  const std::vector<std::pair<Array3d, Array3d>> pair{{{0, 0, 0}, {0, 0, 0}}, {{0, 0.6, 0.8}, {0, 0, 0}}};
  const Values values{{"C_r", 2}, {"l_r", 0.5}, {"C_a", 3}, {"l_a", 1.5}};
  const double repulsion = 4 * std::exp(-2.0), attraction = 2 * std::exp(-1 / 1.5);
  const auto expect = [&](const std::string& interaction, double f) {
    const Rows a = acceleration("brownian[confinement=none,interaction=" + interaction + "]", pair, values);
    EXPECT_NEAR3(first(a), Array3d(0, -0.6 * f, -0.8 * f), kShort);
    EXPECT_LT((a.row(0) + a.row(1)).abs().maxCoeff(), 1e-9);
  };
  expect("repulsion", repulsion);
  expect("morse", repulsion - attraction);
  expect("none", 0);
}

TEST(BrownianForce, ExponentialOfFour) {
  for (double x = -700; x < 700; x += 0.37) {
    Lanes e;
    exponential(Lanes{x, -x, x / 700, x / 1e9}, e);
    const double expected[] = {std::exp(x), std::exp(-x), std::exp(x / 700), std::exp(x / 1e9)};
    for (int l = 0; l < 4; ++l) ASSERT_NEAR(e[l] / expected[l], 1, 1e-15) << x;
  }
}

// Small groups are taken pair by pair; the sum over all others, agent by agent.
TEST(BrownianForce, OfAGroupIsTheSumOverTheOthers) {
  constexpr Index n = 150;  // more than one block of neighbours
  std::vector<std::pair<Array3d, Array3d>> agents;
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto xy = Rng{5}.uniform2(Stream::probe, 0, i, 0);
    agents.emplace_back(2 * Array3d(xy[0], xy[1], Rng{5}.uniform(Stream::probe, 0, i, 1)), Array3d::Zero());
  }
  const Rows a = acceleration("brownian[confinement=none]", agents, {{"C_r", 2}, {"l_r", 0.5}});
  for (Index i = 0; i < n; ++i) {
    Array3d sum = Array3d::Zero();
    for (Index j = 0; j < n; ++j) {
      const Array3d from = agents[static_cast<std::size_t>(i)].first - agents[static_cast<std::size_t>(j)].first;
      const double d = std::sqrt(from.square().sum());
      if (j != i) sum += 2 / 0.5 * std::exp(-d / 0.5) / d * from;
    }
    ASSERT_LT((a.row(i).transpose() - sum).abs().maxCoeff(), kShort) << "agent " << i;
  }
}

TEST(BrownianForce, SamePlaceParts) {
  const Rows a = acceleration("brownian[confinement=none]", {{{1, 2, 3}, {0, 0, 0}}, {{1, 2, 3}, {0, 0, 0}}}, {{"C_r", 2}, {"l_r", 0.5}});
  EXPECT_NEAR(std::sqrt(a.row(0).square().sum()), 4, 4 * kShort);
  EXPECT_LT((a.row(0) + a.row(1)).abs().maxCoeff(), 1e-9);
}

// ---- depot --------------------------------------------------------------------------------------------------------------------

const std::string kDepot = "brownian[friction=depot,confinement=none]";

TEST(BrownianDepot, EntersInBalance) {
  const Values values{{"q0", 6}, {"c", 2}, {"d2", 4}, {"g0", 0.5}};
  // v² = 0.25: e = 6 / (2 + 1) = 2, f = 4 · 2 - 0.5
  EXPECT_NEAR3(first(acceleration(kDepot, {{{0, 0, 0}, {0, 0.5, 0}}}, values)), Array3d(0, 0.5 * 7.5, 0), 3.75 * kShort);
}

TEST(BrownianDepot, SettlesAtTheSpeedWhereIntakeAndFrictionBalance) {
  const Made made = make(kDepot);
  Lane lane = lane_with(made, {{"D", 0}, {"q0", 6}, {"c", 2}, {"d2", 4}, {"g0", 0.5}});
  lane.state.spawn(0, {0, 0, 0}, {0.1, 0, 0});
  run(made, {.frame_dt = 0.01, .frames = 3001}, lane);
  EXPECT_NEAR(lane.state.vel(0, 0), std::sqrt(6 / 0.5 - 2 / 4.0), 1e-6);
  EXPECT_NEAR(lane.state.own(0, 0), 0.5 / 4, 1e-6);  // d2 e = g0
}

// The store follows its exact solution: at rest e = q0 / c + (e(0) - q0 / c) exp(-c t) for any step.
TEST(BrownianDepot, StoreRelaxesExactly) {
  const Made made = make(kDepot);
  Lane lane = lane_with(made, {{"D", 0}, {"q0", 6}, {"c", 2}, {"d2", 4}, {"g0", 0.5}});
  lane.state.spawn(0, {0, 0, 0}, {0, 0, 0});
  run(made, {.frames = 1}, lane);
  EXPECT_NEAR(lane.state.own(0, 0), 3, 1e-15);
  lane.state.own(0, 0) = 1;
  run(made, {.frame_dt = 0.5, .frames = 2}, lane);
  EXPECT_NEAR(lane.state.own(0, 0), 3 - 2 * std::exp(-1.0), 1e-12);
}

// A fast store and a slow agent: gamma1 = q0 d2 / c - g0, gamma2 = q0 d2² / c².
TEST(BrownianDepot, IsRayleighFrictionWhereSlow) {
  const double q0 = 400, c = 200, d2 = 1.0, g0 = 1.5;
  const std::vector<std::pair<Array3d, Array3d>> slow{{{0, 0, 0}, {1, 0, 0}}};
  const Array3d depot = first(acceleration(kDepot, slow, {{"q0", q0}, {"c", c}, {"d2", d2}, {"g0", g0}}));
  const Array3d rayleigh =
      first(acceleration("brownian[confinement=none]", slow, {{"gamma1", q0 * d2 / c - g0}, {"gamma2", q0 * d2 * d2 / (c * c)}}));
  EXPECT_NEAR(depot[0], rayleigh[0], 2 * d2 / c * 0.01);  // the next term: q0 d2³ / c³ v^5
}

// ---- steps --------------------------------------------------------------------------------------------------------------------

TEST(BrownianStep, IsHalvedForTheFast) {
  const Made made = make("brownian[confinement=none]");
  Lane lane = lane_with(made, {{"D", 0}, {"gamma1", 0}, {"gamma2", 1}});
  lane.state.spawn(0, {0, 0, 0}, {2, 0, 0});
  run(made, {.frame_dt = 0.1, .frames = 2}, lane);
  EXPECT_EQ(lane.count.halved_steps, 1u);  // 4 dt > 0.2 at 0.1, not at 0.05
  const auto midpoint = [](double v) { return v - 0.05 * std::pow(v - 0.5 * 0.05 * std::pow(v, 3), 3); };
  EXPECT_NEAR(lane.state.vel(0, 0), midpoint(midpoint(2)), 1e-14);
}

}  // namespace
}  // namespace swarmfit
