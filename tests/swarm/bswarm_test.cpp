// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "libswarm/stimuli.h"
#include "tests/swarm/lane.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

using Values = std::map<std::string, double>;

void set(const Made& made, Lane& lane, const Values& values) {
  for (const auto& [name, value] : values) set(made, lane, name, value);
}

// Agents at rest at these places, one step of length dt: what acts on each is v / dt.
Rows forces(const std::string& model, const std::vector<Array3d>& places, const Values& values, double dt = 1e-3) {
  const Made made = make(model);
  Lane lane = crowd(made, 0, 1, 1);
  set(made, lane, values);
  for (const Array3d& p : places) lane.state.spawn(0, p, {0, 0, 0});
  run(made, {.frame_dt = dt, .frames = 2}, lane);
  return lane.state.vel / dt;
}

const std::string kBare = "bswarm[noise=none,avoidance=none]";
const Values kZones{{"chi_rep", 2}, {"chi_att", 3}, {"chi_ali", 5}, {"r_rep", 1}, {"r_ali", 1}, {"r_att", 3}};  // edges 1, 2, 5

#define EXPECT_FORCE(block, row_, x, y, z) \
  EXPECT_LT(((block).row(row_).transpose() - Array3d(x, y, z)).abs().maxCoeff(), 1e-9) << (block).row(row_)

// ---- Eq 3 ---------------------------------------------------------------------------------------------------------------------

// dv/dt = -gamma v² has v = v0 / (1 + gamma v0 t): the explicit step is of first order, the implicit one exact.
TEST(BswarmDrag, FollowsTheClosedForm) {
  const auto error = [&](const std::string& drag, std::int64_t steps) {
    const Made made = make("bswarm[noise=none,interaction=off,avoidance=none,drag=" + drag + "]");
    Lane lane = crowd(made, 0, 1, 1);
    lane.state.spawn(0, {0, 0, 0}, {0, 2, 0});
    set(made, lane, "gamma", 1.5);
    run(made, {.frame_dt = 1.0 / static_cast<double>(steps), .frames = steps + 1}, lane);
    return lane.state.vel(0, 1) - 2 / (1 + 1.5 * 2 * 1.0);
  };
  EXPECT_LT(std::abs(error("explicit", 2000)), 1e-3);
  EXPECT_NEAR(error("explicit", 500) / error("explicit", 1000), 2, 0.05);
  EXPECT_NEAR(error("implicit", 100), 0, 1e-12);
}

TEST(BswarmDrag, ExplicitStepIsHalvedWhereItWouldReverse) {
  const Made made = make("bswarm[noise=none,interaction=off,avoidance=none]");
  Lane lane = crowd(made, 0, 1, 1);
  lane.state.spawn(0, {0, 0, 0}, {3, 0, 0});
  set(made, lane, "gamma", 1);
  run(made, {.frame_dt = 1, .frames = 2}, lane);
  EXPECT_EQ(lane.count.halved_steps, 2u);  // 3 dt > 1 at dt = 1 and 1/2
  EXPECT_GT(lane.state.vel(0, 0), 0);
}

// ---- Eq 5 ---------------------------------------------------------------------------------------------------------------------

TEST(BswarmZones, TwoAgents) {
  const auto at = [&](double r) { return forces(kBare, {{0, 0, 0}, {r, 0, 0}}, kZones); };
  EXPECT_FORCE(at(0.5), 0, -2, 0, 0);
  EXPECT_FORCE(at(0.5), 1, 2, 0, 0);
  EXPECT_FORCE(at(1.5), 0, 0, 0, 0);  // alignment: both at rest
  EXPECT_FORCE(at(2), 0, 3, 0, 0);    // r_ali <= r
  EXPECT_FORCE(at(5), 0, 3, 0, 0);    // r <= r_att
  EXPECT_FORCE(at(5.001), 0, 0, 0, 0);
}

