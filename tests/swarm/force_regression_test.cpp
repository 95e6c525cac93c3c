// SPDX-License-Identifier: MIT
// Forces planted by an integrator of this file: small Euler steps, no code of libswarm.
#include "libswarm/force_regression.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <random>

namespace swarmfit {
namespace {

using Eigen::Array3d;
using testing::Each;
using testing::IsNan;

struct Planted {
  double drag = 2, speed_drag = 0, stiffness = 5;
  double white = 1, coloured = 0, memory = 0.1;
  std::function<double(double)> pair = {}, alignment = {};
  double error = 0;
  double dt = 0.02;
  int agents = 10, frames = 1500, steps = 20, dims = 3;
  unsigned seed = 1;
};

Tracks flown(const Planted& p) {
  std::mt19937_64 generator(p.seed);
  std::normal_distribution<double> unit;
  const auto normal = [&] {
    Array3d out(unit(generator), unit(generator), unit(generator));
    if (p.dims == 2) out[2] = 0;
    return out;
  };
  std::vector<Array3d> x, v, eta;
  for (int i = 0; i < p.agents; ++i) x.push_back(0.5 * normal()), v.push_back(0.5 * normal()), eta.push_back(p.coloured * normal());
  TrackColumns c;
  for (int i = 0; i < p.agents; ++i) c.names.push_back(std::to_string(i));
  c.pos.resize(static_cast<Index>(p.agents) * p.frames, 3);
  const double h = p.dt / p.steps, kept = std::exp(-h / p.memory);
  for (int k = 0; k < p.frames; ++k) {
    for (int i = 0; i < p.agents; ++i) {
      c.track.push_back(static_cast<std::uint32_t>(i));
      c.frame.push_back(k);
      c.pos.row(static_cast<Index>(k) * p.agents + i) = (x[static_cast<std::size_t>(i)] + p.error * normal()).transpose();
    }
    for (int s = 0; s < p.steps; ++s) {
      const auto before = x, flew = v;
      for (std::size_t i = 0; i < x.size(); ++i) {
        const double speed = std::sqrt(flew[i].square().sum());
        Array3d f = -(p.drag + p.speed_drag * speed) * flew[i] - p.stiffness * before[i] + eta[i];
        for (std::size_t j = 0; j < x.size(); ++j) {
          if (j == i) continue;
          const Array3d away = before[j] - before[i];
          const double r = std::sqrt(away.square().sum());
          if (p.pair) f += p.pair(r) * away / r;
          if (p.alignment) f += p.alignment(r) * (flew[j] - flew[i]);
        }
        v[i] = flew[i] + h * f + p.white * std::sqrt(h) * normal();
        x[i] = before[i] + h * flew[i];
        eta[i] = kept * eta[i] + p.coloured * std::sqrt(1 - kept * kept) * normal();
      }
    }
  }
  TrackMeta meta;
  meta.dims = p.dims;
  meta.dt = p.dt;
  return {std::move(c), meta};
}

constexpr ForceGroups kAll{true, true, true, true, true, true, true};

ForceFit fitted(const Tracks& tracks) { return fit_forces(tracks, force_basis(tracks)); }

bool kept(const ForceFit& fit, ForceGroup group) { return fit.groups[static_cast<std::size_t>(group)]; }

void expect_drag_and_stiffness(const ForceFit& fit, const Planted& p) {
  EXPECT_NEAR(fit.law.drag(0), p.drag, 4 * fit.drag_se(0));
  EXPECT_LT(fit.drag_se(0), 0.25 * p.drag);
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(p.dims); ++axis) {
    EXPECT_NEAR(-fit.law.at(ForceGroup::confinement, axis), p.stiffness, 4 * fit.se(ForceGroup::confinement, axis));
    EXPECT_LT(fit.se(ForceGroup::confinement, axis), 0.2 * p.stiffness);
  }
}

// What is not there is left out; what is, is found: with localisation error, too, of a sixth of what is flown in a frame.
TEST(ForceRegression, WhiteNoise) {
  for (const double error : {0.0, 0.002}) {
    const Planted p{.error = error};
    const ForceFit fit = fitted(flown(p));
    expect_drag_and_stiffness(fit, p);
    for (const ForceGroup g : {ForceGroup::hardening, ForceGroup::pair, ForceGroup::alignment}) EXPECT_FALSE(kept(fit, g)) << to_string(g);
    EXPECT_EQ(fit.law.memory, 0);
    for (const double white : fit.law.white) EXPECT_NEAR(white, p.white, 0.06 * p.white);
  }
}

// Noise that remembers pushes along the velocity that it made: a plain regression takes that for less drag, or none.
TEST(ForceRegression, ColouredNoise) {
  for (const double error : {0.0, 0.002}) {
    const Planted p{.white = 0, .coloured = 4, .error = error};
    const ForceFit fit = fitted(flown(p));
    expect_drag_and_stiffness(fit, p);
    EXPECT_NEAR(fit.law.memory, p.memory, 0.3 * p.memory);
    for (const double coloured : fit.law.coloured) EXPECT_NEAR(coloured, p.coloured, 0.15 * p.coloured);
  }
}

// A memory that is taken for too long explains everything, and leaves the forces anything: it must not happen once.
TEST(ForceRegression, NoSeedGetsLost) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Planted p{.drag = 3,
                    .stiffness = 4,
                    .white = 0,
                    .coloured = 4,
                    .memory = 0.03,
                    .error = 0.0002,
                    .dt = 0.01,
                    .frames = 500,
                    .steps = 4,
                    .seed = seed};
    const Tracks tracks = flown(p);
    const ForceFit fit = ForceRegression(tracks, force_basis(tracks)).fit({true, false, true});
    EXPECT_NEAR(std::log(fit.law.memory / p.memory), 0, std::log(1.6)) << seed;
    EXPECT_NEAR(fit.law.drag(0), p.drag, 1.2) << seed;
  }
}

