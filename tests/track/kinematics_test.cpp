// SPDX-License-Identifier: MIT
#include "libtrack/kinematics.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "libtrack/error.h"
#include "libtrack/rng.h"

namespace swarmfit {
namespace {

// One individual; `missing` frames are left out.
Tracks path(const std::function<Eigen::Array3d(double)>& position, int frames, double dt, const std::vector<int>& missing = {},
            std::vector<std::int64_t> episodes = {}) {
  TrackColumns c;
  c.names = {"1"};
  c.episodes = std::move(episodes);
  std::vector<Eigen::Array3d> points;
  for (int k = 0; k < frames; ++k) {
    if (std::find(missing.begin(), missing.end(), k) != missing.end()) continue;
    c.track.push_back(0);
    c.frame.push_back(k);
    points.push_back(position(k * dt));
  }
  c.pos.resize(static_cast<Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i) c.pos.row(static_cast<Index>(i)) = points[i].transpose();
  return Tracks(std::move(c), {.dims = 3, .dt = dt, .t0 = 0, .unit = "m", .from = {}});
}

TEST(ForwardVelocity, UniformMotion) {
  const auto tracks = path([](double t) { return Eigen::Array3d(1 + 2 * t, -3 * t, 0.5 * t); }, 20, 0.125);
  const auto v = forward_velocity(tracks);
  for (Index i = 0; i < 19; ++i) {
    EXPECT_NEAR(v(i, 0), 2, 1e-13);
    EXPECT_NEAR(v(i, 1), -3, 1e-13);
    EXPECT_NEAR(v(i, 2), 0.5, 1e-13);
  }
  EXPECT_TRUE(v.row(19).isNaN().all());
}

TEST(ForwardVelocity, NothingReachesAcrossAGapOrAnEpisode) {
  const auto tracks = path([](double t) { return Eigen::Array3d(t * t, 0, 0); }, 10, 1, {4}, {7});
  const auto v = forward_velocity(tracks);
  const std::vector<std::int64_t> ends = {3, 6, 9};
  for (Index i = 0; i < tracks.rows(); ++i) {
    const auto frame = tracks.frame()[static_cast<std::size_t>(i)];
    EXPECT_EQ(std::isnan(v(i, 0)), std::find(ends.begin(), ends.end(), frame) != ends.end()) << frame;
    if (!std::isnan(v(i, 0))) {
      EXPECT_EQ(v(i, 0), static_cast<double>(2 * frame + 1));
    }
  }
}

TEST(Smooth, ZeroChangesNothing) {
  const auto tracks = path([](double t) { return Eigen::Array3d(std::sin(t), t, 1); }, 10, 0.1);
  EXPECT_TRUE((smooth(tracks, 0).pos() == tracks.pos()).all());
}

TEST(Smooth, ARestingIndividualStaysToTheEnds) {
  const auto tracks = path([](double) { return Eigen::Array3d(3, -7, 0.25); }, 30, 1, {9});
  EXPECT_LT((smooth(tracks, 2.5).pos() - tracks.pos()).abs().maxCoeff(), 1e-14);
}

TEST(Smooth, AStraightLineStaysAwayFromTheEnds) {
  const auto tracks = path([](double t) { return Eigen::Array3d(t, 0, 0); }, 41, 1);
  const auto moved = smooth(tracks, 2).pos();
  for (Index i = 8; i < 33; ++i) EXPECT_NEAR(moved(i, 0), static_cast<double>(i), 1e-12);
}

// A wave of angular frequency w per frame is damped by exp(-w² sigma² / 2), the Fourier transform of the kernel; the cut at four sigma and
// the sampling change that by less than 1e-4.
TEST(Smooth, DampsAWaveByTheTransformOfTheKernel) {
  const double w = 2 * std::numbers::pi / 25, sigma = 3;
  const auto tracks = path([&](double t) { return Eigen::Array3d(std::cos(w * t), std::sin(w * t), 0); }, 200, 1);
  const auto moved = smooth(tracks, sigma).pos();
  for (Index i = 12; i < 188; ++i) EXPECT_NEAR(std::hypot(moved(i, 0), moved(i, 1)), std::exp(-w * w * sigma * sigma / 2), 1e-4);
}

// The definition, written out: every pair of rows in the same unbroken run.
TEST(Smooth, AgreesWithBruteForceOverGapsAndEpisodes) {
  const Rng rng{3};
  const double sigma = 1.7;
  const auto tracks = path(
      [&](double t) {
        const auto u = rng.uniform2(Stream::probe, static_cast<std::uint64_t>(t + 0.5), 0);
        return Eigen::Array3d(u[0], u[1], u[0] * u[1]);
      },
      50, 1, {10, 11, 30}, {40});
  const auto run = [](std::int64_t frame) { return frame < 10 ? 0 : frame < 30 ? 1 : frame < 40 ? 2 : 3; };
  const auto moved = smooth(tracks, sigma).pos();
  for (Index i = 0; i < tracks.rows(); ++i) {
    double sum = 0, total = 0;
    for (Index j = 0; j < tracks.rows(); ++j) {
      const auto a = tracks.frame()[static_cast<std::size_t>(i)], b = tracks.frame()[static_cast<std::size_t>(j)];
      const auto d = static_cast<double>(std::abs(a - b));
      if (run(a) != run(b) || d > std::ceil(4 * sigma)) continue;
      const double weight = std::exp(-d * d / (2 * sigma * sigma));
      sum += weight * tracks.pos()(j, 1);
      total += weight;
    }
    EXPECT_NEAR(moved(i, 1), sum / total, 1e-14);
  }
}

TEST(Smooth, SaysSoAndRefusesNonsense) {
  const auto tracks = path([](double t) { return Eigen::Array3d(t, 0, 0); }, 5, 1);
  EXPECT_THAT(smooth(tracks, 1.5).meta().from.notes, testing::ElementsAre("positions were smoothed by a Gaussian of 1.5 frames"));
  EXPECT_THROW(smooth(tracks, -1), InputError);
  EXPECT_THROW(smooth(tracks, std::numeric_limits<double>::quiet_NaN()), InputError);
}

}  // namespace
}  // namespace swarmfit
