// SPDX-License-Identifier: MIT
#include "libeval/distance.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/eval/build.h"

namespace swarmfit {
namespace {

Histogram of(std::vector<std::uint64_t> counts) {
  Histogram h{std::move(counts), 0, 0};
  for (const auto n : h.counts) h.samples += n;
  return h;
}

TEST(TotalVariation, ClosedForms) {
  EXPECT_EQ(total_variation(of({1, 2, 1}), of({2, 4, 2})), 0);
  EXPECT_EQ(total_variation(of({1, 0, 0}), of({0, 2, 3})), 1);
  EXPECT_DOUBLE_EQ(total_variation(of({3, 1, 0}), of({1, 1, 2})), 0.5);
}

TEST(TotalVariation, IsHalfTheEnergyTimesTheBinWidth) {
  MetricSamples a, b;
  for (std::uint64_t k = 0; k < 300; ++k) {
    a.values[kSpeed].push_back(test::normal(1, k, 0));
    b.values[kSpeed].push_back(0.5 + 20 * test::normal(2, k, 0));  // much of it in the end bins
  }
  const Target target(a, Binning::standard(Normalisation::reference));
  const auto seen = target.distributions(b);
  const double width = 15.0 / 150;
  EXPECT_NEAR(total_variation(target.recording()[kSpeed].histogram, seen[kSpeed].histogram), 0.5 * width * target.energies(seen)[kSpeed],
              1e-12);
}

TEST(Wasserstein, ShiftByBinsIsThatManyWidths) {
  EXPECT_DOUBLE_EQ(wasserstein(of({4, 2, 0, 0, 0}), of({0, 0, 0, 2, 1}), 0.1), 0.3);
  EXPECT_EQ(wasserstein(of({1, 2, 1}), of({2, 4, 2}), 0.1), 0);
}

// For as many samples on either side it is the mean difference of the sorted samples; bins add at most one width.
TEST(Wasserstein, AgreesWithSortedSamples) {
  constexpr std::size_t n = 4000;
  std::vector<double> x, y;
  for (std::uint64_t k = 0; k < n; ++k) {
    x.push_back(test::normal(3, k, 0));
    y.push_back(0.7 + 1.8 * test::normal(4, k, 0));
  }
  const double lower = -10, width = 0.05;
  Histogram a{std::vector<std::uint64_t>(400, 0), n, 0}, b = a;
  for (const double v : x) ++a.counts[static_cast<std::size_t>((v - lower) / width)];
  for (const double v : y) ++b.counts[static_cast<std::size_t>((v - lower) / width)];
  std::sort(x.begin(), x.end());
  std::sort(y.begin(), y.end());
  double exact = 0;
  for (std::size_t k = 0; k < n; ++k) exact += std::abs(x[k] - y[k]) / n;
  EXPECT_NEAR(wasserstein(a, b, width), exact, 0.1 * width);
}

TEST(Distances, EmptyIsUndefinedAndOtherBinsAreRefused) {
  EXPECT_THAT(total_variation(of({0, 0}), of({1, 2})), testing::IsNan());
  EXPECT_THAT(wasserstein(of({1, 2}), {}, 1), testing::IsNan());
  EXPECT_THROW(total_variation(of({1}), of({1, 2})), std::invalid_argument);
  EXPECT_THROW(wasserstein(of({1}), of({1, 2}), 1), std::invalid_argument);
}

}  // namespace
}  // namespace swarmfit
