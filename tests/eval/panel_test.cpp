// SPDX-License-Identifier: MIT
#include "libeval/panel.h"

#include <gmock/gmock.h>

#include <map>
#include <numbers>

#include "tests/eval/build.h"

namespace swarmfit {
namespace {

using test::Row;
using test::tracks_of;
using testing::IsNan;

std::map<std::string, double> named(const PanelPlan& plan, const std::vector<double>& values) {
  std::map<std::string, double> out;
  const auto items = plan.items();
  EXPECT_EQ(items.size(), values.size());
  for (std::size_t k = 0; k < values.size(); ++k) out[items[k].key] = values[k];
  return out;
}
std::map<std::string, double> panel_named(const Tracks& tracks) {
  const PanelPlan plan = panel_plan(tracks);
  return named(plan, panel(tracks, plan).values);
}

// Independent particles with dv = (-k x - v/τ) dt + s dW per axis, in equilibrium: Var v = s² τ/2, Var x = Var v / k.
struct Langevin {
  double k = 6, tau = 0.5, s = 300;
  double dt = 0.01;
  double omega() const { return std::sqrt(k - 0.25 / (tau * tau)); }
  // <v(0) v(t)> / <v²>: exp(-t/2τ) (cos ωt - sin ωt / (2τω))
  double vacf(double t) const { return std::exp(-t / (2 * tau)) * (std::cos(omega() * t) - std::sin(omega() * t) / (2 * tau * omega())); }
  double zero() const { return std::atan(2 * tau * omega()) / omega(); }
  double var_v() const { return s * s * tau / 2; }
  double var_x() const { return var_v() / k; }
  // <|x(t) - x(0)|²> per axis: 2 Var x (1 - exp(-t/2τ) (cos ωt + sin ωt / (2τω)))
  double msd(double t) const {
    return 2 * var_x() * (1 - std::exp(-t / (2 * tau)) * (std::cos(omega() * t) + std::sin(omega() * t) / (2 * tau * omega())));
  }
  std::vector<Row> rows(std::uint64_t seed, std::uint32_t particles, std::int64_t frames) const {
    constexpr int kSub = 10;
    const double h = dt / kSub;
    std::vector<Row> out;
    std::vector<std::array<double, 6>> state(particles);
    for (std::uint32_t i = 0; i < particles; ++i)
      for (std::uint32_t a = 0; a < 6; ++a) state[i][a] = std::sqrt(a < 3 ? var_x() : var_v()) * test::normal(seed, 0, i, a);
    for (std::int64_t f = 0; f < frames; ++f)
      for (std::uint32_t i = 0; i < particles; ++i) {
        auto& p = state[i];
        out.push_back({i, f, {p[0], p[1], p[2]}});
        for (std::uint32_t sub = 0; sub < kSub; ++sub)
          for (std::uint32_t a = 0; a < 3; ++a) {
            p[a + 3] +=
                (-k * p[a] - p[a + 3] / tau) * h + s * std::sqrt(h) * test::normal(seed, static_cast<std::uint64_t>(f) + 1, i, 3 * sub + a);
            p[a] += p[a + 3] * h;
          }
      }
    return out;
  }
};

// 60 particles for 8 s, 30 correlation times: 3 axes × 60 × about 10 independent stretches make relative errors of 2-3 %; tolerances are
// three of them. The second difference samples the force at three points of white noise: <a|x> keeps the slope k.
TEST(Panel, HarmonicLangevinParticles) {
  const Langevin law;
  const Tracks tracks = tracks_of(law.rows(1, 60, 800), {.dt = law.dt});
  const PanelPlan plan = panel_plan(tracks);
  const Panel p = panel(tracks, plan);
  auto got = named(plan, p.values);
  for (const auto* axis : {"sd_x", "sd_y", "sd_z"}) EXPECT_NEAR(got[axis], std::sqrt(law.var_x()), 0.1 * std::sqrt(law.var_x()));
  EXPECT_NEAR(got["vacf_zero"], law.zero(), 0.05 * law.zero());
  for (const double t : {0.12, 0.25, 0.5, 1.0}) {
    const auto key = t == 0.12 ? "msd_0.12s" : t == 0.25 ? "msd_0.25s" : t == 0.5 ? "msd_0.5s" : "msd_1s";
    EXPECT_NEAR(got.at(key), 3 * law.msd(t), 0.1 * 3 * law.msd(t)) << t;
  }
  for (const auto* axis : {"k_x", "k_y", "k_z"}) EXPECT_NEAR(got[axis], law.k, 1.5);
  EXPECT_NEAR((got["k_x"] + got["k_y"] + got["k_z"]) / 3, law.k, 0.8);
  EXPECT_NEAR(got["kurtosis"], 3, 0.1);
  EXPECT_EQ(p.vacf[0], 1);
  for (std::size_t j = 1; j < p.vacf.size() && plan.vacf_lags[j] <= 100; ++j)
    EXPECT_NEAR(p.vacf[j], law.vacf(static_cast<double>(plan.vacf_lags[j]) * law.dt), 0.07) << plan.vacf_lags[j];
}

// Without chance: a on -k x exactly, a known zero, known displacements. Opposite pairs keep the centroid at rest, pairs a quarter of a
// period apart make every average over the recording one over the period.
TEST(Panel, OscillatorsWithoutNoise) {
  const double dt = 0.01, w = 3;
  const auto rows = test::rows_of(8, 420, dt, [&](std::uint32_t i, double t) {
    const double sign = i < 4 ? 1 : -1, amplitude = i % 4 < 2 ? 1 : 1.5, phase = i % 2 * std::numbers::pi / 2;
    const double x = sign * amplitude * std::cos(w * t + phase);
    return std::array{x, 2 * x, 0.0};
  });
  auto got = panel_named(tracks_of(rows, {.dt = dt, .dims = 2}));
  EXPECT_NEAR(got["k_x"], w * w * (1 - w * w * dt * dt / 12), 1e-4);  // of the second difference
  EXPECT_NEAR(got["k_y"], got["k_x"], 1e-6);
  EXPECT_EQ(got.count("k_z"), 0u);
  EXPECT_NEAR(got["vacf_zero"], std::numbers::pi / (2 * w), 1e-4);
  const double squares = 5 * 0.5 * (1 + 1.5 * 1.5);
  EXPECT_NEAR(got["sd_x"], std::sqrt(squares / 10), 1e-4);
  EXPECT_NEAR(got["sd_y"], 2 * got["sd_x"], 1e-12);
  EXPECT_NEAR(got["msd_0.5s"], squares * (1 - std::cos(w * 0.5)), 1e-9);
}

TEST(Panel, IsotropicHeadings) {
  constexpr std::uint32_t n = 100;
  std::vector<Row> rows;
  for (std::int64_t k = 0; k < 800; ++k)
    for (std::uint32_t i = 0; i < n; ++i) {
      const auto tick = static_cast<std::uint64_t>(k);
      rows.push_back({i, 2 * k, {0, 0, 0}});
      rows.push_back({i, 2 * k + 1, {test::normal(8, tick, i, 0), test::normal(8, tick, i, 1), test::normal(8, tick, i, 2)}});
    }
  // Every second frame everybody is at the origin: the mean over frames is that of independent headings. Scatter 42 %/sqrt(800) = 1.5 %.
  const double expected = std::sqrt(8 / (3 * std::numbers::pi * n));
  EXPECT_NEAR(panel_named(tracks_of(rows))["polarisation"], expected, 0.05 * expected);
}

// A uniform cloud has the Poisson distance but for its surface, whose share falls as N^(-1/dims).
TEST(Panel, PoissonCloud) {
  for (const int dims : {2, 3}) {
    constexpr std::uint32_t n = 3000;
    std::vector<Row> rows;
    for (std::int64_t k = 0; k < 4; ++k)
      for (std::uint32_t i = 0, found = 0; found < n; ++i) {
        const auto tick = static_cast<std::uint64_t>(k);
        std::array<double, 3> p{};
        double r2 = 0;
        for (std::uint32_t a = 0; a < static_cast<std::uint32_t>(dims); ++a) {
          p[a] = 2 * test::uniform(9, tick, i, a) - 1;
          r2 += p[a] * p[a];
        }
        if (r2 > 1) continue;
        p[0] *= 3;  // an ellipsoid
        rows.push_back({found++, k, p});
      }
    EXPECT_NEAR(panel_named(tracks_of(rows, {.dims = dims}))["nearest_ratio"], 1.02, 0.03) << dims;
  }
}

TEST(Panel, PairsAtAKnownDistance) {  // ratio by hand: two per frame at distance 2, along the diagonal of a square of four in all
  std::vector<Row> rows;
  const std::array<std::array<double, 2>, 2> pairs[2] = {{{{-1, 0}, {1, 0}}}, {{{0, -1}, {0, 1}}}};
  for (std::int64_t k = 0; k < 40; ++k)
    for (std::uint32_t i = 0; i < 2; ++i) rows.push_back({i, k, {pairs[k % 2][i][0], pairs[k % 2][i][1], 0}});
  // Sum of x² over free rows: covariance diag(1, 1), area 4π, n = 2: expected distance sqrt(4π/2)/2.
  EXPECT_NEAR(panel_named(tracks_of(rows, {.dims = 2}))["nearest_ratio"], 2 / (0.5 * std::sqrt(2 * std::numbers::pi)), 1e-9);
}

TEST(Panel, MotionOfTheGroupIsTakenOut) {
  const Langevin law;
  auto rows = law.rows(2, 20, 300);
  const Tracks still = tracks_of(rows, {.dt = law.dt});
  for (auto& row : rows) row.p[0] += 700 * law.dt * static_cast<double>(row.frame);
  const Tracks flying = tracks_of(rows, {.dt = law.dt});
  const auto a = panel_named(still), b = panel_named(flying);
  for (const auto& [key, value] : a) {
    if (key == "polarisation" || key == "group_msd_1s" || key == "speed") continue;
    EXPECT_NEAR(b.at(key), value, 1e-6 * std::abs(value)) << key;
  }
  EXPECT_GT(b.at("polarisation"), 0.9);
  EXPECT_GT(b.at("speed"), 700);
}

// Two at a distance of 3 and one 5 from both, flying on at 2; the third rests in every second frame.
TEST(Panel, MeanSpeedAndDistanceByHand) {
  std::vector<Row> rows;
  for (std::int64_t k = 0; k < 41; ++k) {
    const double x = 0.2 * static_cast<double>(k);
    rows.push_back({0, k, {x, 0, 0}});
    rows.push_back({1, k, {x, 3, 0}});
    rows.push_back({2, k, {0.4 * static_cast<double>(k / 2), 103, 0}});
  }
  const auto got = panel_named(tracks_of(rows, {.dims = 2}));
  EXPECT_NEAR(got.at("speed"), 2, 1e-9);  // the third's are 0 and 4
  double third = 0;
  for (std::int64_t k = 0; k < 41; ++k) third += std::hypot(100, 0.2 * static_cast<double>(k % 2)) / 41;
  EXPECT_NEAR(got.at("nearest"), (3 + 3 + third) / 3, 1e-9);
}

// A group that is carried along at 7 per second: 49 after a second, its members' own displacements as if it stood. Frames without anybody
// have no place to be compared with.
TEST(Panel, DisplacementOfTheGroupAsAWhole) {
  const auto flight = [](std::uint32_t i, double t) {
    const double turn = 2 * std::numbers::pi * t + std::numbers::pi * i;
    return std::array{7 * t + std::cos(turn), std::sin(turn), 0.0};
  };
  auto rows = test::rows_of(2, 400, 0.01, flight);
  const auto whole = panel_named(tracks_of(rows, {.dt = 0.01, .dims = 2}));
  EXPECT_NEAR(whole.at("group_msd_1s"), 49, 1e-9);
  EXPECT_NEAR(whole.at("msd_0.5s"), 4, 1e-9);
  std::erase_if(rows, [](const Row& row) { return row.frame >= 90 && row.frame < 310; });
  EXPECT_THAT(panel_named(tracks_of(rows, {.dt = 0.01, .dims = 2})).at("group_msd_1s"), IsNan()) << "no two frames a second apart are left";
}

// The jackknife against the scatter of independent repetitions: 16 of them tell a standard deviation to 18 %, the jackknife over eight
// blocks itself to 27 %.
TEST(Panel, StandardErrorIsTheScatterOfRepetitions) {
  const Langevin law{.tau = 0.1, .s = 600};
  std::vector<double> value, se;
  PanelPlan plan;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    const Tracks tracks = tracks_of(law.rows(10 + seed, 12, 400), {.dt = law.dt});
    plan = panel_plan(tracks);
    const auto e = panel_with_error(tracks, plan);
    EXPECT_EQ(e.value.values.size(), panel(tracks, plan).values.size());
    value.push_back(named(plan, e.value.values)["kurtosis"]);
    se.push_back(named(plan, e.se.values)["kurtosis"]);
  }
  double mean = 0, squares = 0, mean_se = 0;
  for (const double v : value) mean += v / 16;
  for (const double v : value) squares += (v - mean) * (v - mean) / 15;
  for (const double s : se) mean_se += s / 16;
  EXPECT_NEAR(mean_se / std::sqrt(squares), 1, 0.6);
}

TEST(Panel, WithErrorAddsUpToTheWhole) {
  const Tracks tracks = tracks_of(Langevin{}.rows(3, 10, 200), {.dt = 0.01});
  const PanelPlan plan = panel_plan(tracks);
  const Panel whole = panel(tracks, plan);
  const Panel parts = panel_with_error(tracks, plan).value;
  for (std::size_t k = 0; k < whole.values.size(); ++k)
    EXPECT_NEAR(parts.values[k], whole.values[k], 1e-9 * std::abs(whole.values[k])) << k;
}

TEST(Panel, WhatIsUndefinedIsNaN) {
  const auto alone = panel_named(tracks_of(test::rows_of(1, 3, 0.1, [](std::uint32_t, double t) { return std::array{t, 0.0, 0.0}; })));
  EXPECT_THAT(alone.at("sd_x"), IsNan());
  EXPECT_THAT(alone.at("nearest_ratio"), IsNan());
  EXPECT_THAT(alone.at("vacf_zero"), IsNan());
  EXPECT_THAT(alone.at("kurtosis"), IsNan());
}

TEST(PanelPlan, LagsGrowAndReachAQuarterOrASecond) {
  const Tracks tracks = tracks_of(test::rows_of(2, 400, 0.01,
                                                [](std::uint32_t i, double t) {
                                                  return std::array{t * i, 0.0, 0.0};
                                                }),
                                  {.dt = 0.01});
  const PanelPlan plan = panel_plan(tracks);
  EXPECT_EQ(plan.vacf_lags.front(), 0);
  EXPECT_EQ(plan.vacf_lags.back(), 100);
  EXPECT_TRUE(std::is_sorted(plan.vacf_lags.begin(), plan.vacf_lags.end(), std::less_equal<>()));
  EXPECT_THAT(plan.msd_lags, testing::ElementsAre(12, 25, 50, 100));
}

}  // namespace
}  // namespace swarmfit
