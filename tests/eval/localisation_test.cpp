// SPDX-License-Identifier: MIT
#include "libeval/localisation.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/eval/build.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;
using test::Row;
using test::Settings;
using test::tracks_of;
constexpr double kDt = 0.01;

// 20 insects on smooth orbits of 80 mm, up to 3 turns per second, seen at 100 Hz.
std::vector<Row> orbits(std::int64_t frames = 400) {
  return test::rows_of(20, frames, kDt, [](std::uint32_t i, double t) { return test::orbit(1, 80, 3, i, t); });
}

// Replaces every track's positions by weighted means over neighbouring frames, as a smoothing tracker does.
std::vector<Row> smoothed(std::vector<Row> rows, std::uint32_t individuals, const std::vector<double>& kernel) {
  const std::vector<Row> raw = rows;
  const auto n = static_cast<std::ptrdiff_t>(rows.size()), stride = static_cast<std::ptrdiff_t>(individuals);
  const auto half = static_cast<std::ptrdiff_t>(kernel.size() / 2);
  std::vector<Row> out;
  for (std::ptrdiff_t i = half * stride; i < n - half * stride; ++i) {
    Row row = raw[static_cast<std::size_t>(i)];
    row.p = {0, 0, 0};
    for (std::ptrdiff_t k = -half; k <= half; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis)
        row.p[axis] += kernel[static_cast<std::size_t>(k + half)] * raw[static_cast<std::size_t>(i + k * stride)].p[axis];
    out.push_back(row);
  }
  return out;
}

std::vector<double> gaussian(double width) {
  std::vector<double> kernel;
  double sum = 0;
  for (int k = -8; k <= 8; ++k) kernel.push_back(std::exp(-0.5 * k * k / (width * width))), sum += kernel.back();
  for (double& w : kernel) w /= sum;
  return kernel;
}

std::vector<Row> jittered(std::vector<Row> rows, double sigma, std::uint64_t seed = 2) {
  for (Row& row : rows)
    for (std::uint32_t axis = 0; axis < 3; ++axis)
      row.p[axis] += sigma * test::normal(seed, static_cast<std::uint64_t>(row.frame), row.track, axis);
  return rows;
}

Localisation estimate(const std::vector<Row>& rows, int dims = 3) {
  return estimate_localisation(tracks_of(rows, {.dt = kDt, .dims = dims}));
}

// 20 x 400 positions: the standard error of sigma is about 1.5 %; the bound on what motion may leave in is 2.5 %.
TEST(Localisation, RecoversWhiteErrorPerAxis) {
  const Array3d sigma(0.1, 0.2, 0.4);
  const Localisation l = estimate_localisation(with_error(tracks_of(orbits(), {.dt = kDt}), sigma, 3));
  EXPECT_TRUE(l.white);
  EXPECT_FALSE(l.rounding);
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(l.sigma[axis] / sigma[axis], 1, 0.05);
  EXPECT_GT(l.samples, 20000);
}

TEST(Localisation, RecoversErrorsOverFourOrdersOfMagnitude) {
  for (const double sigma : {0.001, 0.01, 0.1, 1.0, 10.0}) {
    const Localisation l = estimate(jittered(orbits(), sigma));
    EXPECT_TRUE(l.white) << sigma;
    for (const double s : l.sigma) EXPECT_NEAR(s / sigma, 1, 0.05) << sigma;
  }
}

// Turns of 10 frames leave more than the error's variance in every difference up to the fifth; at the seventh, 0.5 % of it.
TEST(Localisation, FasterMotionNeedsHigherOrders) {
  const auto rows = test::rows_of(20, 400, kDt, [](std::uint32_t i, double t) { return test::orbit(1, 80, 10, i, t); });
  const Localisation l = estimate(jittered(rows, 0.5));
  for (const double s : l.sigma) EXPECT_NEAR(s, 0.5, 0.025);
}

TEST(Localisation, WithoutErrorNothingIsFound) {
  const Localisation l = estimate(orbits());
  EXPECT_LT(l.sigma.maxCoeff(), 1e-6 * 80);
  EXPECT_LT(l.acceleration_share, 1e-6);
  EXPECT_LT(l.jerk_share, 1e-4);
}

TEST(Localisation, GapsAndShortTracksStillGiveTheError) {
  auto rows = jittered(orbits(), 0.3);
  std::erase_if(rows, [](const Row& r) { return test::uniform(7, static_cast<std::uint64_t>(r.frame), r.track) < 0.08; });
  const Localisation l = estimate(rows);
  EXPECT_TRUE(l.white);
  for (const double s : l.sigma) EXPECT_NEAR(s, 0.3, 0.03);  // a quarter as many differences of high order
}