TEST(BswarmZones, EveryZoneIsAveragedOverItsOwnMembers) {
  // Seen from the first: two repelling at right angles, three attracting along z.
  const Rows f = forces(kBare, {{0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 3}, {0, 0, 4}, {0, 0, -4}}, kZones);
  EXPECT_FORCE(f, 0, -1, -1, 1);
}

TEST(BswarmZones, AlignmentTakesUnitDifferences) {
  const Made made = make(kBare);
  Lane lane = crowd(made, 0, 1, 1);
  set(made, lane, kZones);
  set(made, lane, "gamma", 0);
  lane.state.spawn(0, {0, 0, 0}, {0, 1, 0});
  lane.state.spawn(0, {1.5, 0, 0}, {4, 1, 0});
  lane.state.spawn(0, {0, 1.5, 0}, {0, 1, 7});
  const double dt = 1e-3;
  run(made, {.frame_dt = dt, .frames = 2}, lane);
  EXPECT_FORCE(lane.state.vel / dt, 0, 2.5, 1 / dt, 2.5);
}

TEST(BswarmZones, SoftAlignmentDoesNotOvershoot) {
  for (const bool soft : {false, true}) {
    const Made made = make(soft ? "bswarm[noise=none,avoidance=none,align=soft]" : kBare);
    Lane lane = crowd(made, 0, 1, 1);
    set(made, lane, kZones);
    set(made, lane, "gamma", 0);
    lane.state.spawn(0, {0, 0, 0}, {0, 0, 0});
    lane.state.spawn(0, {1.5, 0, 0}, {0.01, 0, 0});
    run(made, {.frame_dt = 0.1, .frames = 2}, lane);  // chi_ali dt = 0.5, far more than the difference
    EXPECT_EQ(lane.state.vel(0, 0) > lane.state.vel(1, 0), true);
    EXPECT_NEAR(lane.state.vel(0, 0), soft ? 0.01 : 0.5, 1e-12);
  }
}

TEST(BswarmZones, SamePlaceParts) {
  const Rows f = forces(kBare, {{1, 2, 3}, {1, 2, 3}}, kZones);
  for (Index i = 0; i < 2; ++i) EXPECT_NEAR(std::sqrt(f.row(i).square().sum()), 2, 1e-9);  // chi_rep, in a random direction
}

TEST(BswarmZones, InteractionCanBeSwitchedOff) {
  EXPECT_FORCE(forces("bswarm[noise=none,avoidance=none,interaction=off]", {{0, 0, 0}, {0.5, 0, 0}}, kZones), 0, 0, 0, 0);
}

// ---- Eq 4 ---------------------------------------------------------------------------------------------------------------------

TEST(BswarmNoise, FieldsAreThoseOfTheSeed) {
  const NoiseField field(Rng{1});  // the seed of `crowd`
  const Array3d r(0.3, 0.7, -2);
  const auto force = [&](const std::string& noise) {
    const Values values{{"noise", 4}, {"scale", 0.5}};
    return Array3d(forces("bswarm[avoidance=none,interaction=off,noise=" + noise + "]", {r}, values).row(0).transpose());
  };
  EXPECT_LT((force("curl") - 4 / 0.9962 * field.curl(r / 0.5)).abs().maxCoeff(), 1e-9);
  EXPECT_LT((force("perlin") - 4 / 0.27 * field.potential(r / 0.5)).abs().maxCoeff(), 1e-9);
}

// One parameter, one bound: forces of the same strength push equally hard, root mean square, whatever their kind. In the plane a field's
// strength depends on where the plane cuts the lattice: hence many seeds.
TEST(BswarmNoise, ForcesOfOneStrengthAreEquallyStrong) {
  for (const int dims : {2, 3}) {
    const auto strength = [&](const std::string& noise) {
      const Made made = make("bswarm[avoidance=none,interaction=off,noise=" + noise + "]", dims);
      double square = 0;
      for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        Lane lane = crowd(made, 200, 200, 0, seed, dims);
        set(made, lane, {{"noise", 1}, {"scale", 1}, {"tau", 10}});
        run(made, {.frame_dt = 1e-3, .frames = 2}, lane);
        square += (lane.state.vel / 1e-3).square().rowwise().sum().mean() / 200;
      }
      return std::sqrt(square);
    };
    for (const char* noise : {"curl", "perlin", "ou", "curl,offset=per_agent"})
      EXPECT_NEAR(strength(noise) / std::sqrt(dims), 1, 0.02) << noise << dims;
  }
}

