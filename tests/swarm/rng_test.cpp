// SPDX-License-Identifier: MIT
#include "libtrack/rng.h"

#include <Random123/philox.h>
#include <gtest/gtest.h>

#include <vector>

namespace swarmfit {
namespace {

// Published with the reference implementation, Random123 tests/kat_vectors, "philox4x32 10".
TEST(Philox, KnownAnswers) {
  EXPECT_EQ(philox::bijection({0, 0, 0, 0}, {0, 0}), (philox::Counter{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  const std::uint32_t f = 0xffffffff;
  EXPECT_EQ(philox::bijection({f, f, f, f}, {f, f}), (philox::Counter{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox::bijection({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (philox::Counter{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Philox, EqualsRandom123) {
  r123::Philox4x32 reference;
  philox::Counter counter{1, 2, 3, 4};
  philox::Key key{5, 6};
  for (int k = 0; k < 1000; ++k) {
    const auto expected = reference({{counter[0], counter[1], counter[2], counter[3]}}, {{key[0], key[1]}});
    counter = philox::bijection(counter, key);
    for (std::size_t word = 0; word < 4; ++word) ASSERT_EQ(counter[word], expected[word]) << "draw " << k;
    key = {counter[3], counter[0]};
  }
}

TEST(Rng, EveryArgumentMatters) {
  const Rng rng{42};
  const auto base = rng.bits(Stream::noise, 10, 20, 30);
  EXPECT_EQ(base, rng.bits(Stream::noise, 10, 20, 30));
  EXPECT_NE(base, rng.bits(Stream::start, 10, 20, 30));
  EXPECT_NE(base, rng.bits(Stream::noise, 11, 20, 30));
  EXPECT_NE(base, rng.bits(Stream::noise, 10 + (std::uint64_t{1} << 32), 20, 30));
  EXPECT_NE(base, rng.bits(Stream::noise, 10, 21, 30));
  EXPECT_NE(base, rng.bits(Stream::noise, 10, 20, 31));
  EXPECT_NE(base, (Rng{43}.bits(Stream::noise, 10, 20, 30)));
  EXPECT_NE(base, (Rng{42 + (std::uint64_t{1} << 32)}.bits(Stream::noise, 10, 20, 30)));
}

TEST(Rng, UniformFillsTheUnitInterval) {
  const Rng rng{1};
  constexpr int n = 100000, bins = 20;
  std::vector<int> count(bins);
  for (std::uint32_t k = 0; k < n; ++k) {
    const double u = rng.uniform(Stream::noise, 0, k);
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    ++count[static_cast<std::size_t>(u * bins)];
  }
  double chi2 = 0;
  for (const int c : count) chi2 += (c - n / bins) * (c - n / bins) / static_cast<double>(n / bins);
  EXPECT_LT(chi2, 50.8);  // chi² with 19 degrees of freedom, level 1e-4
}

// Moments of n draws within 5 standard errors: level 6e-7 each.
TEST(Rng, NormalMoments) {
  const Rng rng{7};
  constexpr int n = 500000;
  double m1 = 0, m2 = 0, m3 = 0, m4 = 0, cross = 0;
  for (std::uint32_t k = 0; k < n; ++k) {
    const auto z = rng.normal2(Stream::noise, k, 3);
    m1 += z[0];
    m2 += z[1] * z[1];
    m3 += z[0] * z[0] * z[0];
    m4 += z[1] * z[1] * z[1] * z[1];
    cross += z[0] * z[1];
  }
  const double se = 5 / std::sqrt(n);
  EXPECT_NEAR(m1 / n, 0, se);
  EXPECT_NEAR(m2 / n, 1, se * std::sqrt(2));
  EXPECT_NEAR(m3 / n, 0, se * std::sqrt(15));
  EXPECT_NEAR(m4 / n, 3, se * std::sqrt(96));
  EXPECT_NEAR(cross / n, 0, se);
}

// Neighbouring streams, ticks and agents are uncorrelated: |r| < 5 / sqrt(n), level 6e-7 each.
TEST(Rng, StreamsAreIndependent) {
  const Rng rng{3};
  constexpr int n = 200000;
  double streams = 0, ticks = 0, agents = 0, seeds = 0;
  for (std::uint32_t k = 0; k < n; ++k) {
    const double u = rng.uniform(Stream::noise, k, 5) - 0.5;
    streams += u * (rng.uniform(Stream::tie_break, k, 5) - 0.5);
    ticks += u * (rng.uniform(Stream::noise, k + 1, 5) - 0.5);
    agents += u * (rng.uniform(Stream::noise, k, 6) - 0.5);
    seeds += u * (Rng{4}.uniform(Stream::noise, k, 5) - 0.5);
  }
  for (const double sum : {streams, ticks, agents, seeds}) EXPECT_LT(std::abs(12 * sum / n), 5 / std::sqrt(n));
}

TEST(Rng, DerivedSeedsDiffer) {
  const Rng rng{3};
  EXPECT_NE(rng.derive(Stream::replicate, 0).seed, rng.derive(Stream::replicate, 1).seed);
  EXPECT_NE(rng.derive(Stream::replicate, 0).seed, rng.derive(Stream::search, 0).seed);
  EXPECT_NE(rng.derive(Stream::replicate, 0).seed, rng.seed);
}

}  // namespace
}  // namespace swarmfit
