// SPDX-License-Identifier: MIT
#include "libeval/group/pictures.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "tests/eval/build.h"

namespace swarmfit {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Two in the plane at these places, frame by frame.
template <class A, class B>
Tracks two(int frames, A a, B b) {
  TrackColumns c;
  c.names = {"a", "b"};
  c.pos = Rows::Zero(2 * frames, 3);
  for (int f = 0; f < frames; ++f) {
    for (std::uint32_t k = 0; k < 2; ++k) c.frame.push_back(f), c.track.push_back(k);
    const auto [ax, ay] = a(f);
    const auto [bx, by] = b(f);
    c.pos.row(2 * f) << ax, ay, 0;
    c.pos.row(2 * f + 1) << bx, by, 0;
  }
  TrackMeta meta;
  meta.dims = 2;
  meta.dt = 0.1;
  return {std::move(c), meta};
}

using P = std::pair<double, double>;

PictureGrid grid(double reach) {
  PictureGrid g;
  g.dims = 2, g.dt = 0.1, g.reach = reach, g.width = 1, g.times = 1, g.stride = 100;
  g.even.assign(24, 0.5);
  g.half = 20;
  return g;
}

std::size_t cell(int across, int along) { return static_cast<std::size_t>((along + 7) * 15 + across + 7); }

// Side by side towards +x, b one unit to the left of a: a sees b left, b sees a right, and neither turns nor accelerates.
TEST(Pictures, SideBySide) {
  const Tracks t = two(
      20, [](int f) { return P(0.5 * f, 0); }, [](int f) { return P(0.5 * f, 1); });
  const Pictures p = pictures(t, grid(7.5));
  EXPECT_NEAR(p.density[cell(-1, 0)], 112.5, 1e-9) << "half of all in one of 225 squares";
  EXPECT_NEAR(p.density[cell(1, 0)], 112.5, 1e-9);
  EXPECT_EQ(p.density[cell(0, 1)], 0);
  EXPECT_NEAR(p.turning[cell(1, 0)], 0, 1e-9);
  EXPECT_NEAR(p.acceleration[cell(-1, 0)], 0, 1e-9);
  EXPECT_TRUE(std::isnan(p.turning[cell(0, 1)]));
  EXPECT_NEAR(p.pairs[1], 2, 1e-12) << "all pairs, over a half";
  EXPECT_NEAR(p.headings[1], 1, 1e-12);
  EXPECT_NEAR(p.polarisation[0], 1, 1e-12);
  EXPECT_NEAR(p.spread[0], 0.5, 1e-12);
}

// a circles b clockwise with angular velocity w: b is to the right, and a turns to the right as fast as it circles. Turning is from second
// differences over the mean velocity: 2 (1 - cos w dt)/dt² R over R sin(w dt)/dt.
TEST(Pictures, CirclingTurnsTowardsTheCentre) {
  const double w = 0.8, radius = 2, dt = 0.1;
  const Tracks t = two(
      60, [&](int f) { return P(radius * std::cos(w * dt * f), -radius * std::sin(w * dt * f)); }, [](int) { return P(0, 0); });
  const Pictures p = pictures(t, grid(7.5));
  EXPECT_NEAR(p.turning[cell(2, 0)], 2 * (1 - std::cos(w * dt)) / (dt * std::sin(w * dt)), 1e-9);
  EXPECT_NEAR(p.turning[cell(2, 0)], w, 1e-2);
  EXPECT_NEAR(p.acceleration[cell(2, 0)], 0, 1e-9);
}

// a falls towards b, which stands still: it accelerates with b ahead.
TEST(Pictures, AcceleratesTowardsWhatIsAhead) {
  const Tracks t = two(
      6, [](int f) { return P(1.5 * 0.01 * f * f, 0); }, [](int) { return P(5, 0); });
  const Pictures p = pictures(t, grid(7.5));
  EXPECT_NEAR(p.acceleration[cell(0, 5)], 3, 1e-9);  // second differences of 1.5 t²
  EXPECT_NEAR(p.turning[cell(0, 5)], 0, 1e-9);
}

TEST(Pictures, SpaceIsSharedByTheSquares) {
  const Tracks t = two(
      4, [](int) { return P(-19.9, -19.9); }, [](int f) { return P(19.9, 19.9 - 0.001 * f); });
  const Pictures p = pictures(t, grid(7.5));
  EXPECT_NEAR(p.space.front(), kSpaceSide * kSpaceSide / 2.0, 1e-9);
  EXPECT_NEAR(p.space.back(), kSpaceSide * kSpaceSide / 2.0, 1e-9);
}

TEST(PictureGrid, IsSetByTheRecording) {
  const Tracks t = two(
      200, [](int f) { return P(0.5 * f, 0); }, [](int f) { return P(0.5 * f, 1); });
  const PictureGrid g = picture_grid(t);
  EXPECT_NEAR(g.reach, 4, 1e-12);
  EXPECT_NEAR(g.width, 2 * 0.5 / 24, 1e-12);
  EXPECT_EQ(g.stride, 3);
  EXPECT_EQ(g.times, 67u);
  EXPECT_NEAR(g.x, 0.25 * 199, 1e-9);
  const Pictures p = pictures(t, g);
  EXPECT_EQ(p.msd.size(), g.plan.msd_lags.size());
  EXPECT_EQ(p.vacf.size(), g.plan.vacf_lags.size());
  EXPECT_EQ(p.polarisation.size(), g.times);
}

TEST(Pictures, OfNobodyAreEmpty) { EXPECT_TRUE(pictures(Tracks(), grid(1)).density.empty()); }

TEST(PictureSpread, MeansOfWhatIsFinite) {
  Pictures a, b, none;
  a.density = b.density = {1};
  a.msd = {1, kNaN, kNaN};
  b.msd = {3, 5, kNaN};
  const PictureSpread s = picture_spread({a, none, b});
  EXPECT_THAT(s.mean.msd, testing::ElementsAre(2, 5, testing::IsNan()));
  EXPECT_THAT(s.sd.msd, testing::ElementsAre(std::sqrt(2), testing::IsNan(), testing::IsNan()));
  EXPECT_TRUE(picture_spread({}).mean.density.empty());
}

}  // namespace
}  // namespace swarmfit