TEST(BswarmNoise, AllStrengthsAreSearchedBetweenTheSameBounds) {
  const ModelSpec& spec = *parse_model("bswarm").spec;
  const auto fit = [&](const char* name) { return spec.parameters[static_cast<std::size_t>(spec.find(name))].fit; };
  for (const char* name : {"lambda", "lambda_literal"}) {
    EXPECT_EQ(fit(name).lower, fit("noise").lower) << name;
    EXPECT_EQ(fit(name).upper, fit("noise").upper) << name;
  }
}

TEST(BswarmNoise, OffsetsGiveEveryAgentItsOwnField) {
  const std::vector<Array3d> same(2, Array3d(1, 2, 3));
  const Rows shared = forces("bswarm[avoidance=none,interaction=off]", same, {});
  const Rows own = forces("bswarm[avoidance=none,interaction=off,offset=per_agent]", same, {});
  EXPECT_TRUE((shared.row(0) == shared.row(1)).all());
  EXPECT_GT((own.row(0) - own.row(1)).abs().maxCoeff(), 0.01);
}

// Free agents after time t: var(v) = lambda² t for Gaussian and white noise, whatever the step; with literal scaling it is lambda² t dt,
// and a third of it for white noise. 5700 samples: the band of 5 standard errors is ±9 % (level 6e-7).
TEST(BswarmNoise, DiffusionDoesNotDependOnTheStep) {
  const double lambda = 1.3, t = 0.4;
  const auto variance = [&](const std::string& options, const char* parameter, double dt) {
    const Made made = make("bswarm[avoidance=none,interaction=off," + options + "]");
    Lane lane = crowd(made, 0, 1, 1);
    set(made, lane, {{"gamma", 0}, {parameter, lambda}});
    for (int k = 0; k < 1900; ++k) lane.state.spawn(0, {0, 0, 0}, {0, 0, 0});
    run(made, {.frame_dt = dt, .frames = 1 + static_cast<std::int64_t>(std::lround(t / dt))}, lane);
    return lane.state.vel.square().mean();
  };
  for (const double dt : {0.1, 0.02, 0.005}) {
    EXPECT_NEAR(variance("noise=gaussian", "lambda", dt) / (lambda * lambda * t), 1, 0.09) << dt;
    EXPECT_NEAR(variance("noise=white", "lambda", dt) / (lambda * lambda * t), 1, 0.09) << dt;
    EXPECT_NEAR(variance("noise=gaussian,noise_scaling=literal", "lambda_literal", dt) / (lambda * lambda * t * dt), 1, 0.09) << dt;
    EXPECT_NEAR(variance("noise=white,noise_scaling=literal", "lambda_literal", dt) / (lambda * lambda * t * dt / 3), 1, 0.09) << dt;
  }
}