TEST(Localisation, IdentityJumpsDoNotCount) {
  auto rows = jittered(orbits(), 0.1);
  for (Row& row : rows)  // individuals 0 and 1 change places every 50 frames
    if (row.track < 2 && row.frame / 50 % 2 == 1) row.track = 1 - row.track;
  const Localisation l = estimate(rows);
  EXPECT_TRUE(l.white);
  for (const double s : l.sigma) EXPECT_NEAR(s, 0.1, 0.01);
}

// One detection in twenty is ten times as wrong: the root mean square of the error is 2.4 times that of its bulk.
TEST(Localisation, HeavyTailsDoNotCount) {
  auto rows = jittered(orbits(), 0.1);
  for (Row& r : rows) {
    if (test::uniform(7, static_cast<std::uint64_t>(r.frame), r.track) >= 0.05) continue;
    for (double& x : r.p) x += test::uniform(8, static_cast<std::uint64_t>(r.frame), r.track) - 0.5 > 0 ? 1.0 : -1.0;
  }
  const Localisation l = estimate(rows);
  for (const double s : l.sigma) EXPECT_NEAR(s, 0.1, 0.04);
}

TEST(Localisation, SharesOfAccelerationAndJerk) {
  // The true mean squared acceleration of the orbits, by second differences without error, makes the expected share exact.
  const double sigma = 0.1;
  double acceleration = 0, jerk = 0;
  for_each_segment(tracks_of(orbits(), {.dt = kDt}), 4, [&](std::span<const Index> rows) {
    const Tracks t = tracks_of(orbits(), {.dt = kDt});
    double a = 0, j = 0;
    for (std::size_t k = 0; k + 3 < rows.size(); ++k) {
      const auto p = [&](std::size_t i) { return t.pos().row(rows[k + i]); };
      a += (p(2) - 2 * p(1) + p(0)).square().sum();
      j += (p(3) - 3 * p(2) + 3 * p(1) - p(0)).square().sum();
    }
    acceleration += a / static_cast<double>(rows.size() - 3) / 20;
    jerk += j / static_cast<double>(rows.size() - 3) / 20;
  });
  const Localisation l = estimate(jittered(orbits(), sigma));
  const double from_error = 3 * sigma * sigma;
  EXPECT_NEAR(l.acceleration_share, 6 * from_error / (6 * from_error + acceleration), 0.03);
  EXPECT_NEAR(l.jerk_share, 20 * from_error / (20 * from_error + jerk), 0.03);
}

// A Gaussian of half a frame still leaves 70 % of the error's level at the highest frequency beside the rest, and passes for white.
TEST(Localisation, SmoothedErrorIsNotWhite) {
  const auto raw = jittered(orbits(), 0.3);
  for (const double width : {0.7, 1.0, 2.0}) EXPECT_FALSE(estimate(smoothed(raw, 20, gaussian(width))).white) << "Gaussian " << width;
  EXPECT_FALSE(estimate(smoothed(raw, 20, {1 / 3., 1 / 3., 1 / 3.})).white) << "moving mean of 3";
  EXPECT_FALSE(estimate(smoothed(raw, 20, {.2, .2, .2, .2, .2})).white) << "moving mean of 5";
  const std::vector<double> savitzky_golay = {-3 / 35., 12 / 35., 17 / 35., 12 / 35., -3 / 35.};
  EXPECT_FALSE(estimate(smoothed(raw, 20, savitzky_golay)).white) << "Savitzky-Golay, 5 points";
}

TEST(Localisation, RoundingInTheFileIsNotCameraError) {
  auto rows = smoothed(jittered(orbits(), 0.3), 20, gaussian(2));
  for (Row& row : rows)
    for (double& x : row.p) x = std::round(x * 100) / 100;
  const Localisation l = estimate(rows);
  EXPECT_FALSE(l.white);
  EXPECT_TRUE(l.rounding);
  for (const double s : l.sigma) EXPECT_NEAR(s, 0.01 / std::sqrt(12.0), 2e-4);
  EXPECT_TRUE(estimate(jittered(orbits(), 0.3)).white);  // and rounding far below the error does no harm
  auto fine = jittered(orbits(), 0.3);
  for (Row& row : fine)
    for (double& x : row.p) x = std::round(x * 100) / 100;
  EXPECT_TRUE(estimate(fine).white);
}

TEST(Localisation, RoughMotionIsNotTakenForTheCamera) {
  const Settings settings{.dt = kDt};
  const Localisation l = estimate(test::trapped(4, 20, 400, settings));
  EXPECT_FALSE(l.white);
}

TEST(Localisation, LangevinMotionWithErrorAboveItsRoughness) {
  // Frame-to-frame roughness of the motion: 400 mm/s^1.5 x (0.01 s)^1.5 / sqrt(48) = 0.06 mm
  const Localisation l = estimate(jittered(test::trapped(4, 20, 400, {.dt = kDt}), 0.6));
  EXPECT_TRUE(l.white);
  for (const double s : l.sigma) EXPECT_NEAR(s, 0.6, 0.03);
}