TEST(ForceRegression, DragThatDependsOnSpeed) {
  const Planted p{.drag = 0.5, .speed_drag = 3, .frames = 3000};
  const ForceFit fit = fitted(flown(p));
  EXPECT_TRUE(kept(fit, ForceGroup::speed_drag));
  for (const double share : {0.3, 0.5, 0.8}) {
    const double speed = share * fit.law.basis.top_speed;
    EXPECT_NEAR(fit.law.drag(speed), p.drag + p.speed_drag * speed, 4 * fit.drag_se(speed)) << speed;
    EXPECT_LT(fit.drag_se(speed), 1);
  }
  EXPECT_EQ(fit.law.drag(1e9), fit.law.drag(fit.law.basis.top_speed)) << "nothing is extrapolated";
}

// Soft repulsion within 0.6, and alignment that fades.
TEST(ForceRegression, KernelsOfPairs) {
  const Planted p{.pair = [](double r) { return r < 0.6 ? -3 * (1 - r / 0.6) : 0.0; },
                  .alignment = [](double r) { return 0.3 * std::exp(-r); }};
  const ForceFit fit = fitted(flown(p));
  EXPECT_TRUE(kept(fit, ForceGroup::pair));
  EXPECT_TRUE(kept(fit, ForceGroup::alignment));
  expect_drag_and_stiffness(fit, {.drag = p.drag, .stiffness = p.stiffness});
  // At the knots the kernel is the best straight line about the planted one, not the planted one.
  for (const double r : {0.3, 0.5, 0.7, 0.9}) {
    EXPECT_NEAR(fit.law.kernel(ForceGroup::pair, r), p.pair(r), 0.15 + 4 * fit.kernel_se(ForceGroup::pair, r)) << r;
    EXPECT_NEAR(fit.law.kernel(ForceGroup::alignment, r), p.alignment(r), 0.03 + 4 * fit.kernel_se(ForceGroup::alignment, r)) << r;
    EXPECT_LT(fit.kernel_se(ForceGroup::pair, r), 0.3);
  }
  EXPECT_EQ(fit.law.kernel(ForceGroup::pair, 1e9), 0);
}

