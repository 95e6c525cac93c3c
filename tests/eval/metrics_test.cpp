// SPDX-License-Identifier: MIT
#include "libeval/metrics.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libtrack/error.h"
#include "tests/eval/build.h"

namespace swarmfit {
namespace {

using test::Row;
using test::rows_of;
using test::Settings;
using test::tracks_of;
using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;
constexpr double kPi = std::numbers::pi;

testing::Matcher<double> close_to(double x, double relative = 1e-12) { return testing::DoubleNear(x, relative * std::abs(x)); }

// On a circle of radius R with angle theta per frame, chords have length c = 2 R sin(theta/2) and turn by theta each step.
TEST(Metrics, CircularMotionHasClosedForms) {
  const double radius = 3, theta = 0.2, dt = 0.05;
  const auto rows = rows_of(1, 20, dt, [&](std::uint32_t, double t) {
    const double phi = theta * t / dt;
    return std::array{radius * std::cos(phi), radius * std::sin(phi), 7.0};
  });
  const auto s = metric_samples(tracks_of(rows, {.dt = dt})).values;
  const double v = 2 * radius * std::sin(theta / 2) / dt;
  EXPECT_THAT(s[kSpeed], AllOf(SizeIs(19), Each(close_to(v))));
  EXPECT_THAT(s[kAcceleration], AllOf(SizeIs(18), Each(close_to(2 * v * std::sin(theta / 2) / dt))));
  EXPECT_THAT(s[kAngularVelocity], AllOf(SizeIs(18), Each(close_to(theta / dt))));
  EXPECT_THAT(s[kJerk], AllOf(SizeIs(17), Each(close_to(4 * v * std::pow(std::sin(theta / 2), 2) / (dt * dt), 1e-11))));
  EXPECT_THAT(s[kAngularAcceleration], AllOf(SizeIs(17), Each(testing::DoubleNear(0, 1e-10))));
  EXPECT_THAT(s[kDistance], IsEmpty());
  EXPECT_THAT(s[kVelocityDifference], IsEmpty());
}

// The same polygon tilted out of the plane: the metrics do not know the axes.
TEST(Metrics, DoNotDependOnTheFrameOfReference) {
  const auto flat = test::trapped(1, 6, 50, {.dt = 0.01});
  auto turned = flat;
  for (Row& row : turned) {
    const auto [x, y, z] = row.p;  // rotation by the unit quaternion (1, 1, 1, 1)/2, then a shift
    row.p = {z + 10, x - 20, y + 5};
  }
  const auto a = metric_samples(tracks_of(flat, {.dt = 0.01})).values, b = metric_samples(tracks_of(turned, {.dt = 0.01})).values;
  for (std::size_t m = 0; m < kMetrics; ++m) {
    ASSERT_EQ(a[m].size(), b[m].size());
    for (std::size_t i = 0; i < a[m].size(); ++i) EXPECT_NEAR(a[m][i], b[m][i], 1e-8 * (1 + std::abs(a[m][i]))) << kMetricInfo[m].key;
  }
}

TEST(Metrics, StraightWalkersDoNotTurn) {
  // Steps that are exact in binary, so that nothing is rounded.
  const auto rows = rows_of(2, 10, 0.5, [](std::uint32_t i, double t) { return std::array{t * 0.75, t * (i ? -0.25 : 2.0), t * 1.5}; });
  const auto s = metric_samples(tracks_of(rows, {.dt = 0.5}));
  EXPECT_THAT(s.values[kAngularVelocity], AllOf(SizeIs(16), Each(0.0)));
  EXPECT_THAT(s.values[kAcceleration], Each(0.0));
  EXPECT_THAT(s.values[kAngularAcceleration], Each(0.0));
  EXPECT_THAT(s.values[kJerk], Each(0.0));
}

TEST(Metrics, AngleIsExactNearZeroAndPi) {
  const double small = 1e-9;  // arccos would give 0
  const auto s =
      metric_samples(tracks_of({{0, 0, {0, 0, 0}}, {0, 1, {1, 0, 0}}, {0, 2, {2, small, 0}}, {0, 3, {1, 2 * small, 0}}}, {.dt = 1}));
  EXPECT_THAT(s.values[kAngularVelocity], ElementsAre(close_to(small), close_to(kPi - 2 * small, 1e-15)));
  EXPECT_THAT(s.values[kAngularAcceleration], ElementsAre(close_to(kPi - 3 * small, 1e-15)));
}

TEST(Metrics, AngularAccelerationIsSigned) {
  // turns by 90°, then not at all
  const auto s = metric_samples(tracks_of({{0, 0, {0, 0, 0}}, {0, 1, {1, 0, 0}}, {0, 2, {1, 1, 0}}, {0, 3, {1, 2, 0}}}, {.dt = 0.5}));
  EXPECT_THAT(s.values[kAngularAcceleration], ElementsAre(close_to(-kPi / 2 / 0.25)));
}

TEST(Metrics, PairAtFixedDistance) {
  // two individuals side by side, one of them ahead twice as fast for a step
  const std::vector<Row> rows = {{0, 0, {0, 0, 0}}, {1, 0, {0, 4, 0}}, {0, 1, {1, 0, 0}}, {1, 1, {3, 4, 0}}};
  const auto s = metric_samples(tracks_of(rows, {.dt = 0.1})).values;
  EXPECT_THAT(s[kDistance], ElementsAre(4, 4, close_to(std::sqrt(20.0)), close_to(std::sqrt(20.0))));
  EXPECT_THAT(s[kVelocityDifference], ElementsAre(close_to(20.0 / 4), close_to(20.0 / 4)));  // speeds 10 and 30, distance 4
}

TEST(Metrics, VelocityDifferenceIsOfSpeedsNotOfVelocities) {
  const std::vector<Row> rows = {{0, 0, {0, 0, 0}}, {1, 0, {5, 0, 0}}, {0, 1, {-1, 0, 0}}, {1, 1, {6, 0, 0}}};
  EXPECT_THAT(metric_samples(tracks_of(rows)).values[kVelocityDifference], ElementsAre(0.0, 0.0));  // opposite headings, equal speeds
}

TEST(Metrics, NothingIsDifferencedAcrossAGap) {
  std::vector<Row> rows;
  for (const int k : {0, 1, 2, 3, 5, 6, 7}) rows.push_back({0, k, {k < 4 ? 1.0 * k : 1000.0 + k, 0, 0}});
  const auto s = metric_samples(tracks_of(rows, {.dt = 1})).values;
  EXPECT_THAT(s[kSpeed], AllOf(SizeIs(5), Each(1.0)));
  EXPECT_THAT(s[kAcceleration], AllOf(SizeIs(3), Each(0.0)));
  EXPECT_THAT(s[kAngularVelocity], SizeIs(3));
  EXPECT_THAT(s[kJerk], SizeIs(1));
  EXPECT_THAT(s[kAngularAcceleration], SizeIs(1));
}

TEST(Metrics, NothingIsDifferencedAcrossTakes) {
  std::vector<Row> rows;
  for (int k = 0; k < 6; ++k) rows.push_back({0, k, {k < 3 ? 1.0 * k : 1000.0 + k, 0, 0}});
  const auto s = metric_samples(tracks_of(rows, {.dt = 1, .episodes = {3}})).values;
  EXPECT_THAT(s[kSpeed], AllOf(SizeIs(4), Each(1.0)));
  EXPECT_THAT(s[kJerk], IsEmpty());
}

TEST(Metrics, NeighbourWithoutNextFrameGivesDistanceButNoVelocityDifference) {
  const std::vector<Row> rows = {{0, 0, {0, 0, 0}}, {1, 0, {1, 0, 0}}, {0, 1, {1, 0, 0}}};
  const auto s = metric_samples(tracks_of(rows));
  EXPECT_THAT(s.values[kDistance], SizeIs(2));
  EXPECT_THAT(s.values[kVelocityDifference], IsEmpty());
  EXPECT_EQ(s.undefined[kVelocityDifference], 0);  // the neighbour's frame is missing; that is no undefined value
  EXPECT_EQ(s.undefined[kDistance], 1);            // alone in frame 1
}

TEST(Metrics, UndefinedValuesAreCountedAndNotSampled) {
  // 0 stands still for a step; 1 moves on; both in the same place at frame 0
  const std::vector<Row> rows = {{0, 0, {0, 0, 0}}, {1, 0, {0, 0, 0}}, {0, 1, {0, 0, 0}}, {1, 1, {1, 0, 0}},
                                 {0, 2, {1, 0, 0}}, {1, 2, {2, 0, 0}}, {0, 3, {2, 0, 0}}, {1, 3, {3, 0, 0}}};
  const auto s = metric_samples(tracks_of(rows));
  EXPECT_THAT(s.values[kAngularVelocity], SizeIs(3));
  EXPECT_EQ(s.undefined[kAngularVelocity], 1);
  EXPECT_THAT(s.values[kAngularAcceleration], SizeIs(1));
  EXPECT_EQ(s.undefined[kAngularAcceleration], 1);
  EXPECT_THAT(s.values[kVelocityDifference], SizeIs(4));
  EXPECT_EQ(s.undefined[kVelocityDifference], 2);
  EXPECT_THAT(s.values[kDistance], SizeIs(8));  // a distance of 0 is a distance
}

TEST(Metrics, VelocityDifferenceNeedsADistance) {
  const auto eta_at = [](double d) {
    const std::vector<Row> rows = {{0, 0, {0, 0, 0}}, {1, 0, {d, 0, 0}}, {0, 1, {1, 0, 0}}, {1, 1, {3, 0, 0}}};
    return metric_samples(tracks_of(rows)).values[kVelocityDifference];
  };
  EXPECT_THAT(eta_at(1e-8), SizeIs(2));
  EXPECT_THAT(eta_at(1e-10), IsEmpty());
}

TEST(Metrics, VerySlowIsNotTurning) {
  std::vector<Row> rows;
  for (int k = 0; k < 4; ++k) {
    rows.push_back({0, k, {1.0 * k, 0, 0}});
    rows.push_back({1, k, {1.0 * k, 5, 0}});
    rows.push_back({2, k, {0, k % 2 ? 1e-10 : 0, 0}});  // below 1e-9 of the median speed: no direction
  }
  const auto s = metric_samples(tracks_of(rows, {.dt = 1}));
  EXPECT_THAT(s.values[kAngularVelocity], AllOf(SizeIs(4), Each(0.0)));
  EXPECT_EQ(s.undefined[kAngularVelocity], 2);
}

TEST(Metrics, EverybodyFrozen) {
  const auto s = metric_samples(tracks_of(rows_of(2, 5, 1, [](std::uint32_t i, double) { return std::array{1.0 * i, 0.0, 0.0}; })));
  EXPECT_THAT(s.values[kSpeed], Each(0.0));
  EXPECT_THAT(s.values[kAngularVelocity], IsEmpty());
  EXPECT_THAT(s.values[kVelocityDifference], AllOf(SizeIs(8), Each(0.0)));
}

TEST(Metrics, RecordedVelocityReplacesTheDifference) {
  const std::vector<Row> rows = {{0, 0, {0, 0, 0}, {3, 4, 0}}, {0, 1, {0, 0, 0}, {4, -3, 0}}, {0, 2, {0, 0, 0}, {4, -3, 12}}};
  const auto s = metric_samples(tracks_of(rows, {.dt = 0.5, .velocity = true}), {VelocitySource::recorded}).values;
  EXPECT_THAT(s[kSpeed], ElementsAre(5, 5, 13));
  EXPECT_THAT(s[kAcceleration], ElementsAre(close_to(std::sqrt(50.0) / 0.5), close_to(12 / 0.5)));
  EXPECT_THAT(s[kAngularVelocity], ElementsAre(close_to(kPi / 2 / 0.5), close_to(std::atan2(12.0, 5.0) / 0.5)));
  EXPECT_THAT(s[kJerk], ElementsAre(close_to(std::hypot(1, 7, 12) / 0.25)));
}

TEST(Metrics, RecordedVelocityThatIsMissing) {
  const std::vector<Row> rows = {{0, 0, {0, 0, 0}, {std::nan(""), 0, 0}}, {0, 1, {0, 0, 0}, {1, 0, 0}}};
  const auto s = metric_samples(tracks_of(rows, {.velocity = true}), {VelocitySource::recorded});
  EXPECT_THAT(s.values[kSpeed], ElementsAre(1));
  EXPECT_EQ(s.undefined[kSpeed], 1);
  EXPECT_THAT(s.values[kAcceleration], IsEmpty());
  EXPECT_THROW(metric_samples(tracks_of(rows), {VelocitySource::recorded}), InputError);
}

TEST(Metrics, EmptyRecording) {
  const auto s = metric_samples(Tracks());
  for (const auto& values : s.values) EXPECT_THAT(values, IsEmpty());
  EXPECT_THAT(metric_samples(tracks_of({})).values[kSpeed], IsEmpty());
}

TEST(Metrics, ValuesThatOverflowAreUndefined) {
  const auto s = metric_samples(tracks_of({{0, 0, {-1e200, 0, 0}}, {1, 0, {1e200, 0, 0}}, {0, 1, {1e200, 0, 0}}, {1, 1, {0, 0, 0}}}));
  EXPECT_THAT(s.values[kSpeed], IsEmpty());
  EXPECT_EQ(s.undefined[kSpeed], 2);
  EXPECT_THAT(s.values[kDistance], IsEmpty());
  EXPECT_THAT(s.values[kVelocityDifference], IsEmpty());
}

TEST(Metrics, NaturalScales) {
  const std::vector<Row> rows = {{0, 0, {0, 0, 0}}, {1, 0, {0, 4, 0}}, {0, 1, {2, 0, 0}}, {1, 1, {2, 4, 0}}};
  EXPECT_THAT(metric_samples(tracks_of(rows, {.dt = 0.5})).natural, ElementsAre(4, 8, 2, 4, 16, 4, 1));
}

// Row by row, straight from the definition: the oracle of the one-pass code.
TEST(Metrics, AgreeWithTheDefinitionTrackByTrack) {
  const double dt = 0.02;
  auto rows = test::trapped(5, 12, 40, {.dt = dt});
  std::erase_if(rows, [](const Row& r) { return test::uniform(9, static_cast<std::uint64_t>(r.frame), r.track) < 0.1; });  // holes
  const Tracks tracks = tracks_of(rows, {.dt = dt});
  const auto got = metric_samples(tracks).values;

  using V = Eigen::Vector3d;
  PerColumn<std::vector<double>> want;
  const auto row_at = [&](std::uint32_t id, std::int64_t k) -> const Row* {
    for (const Row& r : rows)
      if (r.track == id && r.frame == k) return &r;
    return nullptr;
  };
  const auto vec = [](const Row* r) { return V(r->p[0], r->p[1], r->p[2]); };
  for (const Row& r : rows) {
    std::vector<V> v;  // as far as the next frames reach, three at most
    for (std::int64_t k = 0; k < 3; ++k) {
      const Row *from = row_at(r.track, r.frame + k), *to = row_at(r.track, r.frame + k + 1);
      if (!from || !to) break;
      v.push_back((vec(to) - vec(from)) / dt);
    }
    const bool two = !v.empty(), three = v.size() >= 2, four = v.size() >= 3;
    const auto angle = [](V a, V b) { return std::acos(std::clamp(a.dot(b) / (a.norm() * b.norm()), -1.0, 1.0)); };
    if (two) want[kSpeed].push_back(v[0].norm());
    if (three) want[kAcceleration].push_back((v[1] - v[0]).norm() / dt);
    if (three) want[kAngularVelocity].push_back(angle(v[0], v[1]) / dt);
    if (four) want[kAngularAcceleration].push_back((angle(v[1], v[2]) - angle(v[0], v[1])) / (dt * dt));
    if (four) want[kJerk].push_back((v[2] - 2 * v[1] + v[0]).norm() / (dt * dt));
    const Row* nearest = nullptr;
    for (const Row& other : rows)
      if (other.frame == r.frame && other.track != r.track &&
          (!nearest || (vec(&other) - vec(&r)).norm() < (vec(nearest) - vec(&r)).norm()))
        nearest = &other;
    const double d = (vec(nearest) - vec(&r)).norm();
    want[kDistance].push_back(d);
    const Row* nearest_next = row_at(nearest->track, r.frame + 1);
    if (two && nearest_next)
      want[kVelocityDifference].push_back(std::abs((vec(nearest_next) - vec(nearest)).norm() / dt - v[0].norm()) / d);
  }
  for (std::size_t m = 0; m < kMetrics; ++m) {
    auto a = got[m], b = want[m];
    ASSERT_EQ(a.size(), b.size()) << kMetricInfo[m].key;
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-6 * (1 + std::abs(b[i]))) << kMetricInfo[m].key;
  }
}

}  // namespace
}  // namespace swarmfit