// A force of memory, closed forms (Uhlenbeck & Ornstein 1930): from rest, with s = t / tau,
//   <v²> = 2 (noise tau)² (s - 1 + e^-s),   <x²> the integral of its correlation, below
// by steps of any length, since they are exact.
// 5700 samples: the band of 5 standard errors is ±9 %.
TEST(BswarmNoise, ForceWithMemoryIsOrnsteinUhlenbeck) {
  const double noise = 1.3, tau = 0.15, t = 0.4, s = t / tau;
  const double velocity = 2 * noise * noise * tau * tau * (s - 1 + std::exp(-s));
  // <x²> = 2 noise² ∫∫ (t - a)(t - b) e^-(b - a)/tau over a < b
  double place = 0;
  constexpr int n = 2000;
  for (int i = 0; i < n; ++i) {
    const double left = t - (i + 0.5) * t / n;
    double inner = 0;
    for (int j = i; j < n; ++j) inner += (t - (j + 0.5) * t / n) * std::exp(-(j - i) * t / n / tau) * (j == i ? 0.5 : 1.0);
    place += 2 * noise * noise * left * inner * (t / n) * (t / n);
  }
  const Made made = make("bswarm[avoidance=none,interaction=off,noise=ou]");
  for (const double dt : {0.2, 0.02}) {
    Lane lane = crowd(made, 0, 1, 1);
    set(made, lane, {{"gamma", 0}, {"noise", noise}, {"tau", tau}});
    for (int k = 0; k < 1900; ++k) lane.state.spawn(0, {0, 0, 0}, {0, 0, 0});
    run(made, {.frame_dt = dt, .frames = 1 + static_cast<std::int64_t>(std::lround(t / dt))}, lane);
    EXPECT_NEAR(lane.state.vel.square().mean() / velocity, 1, 0.09) << dt;
    EXPECT_NEAR(lane.state.pos.square().mean() / place, 1, 0.09) << dt;
  }
}

// ---- F_res --------------------------------------------------------------------------------------------------------------------

Lane with_stimulus(const Made& made, Stimulus::Kind kind, int agents) {
  Lane lane = crowd(made, 0, 1, 1);
  set(made, lane, {{"chi_res", 4}, {"r_res", 2}, {"gamma", 0}});
  for (int k = 0; k < agents; ++k) lane.state.spawn(0, {1, 0, 0}, {0, 0, 0});
  lane.world.add(std::make_unique<Stimuli>(std::vector<Stimulus>{{.kind = kind, .velocity = {0, 0, 0}}}));
  return lane;
}

TEST(BswarmResponse, AttractionIsStraight) {
  const Made made = make("bswarm[noise=none,avoidance=none,interaction=off]");
  Lane lane = with_stimulus(made, Stimulus::Kind::attract, 1);
  run(made, {.frame_dt = 1e-3, .frames = 2}, lane);
  EXPECT_FORCE(lane.state.vel / 1e-3, 0, -4, 0, 0);
}

// Flight is turned about y by an angle uniform on [-pi/2, 0]; with response=both half of them turn the other way.
TEST(BswarmResponse, FlightTurnsByADrawnAngleThatLasts) {
  const int n = 1000;
  for (const bool both : {false, true}) {
    const Made made = make(both ? "bswarm[noise=none,avoidance=none,interaction=off,response=both]"
                                : "bswarm[noise=none,avoidance=none,interaction=off]");
    Lane lane = with_stimulus(made, Stimulus::Kind::repel, n);
    run(made, {.frame_dt = 1e-3, .frames = 2}, lane);
    const Rows first = lane.state.vel / 1e-3;
    double mean = 0;
    int positive = 0;
    for (Index i = 0; i < n; ++i) {
      const double theta = std::atan2(-first(i, 2), first(i, 0));
      EXPECT_NEAR(std::sqrt(first.row(i).square().sum()), 4, 1e-9);
      EXPECT_LE(std::abs(theta), std::numbers::pi / 2);
      EXPECT_NEAR(theta, lane.state.own(i, 1), 1e-9);
      mean += std::abs(theta) / n;
      positive += theta > 0;
    }
    EXPECT_NEAR(mean, std::numbers::pi / 4, 5 * std::numbers::pi / 2 / std::sqrt(12.0 * n));  // 5 standard errors
    EXPECT_NEAR(positive, both ? n / 2 : 0, both ? 2.5 * std::sqrt(n) : 0);                   // likewise
    const Eigen::ArrayXXd drawn = lane.state.own;
    run(made, {.frame_dt = 1e-3, .frames = 5}, lane);
    EXPECT_TRUE((lane.state.own == drawn).all());  // one angle per encounter
  }
}