// Standard errors are those of estimates from other seeds: 40 of a push that is not there, and of drag.
TEST(ForceRegression, ErrorsAreTheScatter) {
  constexpr int kSeeds = 40;
  double misses = 0;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const Planted p{.agents = 4, .frames = 1000, .steps = 10, .seed = 100 + seed};
    const ForceFit fit = ForceRegression(flown(p), {.dims = 3, .top_speed = 1e9, .reach = 1e9, .knots = {}}).fit(kAll);
    misses += std::pow((fit.law.at(ForceGroup::push, 0)) / fit.se(ForceGroup::push, 0), 2);
    misses += std::pow((fit.law.drag(0.8) - p.drag) / fit.drag_se(0.8), 2);
  }
  EXPECT_GT(misses / (2 * kSeeds), 0.5);  // chi² of 80: 0.5 and 1.7 are beyond 99.9 %
  EXPECT_LT(misses / (2 * kSeeds), 1.7);
}

// The equations that the coefficients solve, by going from individual to individual: instruments of four frames before are not correlated
// with what the law leaves over.
TEST(ForceRegression, TheInstrumentsAreAtRightAngles) {
  Planted p{.white = 0, .coloured = 6, .pair = [](double r) { return -std::exp(-r); }, .agents = 4, .frames = 250, .steps = 5, .dims = 2};
  Tracks whole = flown(p);
  TrackColumns c = whole.columns();  // with a gap
  for (Index row = c.pos.rows(); row-- > 0;)
    if (c.track[static_cast<std::size_t>(row)] == 1 && c.frame[static_cast<std::size_t>(row)] == 50) {
      const Index rest = c.pos.rows() - row - 1;
      const Rows after = c.pos.bottomRows(rest);
      c.pos.conservativeResize(c.pos.rows() - 1, 3);
      c.pos.bottomRows(rest) = after;
      c.track.erase(c.track.begin() + row);
      c.frame.erase(c.frame.begin() + row);
    }
  const Tracks tracks(std::move(c), whole.meta());
  const ForceFit fit = ForceRegression(tracks, force_basis(tracks)).fit(kAll);
  ASSERT_GT(fit.law.memory, 0);

  std::map<std::pair<std::uint32_t, std::int64_t>, Array3d> seen;
  for (Index row = 0; row < tracks.rows(); ++row)
    seen[{tracks.track()[static_cast<std::size_t>(row)], tracks.frame()[static_cast<std::size_t>(row)]}] =
        tracks.pos().row(row).transpose();
  const auto has = [&](std::uint32_t i, std::int64_t k) { return seen.count({i, k - 1}) && seen.count({i, k}) && seen.count({i, k + 1}); };
  const auto at = [&](std::uint32_t i, std::int64_t k) { return seen.at({i, k}); };
  const auto x_of = [&](std::uint32_t i, std::int64_t k) -> Array3d {
    return has(i, k) ? Array3d((at(i, k - 1) + at(i, k) + at(i, k + 1)) / 3) : at(i, k);
  };
  const auto v_of = [&](std::uint32_t i, std::int64_t k) -> Array3d { return (at(i, k + 1) - at(i, k - 1)) / (2 * p.dt); };
  // The term `c` alone, at one place: the law with that coefficient 1.
  const auto term = [&](Index which, std::uint32_t i, std::int64_t k) {
    ForceLaw one = fit.law;
    one.coefficients.setZero();
    one.coefficients[which] = 1;
    const Array3d v = v_of(i, k), x = x_of(i, k) - one.basis.centre;
    const double distance = std::min(std::sqrt(x.square().sum()), one.basis.reach);
    Array3d f = -one.drag(std::sqrt(v.square().sum())) * v;
    for (int axis = 0; axis < 2; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      f[axis] += (one.at(ForceGroup::confinement, a) + distance * distance * one.at(ForceGroup::hardening)) * x[axis];
      f[axis] += one.at(ForceGroup::push, a);
    }
    for (std::uint32_t j = 0; j < 4; ++j) {
      if (j == i || !seen.count({j, k})) continue;
      const Array3d away = x_of(j, k) - x_of(i, k);
      const double r = std::sqrt(away.square().sum());
      f += one.kernel(ForceGroup::pair, r) * away / r;
      if (has(j, k)) f += one.kernel(ForceGroup::alignment, r) * (v_of(j, k) - v);
    }
    return f;
  };
  const auto size = fit.law.coefficients.size();
  const auto left_over = [&](std::uint32_t i, std::int64_t k) {
    Array3d e = (at(i, k + 1) - 2 * at(i, k) + at(i, k - 1)) / (p.dt * p.dt);
    for (Index b = 0; b < size; ++b) e -= fit.law.coefficients[b] * term(b, i, k);
    return e;
  };
  const double rho = std::exp(-p.dt / fit.law.memory);
  Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(size), total = Eigen::ArrayXd::Zero(size);
  Index rows = 0;
  for (std::uint32_t i = 0; i < 4; ++i)
    for (std::int64_t k = 5; k < p.frames - 1; ++k) {
      bool unbroken = true;
      for (std::int64_t m = k - 5; m <= k + 1; ++m) unbroken = unbroken && seen.count({i, m});
      if (!unbroken) continue;
      ++rows;
      const Array3d fresh = left_over(i, k) - rho * left_over(i, k - 1);
      for (Index b = 0; b < size; ++b) {
        const Array3d product = term(b, i, k - 4) * fresh;
        sum[b] += product.sum();
        total[b] += product.abs().sum();
      }
    }
  EXPECT_EQ(rows, fit.rows);
  EXPECT_LT((sum / total).abs().maxCoeff(), 1e-9);
}

