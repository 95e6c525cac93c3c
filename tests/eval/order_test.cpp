// SPDX-License-Identifier: MIT
#include "libeval/order.h"

#include <gmock/gmock.h>

#include <numbers>

#include "tests/eval/build.h"

namespace swarmfit {
namespace {

using test::Row;
using test::tracks_of;
using testing::Each;
using testing::ElementsAre;
using testing::IsNan;
constexpr double kPi = std::numbers::pi;

testing::Matcher<double> is(double x) { return testing::DoubleNear(x, 1e-12); }

TEST(Order, AlignedGroup) {
  const auto rows = test::rows_of(5, 3, 0.1, [](std::uint32_t i, double t) {
    return std::array{1.0 * i * i + 2 * t * (1 + i), -1.0 * i, 3.0};
  });
  const OrderSeries o = order_parameters(tracks_of(rows));
  EXPECT_THAT(o.frame, ElementsAre(0, 1, 2));
  EXPECT_THAT(o.polarisation, ElementsAre(is(1), is(1), IsNan()));  // no velocity in the last frame
}

TEST(Order, IdealMillInAnyPlane) {
  // Small steps, so that the chord is the tangent; eight individuals on a circle, in the plane of (1,0,0) and (0,1,1)/sqrt 2
  for (const double sense : {1.0, -1.0}) {
    const auto rows = test::rows_of(8, 2, 1e-6, [&](std::uint32_t i, double t) {
      const double phi = 2 * kPi * i / 8 + sense * t;
      return std::array{5 + 3 * std::cos(phi), 3 * std::sin(phi) / std::numbers::sqrt2, 1 + 3 * std::sin(phi) / std::numbers::sqrt2};
    });
    const OrderSeries o = order_parameters(tracks_of(rows, {.dt = 1e-6}));
    EXPECT_NEAR(o.milling[0], 1, 1e-9);
    EXPECT_NEAR(o.polarisation[0], 0, 1e-9);
    EXPECT_THAT(o.extent, Each(is(3)));
  }
}

TEST(Order, OutwardMotionDoesNotMill) {
  const std::vector<Row> rows = {{0, 0, {1, 0, 0}}, {1, 0, {-1, 0, 0}}, {0, 1, {2, 0, 0}}, {1, 1, {-2, 0, 0}}};
  const OrderSeries o = order_parameters(tracks_of(rows, {.dims = 2}));
  EXPECT_THAT(o.milling, ElementsAre(is(0), IsNan()));
  EXPECT_THAT(o.polarisation, ElementsAre(is(0), IsNan()));
  EXPECT_THAT(o.extent, ElementsAre(1, 2));
}

// E|sum of N unit vectors|/N -> sqrt(8/(3 pi N)) in space and sqrt(pi/(4 N)) in the plane. |sum|/N scatters by 42 % and 52 % of its mean,
// so the mean over 4 000 frames by less than 0.85 %; the tolerance is 3.5 of that.
TEST(Order, IsotropicHeadings) {
  constexpr std::uint32_t n = 100;
  constexpr std::int64_t frames = 4000;
  for (const int dims : {2, 3}) {
    std::vector<Row> rows;
    for (std::int64_t k = 0; k < frames; ++k)
      for (std::uint32_t i = 0; i < n; ++i) {
        // a fresh pair of frames per sample, with a gap between pairs
        std::array<double, 3> p{}, step{};
        for (std::uint32_t a = 0; a < static_cast<std::uint32_t>(dims); ++a) {
          p[a] = test::normal(1, static_cast<std::uint64_t>(k), i, a);
          step[a] = 1e-3 * test::normal(2, static_cast<std::uint64_t>(k), i, a);
        }
        rows.push_back({i, 3 * k, p});
        rows.push_back({i, 3 * k + 1, {p[0] + step[0], p[1] + step[1], p[2] + step[2]}});
      }
    const OrderSeries o = order_parameters(tracks_of(rows, {.dims = dims}));
    const double expected = dims == 3 ? std::sqrt(8 / (3 * kPi * n)) : std::sqrt(kPi / (4 * n));
    EXPECT_NEAR(mean_defined(o.polarisation), expected, 0.03 * expected) << dims;
    EXPECT_NEAR(mean_defined(o.extent), std::sqrt(dims * (1 - 1.0 / n)), 0.005);
  }
}

TEST(Order, OneAloneHasNoOrder) {
  const OrderSeries o = order_parameters(tracks_of({{0, 0, {0, 0, 0}}, {0, 1, {1, 0, 0}}}));
  EXPECT_THAT(o.polarisation, Each(IsNan()));
  EXPECT_THAT(o.milling, Each(IsNan()));
  EXPECT_THAT(o.extent, Each(IsNan()));
}

TEST(Order, WhoStandsStillHasNoHeading) {
  const std::vector<Row> rows = {{0, 0, {0, 0, 0}}, {1, 0, {0, 5, 0}}, {2, 0, {5, 0, 0}},
                                 {0, 1, {1, 0, 0}}, {1, 1, {0, 6, 0}}, {2, 1, {5, 0, 0}}};
  EXPECT_THAT(order_parameters(tracks_of(rows)).polarisation[0], is(std::sqrt(2.0) / 2));
}

TEST(Order, MeanOfWhatIsDefined) {
  EXPECT_EQ(mean_defined({1, std::nan(""), 3}), 2);
  EXPECT_TRUE(std::isnan(mean_defined({std::nan("")})));
  EXPECT_TRUE(std::isnan(mean_defined({})));
  EXPECT_TRUE(order_parameters(Tracks()).frame.empty());
}

}  // namespace
}  // namespace swarmfit
