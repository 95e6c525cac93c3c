// SPDX-License-Identifier: MIT
#include "libtrack/parallel_for.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace swarmfit {
namespace {

TEST(ParallelFor, TakesEveryTurnOnce) {
  std::vector<int> turns(1000);
  parallel_for(turns.size(), [&](std::size_t i) { ++turns[i]; });
  EXPECT_EQ(turns, std::vector<int>(1000, 1));
  parallel_for(0, [](std::size_t) { FAIL(); });
}

TEST(ParallelFor, ThrowsWhatTheFirstTurnThrew) {
  const int before = omp_get_max_threads();
  for (const int threads : {1, 4}) {
    omp_set_num_threads(threads);
    try {
      parallel_for(100, [](std::size_t i) {
        if (i >= 10) throw std::runtime_error(std::to_string(i));
      });
      FAIL();
    } catch (const std::runtime_error& e) {
      EXPECT_STREQ(e.what(), "10") << threads;
    }
  }
  omp_set_num_threads(before);
}

}  // namespace
}  // namespace swarmfit
