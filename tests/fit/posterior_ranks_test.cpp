// SPDX-License-Identifier: MIT
#include "fit/infer/posterior_ranks.h"

#include <gtest/gtest.h>

#include <cmath>

namespace swarmfit {
namespace {

Point at(double x, double y) {
  Point p(2);
  p << x, y;
  return p;
}

TEST(PosteriorRanks, AreSharesOfTheWeight) {
  const WeightedSample sample{{at(0.1, 0.5), at(0.2, 0.1), at(0.6, 0.9)}, {1, 2, 5}};
  EXPECT_DOUBLE_EQ(rank_of(sample, 0, 0.3), 3.0 / 8);
  EXPECT_DOUBLE_EQ(rank_of(sample, 1, 0.3), 2.0 / 8);
  EXPECT_DOUBLE_EQ(rank_of(sample, 0, 0.05), 0);
  EXPECT_DOUBLE_EQ(rank_of(sample, 0, 0.7), 1);
  EXPECT_DOUBLE_EQ(nearer_than(sample, at(0, 0), at(0.3, 0.3)), 2.0 / 8);  // .42 from the origin: .51, .22 and 1.1 are the others
  EXPECT_TRUE(std::isnan(rank_of({}, 0, 0.5)));
  EXPECT_TRUE(std::isnan(nearer_than({}, at(0, 0), at(1, 1))));
}

TEST(PosteriorRanks, DistanceFromUniform) {
  EXPECT_DOUBLE_EQ(distance_from_uniform(std::vector<double>{0.5}), 0.5);
  EXPECT_DOUBLE_EQ(distance_from_uniform(std::vector<double>{0.125, NAN, 0.375, 0.625, 0.875}), 0.125);
  EXPECT_DOUBLE_EQ(distance_from_uniform(std::vector<double>{0.4, 0.4, 0.4, 0.4}), 0.6);
  EXPECT_TRUE(std::isnan(distance_from_uniform(std::vector<double>{NAN})));
}

// By the bound at most 5 % of samples of uniform numbers are beyond the band, and for a hundred numbers it is nearly exact; posteriors half
// as wide as they should be, whose ranks crowd at the ends, are found out.
TEST(PosteriorRanks, TheBandHoldsUniformNumbersAndNoOthers) {
  constexpr std::size_t n = 100;
  int beyond = 0, found_out = 0;
  for (std::uint32_t sample = 0; sample < 1000; ++sample) {
    std::vector<double> right, narrow;
    for (std::uint32_t k = 0; k < n; ++k) {
      const double u = Rng{3}.uniform(Stream::probe, sample, k);
      right.push_back(u);
      narrow.push_back(std::clamp(0.5 + 2 * (u - 0.5), 0.0, 1.0));
    }
    beyond += distance_from_uniform(right) > uniform_band(n, 1);
    found_out += distance_from_uniform(narrow) > uniform_band(n, 1);
  }
  EXPECT_GE(beyond, 20);
  EXPECT_LE(beyond, 70);  // of a binomial of 1000 at 5 %: mean 50, sd 7
  EXPECT_EQ(found_out, 1000);
}

}  // namespace
}  // namespace swarmfit
