// SPDX-License-Identifier: MIT
// Metrics and order parameters of one kind of agent: sheep, not the dog.
#include <gtest/gtest.h>

#include "libeval/metrics.h"
#include "libeval/order.h"
#include "tests/eval/build.h"

namespace swarmfit {
namespace {

// Six animals, the third and the last of them dogs that run among the sheep.
std::vector<test::Row> herd() { return test::trapped(5, 6, 40, {.dims = 2}); }
bool is_dog(std::uint32_t track) { return track == 2 || track == 5; }

Tracks with_kinds(const std::vector<test::Row>& rows) {
  const Tracks plain = test::tracks_of(rows, {.dims = 2});
  TrackColumns columns = plain.columns();
  for (const auto track : columns.track) columns.kind.push_back(is_dog(track) ? 1 : 0);
  return {std::move(columns), plain.meta()};
}

Tracks alone(bool dogs) {
  std::vector<test::Row> rows;
  for (const auto& row : herd())
    if (is_dog(row.track) == dogs) rows.push_back(row);
  return test::tracks_of(rows, {.dims = 2});
}

TEST(Kinds, MetricsAreThoseOfTheKindAlone) {
  const Tracks all = with_kinds(herd());
  for (const bool dogs : {false, true}) {
    const MetricSamples own = metric_samples(all, {.lags = {1, 3}, .kind = dogs ? 1 : 0});
    const MetricSamples expected = metric_samples(alone(dogs), {.lags = {1, 3}});
    EXPECT_EQ(own.values, expected.values);
    EXPECT_EQ(own.undefined, expected.undefined);
    EXPECT_EQ(own.natural, expected.natural);
    EXPECT_NE(own.values[kDistance], metric_samples(all).values[kDistance]);
  }
}

TEST(Kinds, RowsAreThoseOfTheWholeRecording) {
  const Tracks all = with_kinds(herd());
  const MetricSamples dogs = metric_samples(all, {.keep_rows = true, .kind = 1}), everybody = metric_samples(all, {.keep_rows = true});
  ASSERT_FALSE(dogs.rows[kSpeed].empty());
  for (std::size_t k = 0; k < dogs.rows[kSpeed].size(); ++k) {
    const Index row = dogs.rows[kSpeed][k];
    EXPECT_EQ(all.kind(row), 1);
    for (std::size_t j = 0; j < everybody.rows[kSpeed].size(); ++j)
      if (everybody.rows[kSpeed][j] == row) {
        EXPECT_EQ(everybody.values[kSpeed][j], dogs.values[kSpeed][k]);
      }
  }
}

TEST(Kinds, OrderIsThatOfTheKindAlone) {
  const Tracks all = with_kinds(herd());
  const OrderSeries own = order_parameters(all, 0), expected = order_parameters(alone(false));
  EXPECT_EQ(own.frame, expected.frame);
  EXPECT_EQ(own.extent, expected.extent);
  for (std::size_t f = 0; f + 1 < own.frame.size(); ++f) {
    EXPECT_EQ(own.polarisation[f], expected.polarisation[f]);
    EXPECT_EQ(own.milling[f], expected.milling[f]);
  }
  EXPECT_NE(own.extent, order_parameters(all).extent);
}

TEST(Kinds, NobodyOfAKindIsNoMotion) {
  const Tracks all = with_kinds(herd());
  EXPECT_TRUE(metric_samples(all, {.kind = 9}).values[kSpeed].empty());
  EXPECT_TRUE(order_parameters(all, 9).frame.empty());
}

}  // namespace
}  // namespace swarmfit
