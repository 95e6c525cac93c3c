// SPDX-License-Identifier: MIT
#include "libeval/herding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace swarmfit {
namespace {

using Eigen::Array3d;

constexpr double kDt = 0.5;
constexpr int kFrames = 401;

// Four sheep at (±out, 0) and (0, ±out) of a centre that comes in along x from -200 by one per frame, and a shepherd behind it.
Tracks drive(double out, const std::function<double(int)>& side) {
  TrackColumns columns;
  std::vector<Array3d> pos;
  for (int k = 0; k < kFrames; ++k) {
    const Array3d centre(k - 200.0, 3, 0);
    for (const Array3d& off : {Array3d(out, 0, 0), Array3d(-out, 0, 0), Array3d(0, out, 0), Array3d(0, -out, 0)})
      pos.push_back(centre + off);
    pos.push_back(centre + Array3d(-10, side(k), 0));
    for (std::uint32_t i = 0; i < 5; ++i) {
      columns.track.push_back(i), columns.frame.push_back(k);
      columns.kind.push_back(i == 4);
    }
  }
  columns.names = {"a", "b", "c", "d", "dog"};
  columns.pos.resize(static_cast<Index>(pos.size()), 3);
  for (std::size_t k = 0; k < pos.size(); ++k) columns.pos.row(static_cast<Index>(k)) = pos[k].transpose();
  TrackMeta meta;
  meta.dims = 2, meta.dt = kDt;
  return {std::move(columns), meta};
}

TEST(Herding, HomecomingSpreadAndSpeed) {
  const Herding h = herding(drive(2, [](int) { return 1.0; }), {.target = Array3d(0, 3, 0)});
  EXPECT_EQ(h.time, 191 * kDt);  // at x = -9
  EXPECT_NEAR(h.spread, 2, 1e-12);
  EXPECT_NEAR(h.speed, 1 / kDt, 1e-12);
  EXPECT_NEAR(h.polarisation, 1, 1e-12);
  EXPECT_EQ(h.collecting, 0);
  EXPECT_NEAR(h.side, 1, 1e-12);
  EXPECT_TRUE(std::isnan(h.side_period));
  EXPECT_TRUE(std::isnan(herding(drive(2, [](int) { return 1.0; }), {.target = Array3d(0, 50, 0)}).time));
}

TEST(Herding, CollectsWhileASheepIsFarOut) {
  const double limit = 2 * std::cbrt(16);  // 2 · 4^(2/3)
  const auto still = [](int) { return 1.0; };
  EXPECT_EQ(herding(drive(1.01 * limit, still)).collecting, 1);
  EXPECT_EQ(herding(drive(0.99 * limit, still)).collecting, 0);
  EXPECT_TRUE(std::isnan(herding(drive(1.01 * limit, still)).side));  // it never drives
}

// A sine of amplitude 4 and period 40 frames: rms 4 / sqrt(2), and one that repeats itself upside down after half a period.
TEST(Herding, MeasuresSideToSideMotion) {
  const auto sine = [](int k) { return 4 * std::sin(2 * std::numbers::pi * (k + 0.5) / 40); };
  const Herding h = herding(drive(2, sine), {.target = Array3d(1000, 3, 0)});
  EXPECT_NEAR(h.side, 4 / std::sqrt(2), 0.01);
  EXPECT_NEAR(h.side_period, 40 * kDt, 1);
  EXPECT_NEAR(h.side_least, -1, 0.02);
  EXPECT_EQ(herding(drive(2, sine), {.target = Array3d(-1000, 3, 0)}).side, h.side);  // the same line, the other way
}

TEST(Herding, RefusesLengthsThatAreNone) {
  const Tracks tracks = drive(2, [](int) { return 0.0; });
  EXPECT_THROW(herding(tracks, {.home = 0}), std::invalid_argument);
  EXPECT_THROW(herding(tracks, {.repulsion = -1}), std::invalid_argument);
}

TEST(Herding, NothingToMeasure) {
  const Herding h = herding(drive(2, [](int) { return 0.0; }), {.sheep = 7});
  EXPECT_TRUE(std::isnan(h.time) && std::isnan(h.collecting) && std::isnan(h.side));
}

}  // namespace
}  // namespace swarmfit
