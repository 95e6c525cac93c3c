// SPDX-License-Identifier: MIT
#include "libeval/rounding.h"

#include <gmock/gmock.h>

#include <cmath>

#include "libeval/energy.h"
#include "libtrack/rng.h"

namespace swarmfit {
namespace {

// `tracks` individuals over `frames` frames at 50 Hz, where place(track, frame) says.
template <class Place>
Tracks filmed(std::uint32_t tracks, std::int64_t frames, Place&& place) {
  TrackColumns c;
  for (std::uint32_t t = 0; t < tracks; ++t) c.names.push_back(std::to_string(t));
  const auto rows = static_cast<Index>(tracks) * frames;
  c.pos.resize(rows, 3);
  Index row = 0;
  for (std::int64_t f = 0; f < frames; ++f)
    for (std::uint32_t t = 0; t < tracks; ++t, ++row) {
      c.track.push_back(t);
      c.frame.push_back(f);
      c.pos.row(row) = Eigen::Array3d(place(t, f)).transpose();
    }
  TrackMeta meta;
  meta.dims = 3;
  meta.dt = 0.02;
  return {std::move(c), meta};
}

double at(double x, double step, double origin = 0) { return origin + step * std::round((x - origin) / step); }

// Somebody who flies a circle at 1 m/s, each elsewhere.
Eigen::Array3d circle(std::uint32_t t, std::int64_t f) {
  const double angle = 0.01 * static_cast<double>(f) + t;
  return {2 * std::cos(angle) + t, 2 * std::sin(angle) - t, 0.3 * t};
}

Tracks circles_on(double step, double origin = 0) {
  return filmed(7, 200, [&](std::uint32_t t, std::int64_t f) {
    Eigen::Array3d p = circle(t, f);
    for (double& x : p) x = at(x, step, origin);
    return p;
  });
}

TEST(RoundingGrid, OfDecimals) {
  for (const double step : {1e-3, 1e-6, 0.25, 0.5}) {
    const Grid grid = rounding_grid(circles_on(step));
    EXPECT_NEAR(grid.step[0] / step, 1, 1e-9) << step;
    EXPECT_NEAR(grid.step[1] / step, 1, 1e-9) << step;
  }
}

TEST(RoundingGrid, OfPixelsOfAnyWidth) {
  const Grid grid = rounding_grid(circles_on(0.0637281946, 0.01234567891));
  EXPECT_NEAR(grid.step[0], 0.0637281946, 1e-8);
  EXPECT_NEAR(grid.step[1], 0.0637281946, 1e-8);
}

TEST(RoundingGrid, NoneWhereNumbersAreWrittenInFull) {
  EXPECT_FALSE((rounding_grid(filmed(7, 200, circle)).step.head<2>() > 0).any());
  EXPECT_FALSE(rounding_grid(filmed(0, 0, circle)).any());
}

TEST(RoundingGrid, RoundsToItsOwnPoints) {
  const Tracks tracks = circles_on(0.05);
  const Grid grid = rounding_grid(tracks);
  for (Index row = 0; row < tracks.rows(); ++row) {
    const Eigen::Array3d p = tracks.pos().row(row).transpose();
    EXPECT_LT((grid.rounded(p) - p).abs().maxCoeff(), 1e-9);
    EXPECT_LT((grid.rounded(p + 0.02) - p).head<2>().abs().maxCoeff(), 1e-9);  // nobody moves along z
  }
}

// Rounding to g errs by g / sqrt(12) per position; a speed, from two, by sqrt(2) of that per frame interval.
TEST(RecordedSamples, RoundingOfASpeed) {
  const double step = 1e-3;
  const MetricSamples samples = recorded_samples(circles_on(step), {});
  EXPECT_NEAR(samples.rounding[kSpeed] / (step * std::sqrt(2.0 / 12) / 0.02), 1, 0.1);
  EXPECT_EQ(recorded_samples(filmed(7, 200, circle), {}).rounding[kSpeed], 0);
}

// Everybody flies at one speed, and the file has three decimals: whatever is off by less than rounding is all the same.
TEST(RecordedSamples, AConstantIsAFactNotAHistogram) {
  const Tracks recording = circles_on(1e-3);
  const Target target(recorded_samples(recording, {}), Binning::standard(Normalisation::reference));
  const auto energy = [&](double factor) {
    const Tracks other = filmed(7, 200, [&](std::uint32_t t, std::int64_t f) {
      const double angle = 0.01 * factor * static_cast<double>(f) + t;
      return Eigen::Array3d(at(2 * std::cos(angle) + t, 1e-3), at(2 * std::sin(angle) - t, 1e-3), 0.3 * t);
    });
    return target.energies(target.distributions(metric_samples(other)))[kSpeed];
  };
  EXPECT_LT(energy(1.002), 2);
  EXPECT_GT(energy(1.3), 15);
}

// Without any rounding, too: the one bin that holds the recording holds whoever is as fast within a twentieth of a per cent.
TEST(RecordedSamples, AConstantLiesInTheMiddleOfItsBin) {
  const auto straight = [](double speed) {
    return filmed(3, 60, [=](std::uint32_t t, std::int64_t f) {
      return Eigen::Array3d(1.0 / 3 + speed * 0.02 * static_cast<double>(f), std::sqrt(2.0) * t, 1.0 / 7);
    });
  };
  MetricSamples recorded = recorded_samples(straight(1), {});
  recorded.values[kSpeed].back() += 1e-6;  // not quite a constant, which would be undefined
  const Target target(recorded, Binning::standard(Normalisation::reference));
  for (const double speed : {0.9996, 1.0, 1.0004}) {
    EXPECT_EQ(target.energies(target.distributions(metric_samples(straight(speed))))[kSpeed], 0) << speed;
  }
  EXPECT_EQ(target.energies(target.distributions(metric_samples(straight(1.002))))[kSpeed], target.worst());
}

}  // namespace
}  // namespace swarmfit
