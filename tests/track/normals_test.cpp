// SPDX-License-Identifier: MIT
#include "libtrack/normals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace swarmfit {
namespace {

using Eigen::Array3d;

// Rng::normal2 has its logarithm, sine and cosine from the standard library. Near its zeros the library's sine of a rounded angle is the
// less exact one, so the comparison is absolute.
TEST(Normals, AreThoseOfTheStandardLibrarysFunctions) {
  const Rng rng{7};
  double worst = 0, largest = 0;
  for (std::uint64_t tick = 0; tick < 300000; ++tick) {
    const auto id = static_cast<std::uint32_t>(tick % 97);
    const Array3d ours = three_normals(rng, Stream::noise, tick, id);
    const auto xy = rng.normal2(Stream::noise, tick, id, 0);
    const Array3d theirs(xy[0], xy[1], rng.normal2(Stream::noise, tick, id, 1)[0]);
    worst = std::max(worst, (ours - theirs).abs().maxCoeff());
    largest = std::max(largest, ours.abs().maxCoeff());
  }
  EXPECT_LT(worst, 4e-15);
  EXPECT_GT(largest, 4.5);  // the tails are there
}

// Whatever a block of four is filled up with, whoever stands beside.
TEST(Normals, DoNotDependOnTheOthers) {
  const Rng rng{3};
  std::vector<std::uint32_t> ids;
  for (std::uint32_t k = 0; k < 11; ++k) ids.push_back(k * k + 5);
  for (std::size_t n = 1; n <= ids.size(); ++n) {
    std::vector<double> x(n), y(n), z(n);
    three_normals(rng, Stream::localisation, 42, {ids.data() + ids.size() - n, n}, x.data(), y.data(), z.data());
    for (std::size_t k = 0; k < n; ++k) {
      const Array3d alone = three_normals(rng, Stream::localisation, 42, ids[ids.size() - n + k]);
      EXPECT_TRUE(x[k] == alone[0] && y[k] == alone[1] && z[k] == alone[2]) << n << ' ' << k;
    }
  }
}

TEST(Normals, NobodyGetsNone) { three_normals(Rng{1}, Stream::noise, 1, {}, nullptr, nullptr, nullptr); }

}  // namespace
}  // namespace swarmfit
