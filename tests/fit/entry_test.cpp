// SPDX-License-Identifier: MIT
#include "fit/experiment/entry.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <map>

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

const Array3d kNone = Array3d::Zero();

// Mean square of (velocity - truth) / its error over all visits, along x.
double mean_square_z(const std::vector<Presence::Visit>& visits, const std::function<double(std::uint32_t)>& truth) {
  double sum = 0;
  for (const auto& v : visits) sum += std::pow((v.vel[0] - truth(v.id)) / v.vel_error[0], 2);
  return sum / static_cast<double>(visits.size());
}

// Spread so far that what is known of all says next to nothing of one.
double speed_of(std::uint32_t track) { return 200 * (static_cast<double>(track % 11) - 5); }

TEST(Entry, AParabolaIsFollowedExactly) {
  const auto visits = recorded_visits(
      filmed(3, 30, [](double t, std::uint32_t k) { return Array3d(k + 3 * t - 40 * t * t, 7 * k * t, 5 * t * t); }), kNone);
  ASSERT_EQ(visits.size(), 3u);
  for (const auto& v : visits) {
    EXPECT_NEAR(v.vel[0], 3, 1e-9);
    EXPECT_NEAR(v.vel[1], 7.0 * v.id, 1e-9);
    EXPECT_NEAR(v.vel[2], 0, 1e-9);
    EXPECT_LT(v.vel_error.maxCoeff(), 1e-6);
    EXPECT_EQ(v.pos[0], v.id);
  }
}

// Straight paths with white error: the longest line, whose derivative has the variance sigma²/60 per frame². 500 visits: the mean square of
// z is within 1 +- 2.58 sqrt(2/500) = 0.16 (99 %), and that of the error itself closer.
TEST(Entry, StraightPathsAreFittedByALine) {
  const double sigma = 0.3;
  const Tracks seen =
      with_error(filmed(500, 20, [](double t, std::uint32_t k) { return Array3d(speed_of(k) * t, 0, 0); }), Array3d::Constant(sigma), 5);
  const auto visits = recorded_visits(seen, Array3d::Constant(sigma));
  EXPECT_NEAR(visits.front().vel_error[0], sigma / std::sqrt(60) / kDt, 0.06 * sigma / std::sqrt(60) / kDt);
  EXPECT_NEAR(mean_square_z(visits, speed_of), 1, 0.16);
}

// The same on paths that bend by more than the error: the longest parabola. Its derivative at the end of n frames has the variance
// 1 / t2 + 4 ((n-1)/2)² / q2 per frame², for nine frames 1/60 + 64/308 (Savitzky and Golay 1964).
TEST(Entry, BentPathsAreFittedByAParabola) {
  const double sigma = 0.3, bend = 6000;
  const auto path = [&](double t, std::uint32_t k) { return Array3d(speed_of(k) * t + (k % 2 ? bend : -bend) * t * t / 2, 0, 0); };
  const auto visits = recorded_visits(with_error(filmed(500, 20, path), Array3d::Constant(sigma), 5), Array3d::Constant(sigma));
  const double error = std::sqrt(1 / 60.0 + 64 / 308.0) * sigma / kDt;
  EXPECT_NEAR(visits.front().vel_error[0], error, 0.06 * error);
  EXPECT_NEAR(mean_square_z(visits, speed_of), 1, 0.16);
}

// Bent by a tenth of the error, on the root mean square: a line through five frames has the least error, which includes its lag of two
// frames: sigma²/10 and (0.2 sigma)². From before and from after it lags in opposite directions, so the lag counts twice.
TEST(Entry, ALineThatLagsSaysSo) {
  const double sigma = 0.3, bend = 0.1 * sigma / (kDt * kDt);
  const auto path = [&](double t, std::uint32_t k) {
    return Array3d(speed_of(k) * t + bend * Rng{8}.normal2(Stream::probe, 0, k)[0] * t * t / 2, 0, 0);
  };
  const auto visits = recorded_visits(with_error(filmed(2000, 20, path), Array3d::Constant(sigma), 5), Array3d::Constant(sigma));
  const double said = std::sqrt(0.1 + 2 * 0.04) * sigma / kDt;
  EXPECT_NEAR(visits.front().vel_error[0], said, 0.1 * said);
  EXPECT_NEAR(mean_square_z(visits, speed_of), 0.14 / 0.18, 0.1);
}