// The steps of a random walk are its own: it is rough at every scale, and a quarter less so at the highest frequencies.
TEST(Localisation, ARandomWalkIsNotTakenForTheCamera) {
  std::vector<Row> rows;
  std::array<std::array<double, 3>, 20> place{};
  for (std::int64_t f = 0; f < 300; ++f)
    for (std::uint32_t i = 0; i < 20; ++i) {
      for (std::uint32_t axis = 0; axis < 3; ++axis) place[i][axis] += test::normal(11, static_cast<std::uint64_t>(f), i, axis);
      rows.push_back({i, f, place[i]});
    }
  EXPECT_FALSE(estimate(rows).white);
}

// A new direction every frame, at one speed: as rough as white error in every coordinate, but a camera would have changed the speed, too.
TEST(Localisation, RoughPathsAtConstantSpeedAreNotTakenForTheCamera) {
  const auto zigzag = [](double wobble) {
    std::vector<Row> rows;
    std::array<std::array<double, 3>, 20> place{};
    for (std::int64_t f = 0; f < 300; ++f)
      for (std::uint32_t i = 0; i < 20; ++i) {
        const auto tick = static_cast<std::uint64_t>(f);
        // places that scatter about a straight line of their own, as errors do, but along it only as much as keeps the speed
        const double before = wobble * test::normal(5, tick, i, 0), after = wobble * test::normal(5, tick + 1, i, 0);
        rows.push_back({i, f, place[i]});
        const double across = after - before;
        place[i][1] += across;
        place[i][0] += std::sqrt(1 - across * across);
      }
    return rows;
  };
  EXPECT_FALSE(estimate(zigzag(0.05), 2).white);
}

// Velocities that are kicked `steps` times per frame, and friction of 2 per second: 15 particles for 5 s.
std::vector<Row> kicked(int steps, std::uint64_t seed) {
  std::vector<Row> rows;
  const double h = kDt / steps, kick = 250 * std::sqrt(h);
  for (std::uint32_t i = 0; i < 15; ++i) {
    Array3d x = Array3d::Zero(), v = Array3d::Constant(100);
    for (std::int64_t frame = 0; frame < 500; ++frame) {
      rows.push_back({i, frame, {x[0], x[1], x[2]}});
      for (int s = 0; s < steps; ++s) {
        for (std::uint32_t axis = 0; axis < 3; ++axis)
          v[axis] += kick * test::normal(seed, static_cast<std::uint64_t>(frame * steps + s), i, axis) - 2 * h * v[axis];
        x += h * v;
      }
    }
  }
  return rows;
}

// The error makes up half of the second differences' variance.
TEST(Localisation, ErrorUponMotionInWhiteNoiseIsTold) {
  for (const int steps : {1, 10})
    for (const std::uint64_t seed : {3U, 4U, 5U}) {
      const Localisation alone = estimate(kicked(steps, seed));
      EXPECT_FALSE(alone.white) << steps << " seed " << seed;
      const Localisation seen = estimate(jittered(kicked(steps, seed), 0.1, seed + 100));
      EXPECT_TRUE(seen.white) << steps << " seed " << seed;
      // Kicks once per frame add 1/27 of their variance, .0625 mm², to that of .01 mm².
      for (Index axis = 0; axis < 3; ++axis) EXPECT_NEAR(seen.sigma[axis], steps == 1 ? 0.11 : 0.1, 0.01) << steps << " seed " << seed;
    }
}

TEST(Localisation, PlanarMotionHasNoErrorAlongZ) {
  auto rows = jittered(orbits(), 0.2);
  for (Row& row : rows) row.p[2] = 0;
  const Localisation l = estimate(rows, 2);
  EXPECT_TRUE(l.white);
  EXPECT_EQ(l.sigma[2], 0);
  EXPECT_NEAR(l.sigma[0], 0.2, 0.01);
}

TEST(Localisation, TooLittleDataSaysNothing) {
  for (const Tracks& tracks : {Tracks(), tracks_of(orbits(3)), tracks_of({{0, 0, {1, 2, 3}}})}) {
    const Localisation l = estimate_localisation(tracks);
    EXPECT_EQ(l.samples, 0);
    EXPECT_FALSE(l.white);
    EXPECT_EQ(l.sigma.maxCoeff(), 0);
    EXPECT_EQ(l.acceleration_share, 0);
  }
}

