// SPDX-License-Identifier: MIT
#include "libeval/independent.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/eval/build.h"

namespace swarmfit {
namespace {

using test::Row;
using test::tracks_of;

// Along x at 10 + a speed that remembers `memory` of itself from frame to frame; `lost`: frames without anybody.
std::vector<Row> walkers(std::uint32_t tracks, std::int64_t frames, double memory, std::int64_t lost = -1) {
  std::vector<Row> rows;
  for (std::uint32_t i = 0; i < tracks; ++i) {
    double x = 0, v = test::normal(3, 0, i, 0);
    for (std::int64_t f = 0; f < frames; ++f) {
      if (f != lost) rows.push_back({i, f, {x, 100.0 * i, 0}});
      x += 10 + v;
      v = memory * v + std::sqrt(1 - memory * memory) * test::normal(3, static_cast<std::uint64_t>(f) + 1, i, 0);
    }
  }
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.frame < b.frame; });
  return rows;
}

// A first-order autoregression is worth (1 - memory) / (1 + memory) of its samples. 40 x 500 of them: the sum of autocorrelations scatters
// by a few per cent.
TEST(Independent, AutoregressionsAreWorthWhatTheirMemoryLeaves) {
  for (const double memory : {0.0, 0.5, 0.9}) {
    const double n = 40 * 499, worth = independent_samples(tracks_of(walkers(40, 500, memory)))[kSpeed];
    EXPECT_NEAR(worth / n, (1 - memory) / (1 + memory), 0.12 * (1 - memory) / (1 + memory) + 0.01) << memory;
  }
}

// Runs before and after a gap are not put together: fewer values, as much worth each.
TEST(Independent, NothingIsCorrelatedAcrossAGap) {
  const double whole = independent_samples(tracks_of(walkers(40, 500, 0.9)))[kSpeed];
  const double broken = independent_samples(tracks_of(walkers(40, 500, 0.9, 250)))[kSpeed];
  EXPECT_NEAR(broken / whole, 1, 0.1);
}

TEST(Independent, SamplesOfEveryMetricAreBetweenOneAndAll) {
  MetricOptions options;
  options.lags = {1, 4};
  const Tracks tracks = tracks_of(walkers(5, 100, 0.8));
  const auto worth = independent_samples(tracks, options);
  const MetricSamples samples = metric_samples(tracks, options);
  ASSERT_EQ(worth.size(), samples.columns.size());
  for (std::size_t j = 0; j < worth.size(); ++j) {
    if (std::isnan(worth[j])) continue;
    EXPECT_GE(worth[j], 1) << j;
    EXPECT_LE(worth[j], static_cast<double>(samples.values[j].size())) << j;
  }
  EXPECT_LT(worth[kSpeed], 0.5 * static_cast<double>(samples.values[kSpeed].size()));
}

TEST(Independent, ConstantsAreWorthNothingThatCouldBeSaid) {
  const auto steady = test::rows_of(3, 50, 0.1, [](std::uint32_t i, double t) { return std::array{5 * t, 3.0 * i, 0.0}; });
  EXPECT_TRUE(std::isnan(independent_samples(tracks_of(steady, {.dt = 0.1}))[kAngularVelocity]));
}

TEST(Independent, RowsAreWhereValuesBegin) {
  MetricOptions options;
  options.keep_rows = true;
  const Tracks tracks = tracks_of(walkers(3, 20, 0.5, 7));
  const MetricSamples samples = metric_samples(tracks, options);
  for (std::size_t j = 0; j < samples.columns.size(); ++j) ASSERT_EQ(samples.rows[j].size(), samples.values[j].size()) << j;
  for (std::size_t k = 0; k < samples.values[kSpeed].size(); ++k) {
    const Index row = samples.rows[kSpeed][k], next = tracks.next()[static_cast<std::size_t>(row)];
    EXPECT_NEAR(samples.values[kSpeed][k], (tracks.pos()(next, 0) - tracks.pos()(row, 0)) / tracks.dt(), 1e-9);
  }
  EXPECT_TRUE(metric_samples(tracks).rows[kSpeed].empty());
}

}  // namespace
}  // namespace swarmfit
