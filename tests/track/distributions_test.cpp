// SPDX-License-Identifier: MIT
#include "libtrack/distributions.h"

#include <gtest/gtest.h>

#include <cmath>

namespace swarmfit {
namespace {

// Closed forms: t with one degree is Cauchy's, with two it is algebraic.
TEST(Distributions, QuantilesOfStudentsT) {
  EXPECT_NEAR(student_t_above(0.25, 1), 1, 1e-12);
  EXPECT_NEAR(student_t_above(0.1, 2), 0.8 * std::sqrt(2 / (4 * 0.9 * 0.1)), 1e-12);
  EXPECT_NEAR(student_t_above(0.025, 10), 2.2281388519649385, 1e-9);  // R: qt(.975, 10)
}

// F with (2, n) degrees has the tail (1 + 2 x / n)^(-n / 2).
TEST(Distributions, TailOfF) {
  EXPECT_NEAR(fisher_f_tail(3, 2, 8), std::pow(1 + 6.0 / 8, -4), 1e-12);
  EXPECT_DOUBLE_EQ(fisher_f_tail(0, 3, 5), 1);
}

double binomial_at_most(int k, int n, double chance) {
  double sum = 0;
  for (int i = 0; i <= k; ++i)
    sum +=
        std::exp(std::lgamma(n + 1) - std::lgamma(i + 1) - std::lgamma(n - i + 1) + i * std::log(chance) + (n - i) * std::log1p(-chance));
  return sum;
}

TEST(Distributions, BandOfCountsBySummation) {
  const auto [low, high] = binomial_band(200, 0.95, 0.005);
  EXPECT_LT(binomial_at_most(low - 1, 200, 0.95), 0.005);
  EXPECT_GE(binomial_at_most(low, 200, 0.95), 0.005);
  EXPECT_LT(binomial_at_most(high - 1, 200, 0.95), 0.995);
  EXPECT_GE(binomial_at_most(high, 200, 0.95), 0.995);
}

}  // namespace
}  // namespace swarmfit