TEST(BswarmResponse, EndsOutOfSight) {
  const Made made = make("bswarm[noise=none,avoidance=none,interaction=off]");
  Lane lane = with_stimulus(made, Stimulus::Kind::repel, 1);
  lane.state.pos(0, 0) = 2.001;
  run(made, {.frame_dt = 1e-3, .frames = 2}, lane);
  EXPECT_FORCE(lane.state.vel, 0, 0, 0, 0);
  EXPECT_EQ(lane.state.own(0, 0), 0);
}

// ---- avoidance ----------------------------------------------------------------------------------------------------------------

double nearest_pair(const State& s) {
  double least2 = 1e300;
  for (Index i = 0; i < s.size(); ++i)
    for (Index j = 0; j < i; ++j) least2 = std::min(least2, (s.pos.row(i) - s.pos.row(j)).square().sum());
  return std::sqrt(least2);
}

TEST(BswarmAvoidance, KeepsAttractedAgentsApart) {
  for (const bool avoid : {false, true}) {
    const Made made = make(avoid ? "bswarm[noise=none,infeasible=min_penetration]" : kBare);
    Lane lane = crowd(made, 12, 3, 0.1);
    set(made, lane, {{"chi_att", 5}, {"r_att", 20}, {"r_rep", 0}, {"radius", 0.2}});
    run(made, {.frame_dt = 0.01, .frames = 1001}, lane);
    if (avoid) {
      EXPECT_GT(nearest_pair(lane.state), 0.95 * 2 * 0.2);
    } else {
      EXPECT_LT(nearest_pair(lane.state), 0.1);
    }
  }
}

// Overlapping agents that may not fly fast enough to part within one step: infeasible.
TEST(BswarmAvoidance, PoliciesForTheInfeasible) {
  const auto jam = [](const std::string& policy) {
    const Made made = make("bswarm[noise=none,interaction=off,infeasible=" + policy + "]");
    Lane lane = crowd(made, 0, 1, 1);
    set(made, lane, {{"radius", 0.2}, {"max_speed", 0.5}});
    for (const double x : {0.0, 0.1, 0.2}) lane.state.spawn(0, {x, 0, 0}, {0.1, 0, 0});
    run(made, {.frame_dt = 0.01, .frames = 2}, lane);
    return lane;
  };
  const Lane zero = jam("zero"), substep = jam("substep"), least = jam("min_penetration");
  EXPECT_EQ(zero.count.infeasible_avoidance, 3u);
  EXPECT_TRUE((zero.state.vel == 0).all());
  EXPECT_EQ(substep.count.halved_steps, 7u);  // every level: 1 + 2 + 4
  EXPECT_EQ(substep.count.infeasible_avoidance, 24u);
  EXPECT_EQ(least.count.infeasible_avoidance, 3u);
  EXPECT_NEAR(least.state.vel(0, 0), -0.5, 1e-6);  // the outer two flee
  EXPECT_NEAR(least.state.vel(2, 0), 0.5, 1e-6);
}

// ---- what Table 1 does ----------------------------------------------------------------------------------------------------------

struct Regime {
  double speed = 0, extent = 0, polarisation = 0, nearest = 0;
};

// Mean distance to the nearest neighbour.
double mean_nearest(const Rows& pos) {
  double sum = 0;
  for (Index i = 0; i < pos.rows(); ++i) {
    Eigen::ArrayXd distance2 = (pos.rowwise() - pos.row(i)).square().rowwise().sum();
    distance2[i] = 1e300;
    sum += std::sqrt(distance2.minCoeff());
  }
  return sum / static_cast<double>(pos.rows());
}