TEST(WithError, AddsIndependentNormalErrorAndKeepsTheRest) {
  const Tracks before = tracks_of(orbits(), {.dt = kDt}), after = with_error(before, {1, 2, 3}, 5);
  EXPECT_EQ(after.rows(), before.rows());
  EXPECT_TRUE((with_error(before, {1, 2, 3}, 5).pos() == after.pos()).all());
  EXPECT_FALSE((with_error(before, {1, 2, 3}, 6).pos() == after.pos()).all());
  const Rows e = after.pos() - before.pos();
  const auto n = static_cast<double>(e.rows());  // 8 000: four standard errors are 0.045 of the mean, 3.2 % of sigma
  for (Index axis = 0; axis < 3; ++axis) {
    const double sigma = static_cast<double>(axis) + 1;
    EXPECT_NEAR(e.col(axis).mean() / sigma, 0, 0.045);
    EXPECT_NEAR(std::sqrt(e.col(axis).square().sum() / n) / sigma, 1, 0.032);
  }
  EXPECT_NEAR((e.col(0) * e.col(1)).mean(), 0, 0.09);
  EXPECT_NEAR((e.col(1) * e.col(2)).mean(), 0, 0.27);
  auto flat = orbits();
  for (Row& row : flat) row.p[2] = 0;
  EXPECT_TRUE((with_error(tracks_of(flat, {.dims = 2}), {1, 1, 1}, 5).pos().col(2) == 0).all());
}

TEST(ErrorShare, RisesFromNothingToAll) {
  const Tracks clean = tracks_of(orbits(), {.dt = kDt});
  const Array3d sigma(0.1, 0.1, 0.1);
  const auto share = error_share(with_error(clean, sigma, 1), sigma, 2);
  EXPECT_LT(share[kSpeed], 0.05);
  EXPECT_LT(share[kDistance], 0.02);
  EXPECT_GT(share[kJerk], 0.85);  // 20 sigma² of error against orbits of 3 Hz at most
  const auto none = error_share(clean, {0, 0, 0}, 2);
  for (const double s : none) EXPECT_EQ(s, 0);
  // animals that stand still: all speed is error. 40 000 overlapping values: the standard error of the share is about 0.04.
  const auto rest = [](std::uint32_t i, double) { return std::array{1.0 * i, 0.0, 0.0}; };
  const Tracks still = tracks_of(test::rows_of(20, 2000, kDt, rest), {.dt = kDt});
  const auto all = error_share(with_error(still, sigma, 1), sigma, 2);
  for (const Metric m : {kSpeed, kAcceleration, kJerk}) EXPECT_NEAR(all[m], 1, 0.1) << kMetricInfo[m].key;
}

// A handful of tracks that go astray make most of the variance of the jerk, and must not hide that the rest of it is error.
TEST(ErrorShare, IsNotDecidedByAFewWildValues) {
  const Array3d sigma(0.1, 0.1, 0.1);
  auto rows = jittered(orbits(), 0.1);
  const double before = error_share(tracks_of(rows, {.dt = kDt}), sigma, 2)[kJerk];
  for (Row& row : rows)
    if (row.frame % 100 == 50 && row.track < 3) row.p[0] += 200;
  EXPECT_NEAR(error_share(tracks_of(rows, {.dt = kDt}), sigma, 2)[kJerk], before, 0.03);
  EXPECT_GT(before, 0.85);
}

// Straight flight at 200 mm/s with a sharp turn every 25 frames: an error of a micrometre is most of what the bulk of the accelerations
// is made of, and moves no histogram.
TEST(ErrorShare, OfWhatNoHistogramCanShowIsNothing) {
  const auto zigzag = test::rows_of(10, 200, kDt, [](std::uint32_t i, double t) {
    const double leg = 0.25, phase = t + 0.013 * i, k = std::floor(phase / leg), rest = phase - k * leg;
    const double across = std::fmod(k, 2.0) == 0 ? rest : leg - rest;
    return std::array<double, 3>{200 * t, 200 * across, 30.0 * i};
  });
  const Tracks seen = with_error(tracks_of(zigzag, {.dt = kDt}), {1e-3, 1e-3, 1e-3}, 1);
  const auto share = error_share(seen, {1e-3, 1e-3, 1e-3}, 2);
  EXPECT_EQ(share[kAcceleration], 0);
  EXPECT_EQ(share[kJerk], 0);
  const auto gross = error_share(with_error(seen, {5, 5, 5}, 3), {5, 5, 5}, 2);
  EXPECT_GT(gross[kJerk], 0.8) << "an error that shows counts";
}

TEST(ErrorShare, UndefinedMetricsAreNaN) {
  for (const double s : error_share(Tracks(), {1, 1, 1}, 1)) EXPECT_TRUE(std::isnan(s));
  const auto share = error_share(tracks_of({{0, 0, {0, 0, 0}}, {0, 1, {1, 0, 0}}}), {1, 1, 1}, 1);
  for (const double s : share) EXPECT_TRUE(std::isnan(s));
}

}  // namespace
}  // namespace swarmfit
