// SPDX-License-Identifier: MIT
#include "libeval/nearness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace swarmfit {
namespace {

template <class Place>
Tracks individuals(std::uint32_t count, std::int64_t frames, Place place, double dt = 0.1) {
  TrackColumns c;
  c.pos.resize(static_cast<Index>(count) * frames, 3);
  Index row = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    c.names.push_back(std::to_string(i));
    for (std::int64_t f = 0; f < frames; ++f, ++row) {
      c.track.push_back(i);
      c.frame.push_back(f);
      c.pos.row(row) = Eigen::Array3d(place(i, static_cast<double>(f))).transpose();
    }
  }
  TrackMeta meta;
  meta.dt = dt;
  return {std::move(c), meta};
}

Tracks straight(double step, const Eigen::Array3d& from) {
  return individuals(1, 40, [=](std::uint32_t, double f) { return Eigen::Array3d(from[0] + step * f, from[1], from[2]); });
}

TEST(Nearness, IsZeroToOneselfWhereverItHappens) {
  EXPECT_EQ(distance_to_nearest(straight(1, {0, 0, 0}), straight(1, {0, 0, 0}), 20), 0);
  EXPECT_NEAR(distance_to_nearest(straight(1, {0, 0, 0}), straight(1, {50, -3, 2}), 20), 0, 1e-12);
}

// Displacements of 3 f against f at f = 2, 4, .. 20: 2 f apart, root mean square 2 · 2 · sqrt(mean of k² for k = 1 .. 10).
TEST(Nearness, IsTheRootMeanSquareDifferenceOfDisplacements) {
  EXPECT_NEAR(distance_to_nearest(straight(3, {0, 0, 0}), straight(1, {0, 0, 0}), 20), 4 * std::sqrt(38.5), 1e-9);
}

TEST(Nearness, IsUndefinedWithoutUnbrokenPieces) {
  EXPECT_TRUE(std::isnan(distance_to_nearest(straight(1, {0, 0, 0}), straight(1, {0, 0, 0}), 40)));
  EXPECT_FALSE(std::isnan(distance_to_nearest(straight(1, {0, 0, 0}), straight(1, {0, 0, 0}), 39)));
}

// Circles at angular velocity w: velocities are correlated by cos(w t), which is 1/e at w t = acos(1/e).
TEST(CorrelationTime, OfCircles) {
  constexpr double w = 0.02;
  const Tracks circles = individuals(40, 1000, [](std::uint32_t i, double f) {
    const double angle = w * f + 2 * std::numbers::pi * i / 40;
    return Eigen::Array3d(std::cos(angle), std::sin(angle), 0);
  });
  EXPECT_NEAR(correlation_time(circles), 0.1 * std::acos(1 / std::numbers::e) / w, 0.1);
}

// What all have in common is no memory of their own, and with nothing else the answer is the longest there is.
TEST(CorrelationTime, LeavesOutTheCommonMotion) {
  const auto wind = [](double f) { return 100 * std::cos(0.001 * f); };
  const auto moving = [&](bool common) {
    return correlation_time(individuals(20, 1000, [&](std::uint32_t i, double f) {
      const double angle = 0.05 * f + 2 * std::numbers::pi * i / 20;
      return Eigen::Array3d(std::cos(angle) + (common ? wind(f) : 0), std::sin(angle), 0);
    }));
  };
  EXPECT_NEAR(moving(true), moving(false), 1e-9);
}

}  // namespace
}  // namespace swarmfit
