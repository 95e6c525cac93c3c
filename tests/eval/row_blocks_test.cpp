// SPDX-License-Identifier: MIT
#include "libeval/row_blocks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "libeval/angles.h"
#include "libtrack/rng.h"

namespace swarmfit {
namespace {

using Links = std::set<std::pair<Index, Index>>;

Links links_of(const std::vector<RowBlock>& blocks) {
  Links out;
  Index before = -1;
  for (const auto& [first, count, shift] : blocks) {
    EXPECT_GT(first, before) << "ascending";
    before = first + count - 1;
    for (Index k = first; k <= before; ++k) out.insert({k, k + shift});
  }
  return out;
}

// Rows of 3 to 6 individuals who come and go, by the plain definition.
TEST(RowBlocks, AreTheLinks) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    std::vector<Index> next;
    for (std::uint32_t k = 0; k < 60; ++k) {
      const double u = Rng{seed}.uniform(Stream::probe, k, 0);
      next.push_back(u < 0.15 || k > 50 ? -1 : static_cast<Index>(k) + (seed % 2 == 0 ? 4 : 3 + static_cast<Index>(3 * u)));
    }
    Links plain, twice;
    for (std::size_t k = 0; k < next.size(); ++k) {
      if (next[k] < 0) continue;
      plain.insert({static_cast<Index>(k), next[k]});
      if (next[static_cast<std::size_t>(next[k])] >= 0) twice.insert({static_cast<Index>(k), next[k]});
    }
    const auto blocks = blocks_of(next);
    EXPECT_EQ(links_of(blocks), plain);
    EXPECT_EQ(links_of(blocks_into(blocks, blocks)), twice);
  }
  EXPECT_EQ(blocks_of(std::vector<Index>{2, 3, 4, 5, -1, -1}).size(), 1u);
}

TEST(Angles, AreThoseOfTheLibrary) {
  std::vector<double> y, x;
  for (std::uint32_t k = 0; k < 20001; ++k) {
    const auto u = Rng{1}.uniform2(Stream::probe, k, 0, 0);
    const double size = std::pow(10, 20 * Rng{2}.uniform(Stream::probe, k, 0) - 10), small = std::pow(10, -16 * u[1]);
    y.push_back(k % 3 == 0 ? size * small : size * u[0]);
    x.push_back((k % 2 == 0 ? -1 : 1) * (k % 3 == 1 ? size * small : size));
  }
  for (const double edge : {0.0, 1.0, -1.0, 0.66, -0.66}) y.push_back(std::abs(edge)), x.push_back(1), y.push_back(1), x.push_back(edge);
  y.push_back(0), x.push_back(-1), y.push_back(0), x.push_back(0);
  std::vector<double> got(y.size());
  angles(y.data(), x.data(), static_cast<Index>(y.size()), got.data());
  for (std::size_t k = 0; k < y.size(); ++k) {
    const double want = std::atan2(y[k], x[k]);
    ASSERT_NEAR(got[k], want, 3 * 2.3e-16 * want) << y[k] << ' ' << x[k];
  }
  const double nan = NAN, one = 1;
  angles(&nan, &one, 1, got.data());
  EXPECT_TRUE(std::isnan(got[0]));
}

}  // namespace
}  // namespace swarmfit