// Of many individuals some are equations, and all are neighbours.
TEST(ForceRegression, LargeGroupsAreSampled) {
  const Planted p{.drag = 3, .agents = 300, .frames = 220, .steps = 3};
  const ForceFit fit = fitted(flown(p));
  EXPECT_GT(fit.rows, 20000);
  EXPECT_LT(fit.rows, 40000);
  expect_drag_and_stiffness(fit, {.drag = p.drag});
  const Planted longer{.agents = 4, .frames = 15000, .steps = 2};  // windows of 1250 frames
  const ForceFit windows = fitted(flown(longer));
  EXPECT_GT(windows.rows, 30000);
  EXPECT_LT(windows.rows, 40000);
  EXPECT_NEAR(windows.law.drag(0), longer.drag, 0.2);
}

TEST(ForceRegression, TooLittleIsSaidToBe) {
  const Tracks tracks = flown({.agents = 2, .frames = 12, .steps = 2});
  const ForceFit fit = fitted(tracks);
  EXPECT_THAT(std::vector<double>(fit.law.coefficients.begin(), fit.law.coefficients.end()), Each(IsNan()));
  const Tracks alone = flown({.agents = 1, .frames = 400, .steps = 2});
  EXPECT_EQ(force_basis(alone).kernel_size(), 0u);
  EXPECT_TRUE(fitted(alone).law.coefficients.allFinite()) << "nobody to interact with, but forces";
}

TEST(ForceLaw, HatsAreAPartition) {
  const ForceBasis basis{.knots = {1, 2, 4, 5}};
  for (const double r : {0.0, 0.5, 1.0, 1.5, 3.9, 4.0}) {
    const auto h = basis.hat(r);
    EXPECT_DOUBLE_EQ(h.weight + h.next, 1) << r;
  }
  EXPECT_DOUBLE_EQ(basis.hat(4.5).weight, 0.5) << "0 from the last knot on";
  EXPECT_EQ(basis.hat(4.5).next, 0);
  EXPECT_EQ(basis.hat(5).weight, 0);
}

}  // namespace
}  // namespace swarmfit