// Means over the last third of a run in the box of Table 1, from a start within one range of attraction in its middle.
Regime regime(const Values& values, Index agents, double seconds) {
  const Made made = make("bswarm[avoidance=none]");
  Lane lane = crowd(made, agents, 4, 0.4, 2);
  lane.state.pos += 8;
  set(made, lane, values);
  lane.world.bounds.kind = Bounds::Kind::box;
  lane.world.bounds.upper.setConstant(20);
  run(made, {.frame_dt = 0.01, .frames = 1 + std::lround(seconds * 200 / 3)}, lane);
  Recorded out;
  lane.out = &out;
  run(made, {.frame_dt = 0.01, .frames = 1 + std::lround(seconds * 100 / 3)}, lane);
  Regime mean{.nearest = mean_nearest(lane.state.pos)};
  for (const auto& m : out.moments) {
    const Eigen::ArrayXd speed = m.vel.square().rowwise().sum().sqrt();
    const auto count = static_cast<double>(out.moments.size());
    mean.speed += speed.mean() / count;
    mean.extent += std::sqrt((m.pos.rowwise() - m.pos.colwise().mean()).square().rowwise().sum().mean()) / count;
    mean.polarisation += std::sqrt((m.vel.colwise() / speed).colwise().mean().square().sum()) / count;
  }
  return mean;
}

// Reference: an independent implementation of the literal equations (no avoidance, box 20, dt 0.01, one run each). Sizes are set by the
// balance of the zones and reproducible; speeds and polarisation of one chaotic run differ from another's, hence their wider bands.
TEST(BswarmRegime, MidgesOfTable1CollapseToADriftingClump) {
  const Regime midge = regime({}, 100, 30);
  EXPECT_NEAR(midge.extent, 0.10, 0.02);
  EXPECT_NEAR(std::log2(midge.nearest / 0.007), 0, 1);
  EXPECT_NEAR(midge.speed, 0.39, 0.15);
  EXPECT_GT(midge.polarisation, 0.8);
}

const Values kFly{{"gamma", 8.76}, {"scale", 2.75},    {"noise", 1.79 / 2.75}, {"chi_rep", 1.74},
                  {"r_rep", 1.48}, {"chi_att", 10.39}, {"r_att", 4.49}};

TEST(BswarmRegime, Fruitflies) {
  const Regime fly = regime(kFly, 100, 30);
  EXPECT_NEAR(fly.extent, 0.83, 0.08);
  EXPECT_NEAR(fly.nearest, 0.055, 0.02);
  EXPECT_NEAR(fly.speed, 0.30, 0.10);
}

TEST(BswarmRegime, PhaseTransitionColumnIsPolarised) {
  const Values values{{"gamma", 1.4}, {"scale", 0.72}, {"noise", 0.1 / 0.72}, {"chi_rep", 5}, {"r_rep", 0.2},
                      {"chi_att", 7}, {"r_att", 9.2},  {"chi_ali", 10},       {"r_ali", 2.2}};
  const Regime phase = regime(values, 20, 20);
  EXPECT_NEAR(phase.extent, 1.1, 0.15);
  EXPECT_GT(phase.polarisation, 0.95);
}

TEST(BswarmRegime, FitS17) {
  const Values values{{"gamma", 6.2125},    {"scale", 3.5093}, {"noise", 3.9280 / 3.5093}, {"chi_rep", 4.4773},
                      {"chi_att", 12.0471}, {"r_rep", 5.9951}, {"r_att", 11.8224}};
  const Regime midge = regime(values, 100, 30);
  EXPECT_NEAR(midge.extent, 3.3, 0.25);
  EXPECT_NEAR(midge.nearest, 0.17, 0.06);
  EXPECT_NEAR(midge.speed, 0.44, 0.12);
}

TEST(BswarmRegime, FitS18) {
  const Values values{{"gamma", 1.0360},    {"scale", 2.8835}, {"noise", 1.3600 / 2.8835}, {"chi_rep", 16.8519},
                      {"chi_att", 25.1986}, {"r_rep", 4.1642}, {"r_att", 17.0014}};
  const Regime fly = regime(values, 100, 30);
  EXPECT_NEAR(fly.extent, 2.4, 0.1);
  EXPECT_NEAR(fly.nearest, 0.16, 0.05);
  EXPECT_NEAR(fly.speed, 1.02, 0.3);
  EXPECT_LT(fly.polarisation, 0.75);
}

}  // namespace
}  // namespace swarmfit