// Velocities that chance changes in every step, and no error: a difference of two frames is off by half the variance of a change (position
// moves by the mean of the velocities before and after it), what is drawn has neither more nor less energy than the recording.
TEST(Entry, WhatIsDrawnIsAsFastAsTheRecording) {
  constexpr std::uint32_t tracks = 4000;
  constexpr double memory = 0.7;
  std::map<std::pair<std::uint32_t, std::int64_t>, double> place;
  std::vector<double> first(tracks);
  const auto draw = [](std::uint32_t t, std::int64_t f) { return Rng{9}.normal2(Stream::probe, static_cast<std::uint64_t>(f), t)[0]; };
  for (std::uint32_t t = 0; t < tracks; ++t) {
    double v = first[t] = draw(t, 0), x = 0;
    for (std::int64_t f = 0; f < 30; ++f) {
      place[{t, f}] = x;
      const double next = memory * v + std::sqrt(1 - memory * memory) * draw(t, f + 1);
      x += 0.5 * (v + next) * kDt;
      v = next;
    }
  }
  const Tracks film = filmed(tracks, 30, [&](double time, std::uint32_t t) { return Array3d(place[{t, std::lround(time / kDt)}], 0, 0); });
  const auto visits = recorded_visits(film, kNone);
  double energy = 0, error = 0;
  for (const auto& v : visits) {
    energy += (v.vel[0] * v.vel[0] + v.vel_error[0] * v.vel_error[0]) / tracks;
    error += std::pow(v.vel[0] - first[v.id], 2) / tracks;
  }
  EXPECT_NEAR(energy, 1, 3 * std::sqrt(2.0 / tracks));
  EXPECT_NEAR(std::sqrt(error), visits.front().vel_error[0], 0.2 * visits.front().vel_error[0]);
}

// Straight paths that differ by no more than the camera errs: what is drawn differs as they do, not by twice that error more.
TEST(Entry, LocalisationErrorIsNotTakenForSpeed) {
  constexpr std::uint32_t tracks = 2000;
  const double sigma = 0.3, spread = sigma / std::sqrt(60) / kDt;
  const auto truth = [&](std::uint32_t k) { return 40 + spread * Rng{8}.normal2(Stream::probe, 0, k)[0]; };
  const auto visits = recorded_visits(
      with_error(filmed(tracks, 20, [&](double t, std::uint32_t k) { return Array3d(truth(k) * t, 0, 0); }), Array3d::Constant(sigma), 5),
      Array3d::Constant(sigma));
  double drawn = 0;
  for (const auto& v : visits) drawn += (std::pow(v.vel[0] - 40, 2) + std::pow(v.vel_error[0], 2)) / tracks;
  EXPECT_NEAR(drawn / (spread * spread), 1, 0.12);
  EXPECT_NEAR(mean_square_z(visits, truth), 1, 0.1);
}

// Straight on in a wind: one who is seen once moves with it, give or take what the others differ by.
TEST(Entry, OneSeenOnceMovesLikeTheOthers) {
  const Tracks film = filmed(21, 30, [](double t, std::uint32_t k) { return Array3d((5 + 0.1 * (k % 5 - 2.0)) * t, 0, 0); });
  TrackColumns c;
  for (Index row = 0; row < film.rows(); ++row) {
    const auto k = static_cast<std::size_t>(row);
    if (film.track()[k] == 20 && film.frame()[k] > 0) continue;
    c.track.push_back(film.track()[k]);
    c.frame.push_back(film.frame()[k]);
  }
  c.names = film.names();
  c.pos = Rows(static_cast<Index>(c.track.size()), 3);
  for (std::size_t k = 0; k < c.track.size(); ++k)
    c.pos.row(static_cast<Index>(k)) << (5 + 0.1 * (c.track[k] % 5 - 2.0)) * kDt * static_cast<double>(c.frame[k]), 0, 0;
  const auto visits = recorded_visits(Tracks(std::move(c), film.meta()), kNone);
  EXPECT_NEAR(visits.back().vel[0], 5, 1e-9);
  EXPECT_NEAR(visits.back().vel_error[0], 0.1 * std::sqrt(2), 1e-6);
  EXPECT_NEAR(visits.front().vel[0], 4.8, 1e-9);
}

TEST(Entry, RecordedVelocitiesAreTakenAsTheyAre) {
  TrackColumns c;
  c.names = {"a"};
  for (std::int64_t f = 0; f < 6; ++f) c.track.push_back(0), c.frame.push_back(f);
  c.pos = Rows::Random(6, 3);
  c.vel = Rows::Constant(6, 3, 4.0);
  TrackMeta meta;
  meta.dt = kDt;
  const auto visits = recorded_visits(Tracks(std::move(c), meta), kNone);
  EXPECT_EQ(visits.front().vel[1], 4);
  EXPECT_EQ(visits.front().vel_error.maxCoeff(), 0);
}

TEST(Entry, AsSeenItIsTheFirstDifference) {
  const Tracks bent = filmed(1, 20, [](double t, std::uint32_t) { return Array3d(100 * t * t, 5 * t, 0); });
  const auto visit = recorded_visits(bent, Array3d::Constant(0.1), EntryVelocity::difference).front();
  EXPECT_NEAR(visit.vel[0], 100 * kDt, 1e-9);
  EXPECT_NEAR(visit.vel[1], 5, 1e-9);
  EXPECT_EQ(visit.vel_error.maxCoeff(), 0);
}

TEST(Entry, TwoFramesGiveADifferenceAndOneGivesNothing) {
  EXPECT_NEAR(recorded_visits(filmed(1, 2, [](double t, std::uint32_t) { return Array3d(3 * t, 0, 0); }), kNone).front().vel[0], 3, 1e-12);
  const auto one = recorded_visits(filmed(1, 1, [](double, std::uint32_t) { return Array3d(1, 2, 3); }), kNone).front();
  EXPECT_EQ(one.vel.abs().maxCoeff(), 0);
  EXPECT_EQ(one.vel_error.maxCoeff(), 0);
}

}  // namespace
}  // namespace swarmfit
