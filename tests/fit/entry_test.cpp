// SPDX-License-Identifier: MIT
#include "fit/entry.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "libeval/localisation.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

constexpr double kDt = 0.02;

// Tracks of some frames at places that are a function of time [s] and track.
Tracks filmed(std::uint32_t tracks, std::int64_t frames, const std::function<Array3d(double, std::uint32_t)>& place) {
  TrackColumns c;
  for (std::int64_t f = 0; f < frames; ++f)
    for (std::uint32_t t = 0; t < tracks; ++t) c.track.push_back(t), c.frame.push_back(f);
  for (std::uint32_t t = 0; t < tracks; ++t) c.names.push_back(std::to_string(t));
  c.pos = Rows(static_cast<Index>(c.track.size()), 3);
  for (std::size_t i = 0; i < c.track.size(); ++i)
    c.pos.row(static_cast<Index>(i)) = place(kDt * static_cast<double>(c.frame[i]), c.track[i]).transpose();
  TrackMeta meta;
  meta.dt = kDt;
  return Tracks(std::move(c), meta);
}

// Mean square of (velocity - truth) / its error over all visits, along x.
double mean_square_z(const std::vector<Presence::Visit>& visits, double truth) {
  double sum = 0;
  for (const auto& v : visits) sum += std::pow((v.vel[0] - truth) / v.vel_error[0], 2);
  return sum / static_cast<double>(visits.size());
}

TEST(Entry, AParabolaIsFollowedExactly) {
  const auto visits =
      recorded_visits(filmed(3, 8, [](double t, std::uint32_t k) { return Array3d(k + 3 * t - 40 * t * t, 7 * k * t, 5 * t * t); }));
  ASSERT_EQ(visits.size(), 3u);
  for (const auto& v : visits) {
    EXPECT_NEAR(v.vel[0], 3, 1e-10);
    EXPECT_NEAR(v.vel[1], 7.0 * v.id, 1e-10);
    EXPECT_NEAR(v.vel[2], 0, 1e-10);
    EXPECT_LT(v.vel_error.maxCoeff(), 1e-10);
    EXPECT_EQ(v.pos[0], v.id);
  }
}

// Straight paths with white error: the line, whose derivative has the variance sigma²/10 per frame². 500 visits: the mean square of z is
// within 1 +- 2.58 sqrt(2/500) = 0.16 (99 %), and that of the error itself closer.
TEST(Entry, StraightPathsAreFittedByALine) {
  const double sigma = 0.3;
  const Tracks seen = with_error(filmed(500, 6, [](double t, std::uint32_t) { return Array3d(3 * t, 0, 0); }), Array3d::Constant(sigma), 5);
  const auto visits = recorded_visits(seen);
  EXPECT_NEAR(visits.front().vel_error[0], sigma / std::sqrt(10) / kDt, 0.06 * sigma / std::sqrt(10) / kDt);
  EXPECT_NEAR(mean_square_z(visits, 3), 1, 0.16);
}

// The same on paths that bend by more than the error: the parabola, whose derivative has 1.243 sigma² (54² + 13² + 40² + 27² + 26² over
// 70², Savitzky and Golay 1964 for the end of five points).
TEST(Entry, BentPathsAreFittedByAParabola) {
  const double sigma = 0.3, bend = 6000;
  const auto path = [&](double t, std::uint32_t k) { return Array3d(3 * t + (k % 2 ? bend : -bend) * t * t / 2, 0, 0); };
  const auto visits = recorded_visits(with_error(filmed(500, 6, path), Array3d::Constant(sigma), 5));
  const double error = std::sqrt((54.0 * 54 + 13 * 13 + 40 * 40 + 27 * 27 + 26 * 26) / 4900) * sigma / kDt;
  EXPECT_NEAR(visits.front().vel_error[0], error, 0.06 * error);
  EXPECT_NEAR(mean_square_z(visits, 3), 1, 0.16);
}

// Bent by less than the error: the line, and its error includes the lag of two frames.
TEST(Entry, ALineThatLagsSaysSo) {
  const double sigma = 0.3, bend = 0.3 * sigma / (kDt * kDt);
  const auto path = [&](double t, std::uint32_t k) { return Array3d(3 * t + (k % 2 ? bend : -bend) * t * t / 2, 0, 0); };
  const auto visits = recorded_visits(with_error(filmed(2000, 6, path), Array3d::Constant(sigma), 5));
  const double error = std::sqrt(sigma * sigma / 10 + 4 * bend * bend * std::pow(kDt, 4)) / kDt;
  EXPECT_NEAR(visits.front().vel_error[0], error, 0.1 * error);
  EXPECT_NEAR(mean_square_z(visits, 3), 1, 0.2);
}

TEST(Entry, RecordedVelocitiesAreTakenAsTheyAre) {
  TrackColumns c;
  c.names = {"a"};
  for (std::int64_t f = 0; f < 6; ++f) c.track.push_back(0), c.frame.push_back(f);
  c.pos = Rows::Random(6, 3);
  c.vel = Rows::Constant(6, 3, 4.0);
  TrackMeta meta;
  meta.dt = kDt;
  const auto visits = recorded_visits(Tracks(std::move(c), meta));
  EXPECT_EQ(visits.front().vel[1], 4);
  EXPECT_EQ(visits.front().vel_error.maxCoeff(), 0);
}

TEST(Entry, TwoFramesGiveADifferenceAndOneGivesNothing) {
  EXPECT_NEAR(recorded_visits(filmed(1, 2, [](double t, std::uint32_t) { return Array3d(3 * t, 0, 0); })).front().vel[0], 3, 1e-12);
  const auto one = recorded_visits(filmed(1, 1, [](double, std::uint32_t) { return Array3d(1, 2, 3); })).front();
  EXPECT_EQ(one.vel.abs().maxCoeff(), 0);
  EXPECT_EQ(one.vel_error.maxCoeff(), 0);
}

}  // namespace
}  // namespace swarmfit
