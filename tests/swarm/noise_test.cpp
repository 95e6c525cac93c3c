// SPDX-License-Identifier: MIT
#include "libswarm/noise.h"

#include <gtest/gtest.h>

namespace swarmfit {
namespace {

using Eigen::Array3d;

// The permutation published with K. Perlin's reference implementation, https://mrl.cs.nyu.edu/~perlin/noise/
constexpr Perlin::Permutation kPublished{
    151, 160, 137, 91,  90,  15,  131, 13,  201, 95,  96,  53,  194, 233, 7,   225, 140, 36,  103, 30,  69,  142, 8,   99,  37,  240,
    21,  10,  23,  190, 6,   148, 247, 120, 234, 75,  0,   26,  197, 62,  94,  252, 219, 203, 117, 35,  11,  32,  57,  177, 33,  88,
    237, 149, 56,  87,  174, 20,  125, 136, 171, 168, 68,  175, 74,  165, 71,  134, 139, 48,  27,  166, 77,  146, 158, 231, 83,  111,
    229, 122, 60,  211, 133, 230, 220, 105, 92,  41,  55,  46,  245, 40,  244, 102, 143, 54,  65,  25,  63,  161, 1,   216, 80,  73,
    209, 76,  132, 187, 208, 89,  18,  169, 200, 196, 135, 130, 116, 188, 159, 86,  164, 100, 109, 198, 173, 186, 3,   64,  52,  217,
    226, 250, 124, 123, 5,   202, 38,  147, 118, 126, 255, 82,  85,  212, 207, 206, 59,  227, 47,  16,  58,  17,  182, 189, 28,  42,
    223, 183, 170, 213, 119, 248, 152, 2,   44,  154, 163, 70,  221, 153, 101, 155, 167, 43,  172, 9,   129, 22,  39,  253, 19,  98,
    108, 110, 79,  113, 224, 232, 178, 185, 112, 104, 218, 246, 97,  228, 251, 34,  242, 193, 238, 210, 144, 12,  191, 179, 162, 241,
    81,  51,  145, 235, 249, 14,  239, 107, 49,  192, 214, 31,  181, 199, 106, 157, 184, 84,  204, 176, 115, 121, 50,  45,  127, 4,
    150, 254, 138, 236, 205, 93,  222, 114, 67,  29,  24,  72,  243, 141, 128, 195, 78,  66,  215, 61,  156, 180};

Array3d point(const Rng& rng, std::uint32_t k, double width) {
  const auto xy = rng.uniform2(Stream::probe, 0, k, 0);
  return width * (Array3d(xy[0], xy[1], rng.uniform(Stream::probe, 0, k, 1)) - 0.5);
}

TEST(Perlin, PublishedValues) {
  const Perlin noise(kPublished);
  EXPECT_NEAR(noise({3.14, 42, 7}).value, 0.136919958784, 5e-13);
  EXPECT_NEAR(noise({0.5, 0.5, 0.5}).value, -0.25, 1e-15);
}

TEST(Perlin, VanishesOnTheLatticeAndRepeatsAfter256) {
  const Perlin noise(Perlin::shuffled(Rng{1}, 0));
  EXPECT_EQ(noise({3, -4, 5}).value, 0);
  EXPECT_NEAR(noise({3.25, -4.5, 5.125}).value, noise({3.25 + 256, -4.5 - 256, 5.125 + 512}).value, 1e-12);
}

TEST(Perlin, ShuffledTablesArePermutationsAndDiffer) {
  std::array<int, 256> seen{};
  const auto table = Perlin::shuffled(Rng{5}, 0);
  for (const auto value : table) ++seen[value];
  for (const int count : seen) EXPECT_EQ(count, 1);
  EXPECT_NE(table, Perlin::shuffled(Rng{5}, 1));
  EXPECT_NE(table, Perlin::shuffled(Rng{6}, 0));
  EXPECT_EQ(table, Perlin::shuffled(Rng{5}, 0));
}

// Central differences err by h²/6 of the third derivative (below 200 here) and by rounding, 1e-16 / h.
TEST(Perlin, GradientIsTheDerivative) {
  const Perlin noise(Perlin::shuffled(Rng{2}, 0));
  const double h = 1e-5;
  const auto check = [&](const Array3d& x) {
    const Array3d gradient = noise(x).gradient;
    for (Index axis = 0; axis < 3; ++axis) {
      Array3d step = Array3d::Zero();
      step[axis] = h;
      ASSERT_NEAR(gradient[axis], (noise(x + step).value - noise(x - step).value) / (2 * h), 1e-8) << "axis " << axis;
    }
  };
  for (std::uint32_t k = 0; k < 2000; ++k) {
    Array3d x = point(Rng{3}, k, 50);
    check(x);
    for (Index axis = 0; axis < 3; ++axis)  // just before, on and just after a lattice plane
      for (const double beside : {-2e-5, 0.0, 2e-5}) {
        Array3d y = x;
        y[axis] = std::round(x[axis]) + beside;
        check(y);
      }
  }
}

// Root mean squares of independent points; the bands are the reference figures ± 5 standard errors (level 6e-7).
TEST(NoiseField, Strength) {
  const NoiseField field(Rng{4});
  constexpr int n = 200000;
  double value2 = 0, curl2 = 0, largest = 0;
  for (std::uint32_t k = 0; k < n; ++k) {
    const Array3d x = point(Rng{5}, k, 200);
    const Array3d p = field.potential(x);
    value2 += p.square().sum() / 3;
    curl2 += field.curl(x).square().sum();
    largest = std::max(largest, p.abs().maxCoeff());
  }
  EXPECT_NEAR(std::sqrt(value2 / n), 0.27, 0.005);
  EXPECT_NEAR(std::sqrt(curl2 / n), 1.72, 0.015);
  EXPECT_LT(largest, 1.0363);
}

TEST(NoiseField, CurlIsFreeOfDivergence) {
  const NoiseField field(Rng{6});
  const double h = 1e-3;
  double largest = 0;
  for (std::uint32_t k = 0; k < 100000; ++k) {
    const Array3d x = point(Rng{7}, k, 100);
    double divergence = 0;
    for (Index axis = 0; axis < 3; ++axis) {
      Array3d step = Array3d::Zero();
      step[axis] = h;
      divergence += (field.curl(x + step)[axis] - field.curl(x - step)[axis]) / (2 * h);
    }
    largest = std::max(largest, std::abs(divergence));
  }
  EXPECT_LT(largest, 2e-4);
  EXPECT_GT(largest, 1e-6);  // the error of the differences: a smaller one would mean that nothing was measured
}

TEST(NoiseField, CurlIsTheCurlOfThePotential) {
  const NoiseField field(Rng{8});
  const double h = 1e-5;
  for (std::uint32_t k = 0; k < 1000; ++k) {
    const Array3d x = point(Rng{9}, k, 20);
    const auto slope = [&](Index component, Index axis) {
      Array3d step = Array3d::Zero();
      step[axis] = h;
      return (field.potential(x + step)[component] - field.potential(x - step)[component]) / (2 * h);
    };
    const Array3d curl(slope(2, 1) - slope(1, 2), slope(0, 2) - slope(2, 0), slope(1, 0) - slope(0, 1));
    ASSERT_LT((field.curl(x) - curl).abs().maxCoeff(), 1e-7);
    const Array3d flat(slope(0, 1), -slope(0, 0), 0);
    ASSERT_LT((field.curl2(x) - flat).abs().maxCoeff(), 1e-7);
  }
}

// Correlation of the curl at a distance, in units of the feature size: reference figures 0.74 at 0.25, 0.28 at 0.5,
// in a direction that is not given; Perlin noise is not quite isotropic, hence the wide bands.
TEST(NoiseField, CurlForgetsWithinOneFeature) {
  const NoiseField field(Rng{10});
  const auto correlation = [&](double lag) {
    double same = 0, apart = 0;
    for (std::uint32_t k = 0; k < 100000; ++k) {
      const Array3d x = point(Rng{11}, k, 200), c = field.curl(x);
      same += c.square().sum();
      apart += (c * field.curl(x + lag * random_direction(Rng{12}, Stream::probe, 0, k, 0, 3))).sum();
    }
    return apart / same;
  };
  EXPECT_NEAR(correlation(0.25), 0.74, 0.04);
  EXPECT_NEAR(correlation(0.5), 0.28, 0.05);
  EXPECT_NEAR(correlation(3), 0, 0.02);
}

// n independent draws per component; bands of 5 standard errors (level 6e-7).
TEST(WhiteNoise, Moments) {
  constexpr int n = 100000;
  Array3d mean = Array3d::Zero(), white2 = Array3d::Zero(), normal2 = Array3d::Zero();
  double cross = 0;
  for (std::uint32_t k = 0; k < n; ++k) {
    const Array3d w = white_noise(Rng{13}, k, 1), g = gaussian_noise(Rng{13}, k, 1);
    ASSERT_LE(w.abs().maxCoeff(), 1.0);
    mean += w;
    white2 += w.square();
    normal2 += g.square();
    cross += g[0] * g[2];
  }
  const double se = 5 / std::sqrt(n);
  EXPECT_LT((mean / n).abs().maxCoeff(), se * std::sqrt(1. / 3));
  EXPECT_LT((white2 / n - 1. / 3).abs().maxCoeff(), se * std::sqrt(4. / 45));
  EXPECT_LT((normal2 / n - 1).abs().maxCoeff(), se * std::sqrt(2));
  EXPECT_NEAR(cross / n, 0, se);
}

TEST(RandomDirection, IsUniform) {
  constexpr int n = 100000;
  Array3d mean = Array3d::Zero(), second = Array3d::Zero();
  for (std::uint32_t k = 0; k < n; ++k) {
    const Array3d d = random_direction(Rng{14}, Stream::tie_break, 0, k, 0, 3);
    ASSERT_NEAR(d.square().sum(), 1, 1e-12);
    mean += d;
    second += d.square();
    const Array3d flat = random_direction(Rng{14}, Stream::tie_break, 0, k, 0, 2);
    ASSERT_EQ(flat[2], 0);
    ASSERT_NEAR(flat.square().sum(), 1, 1e-12);
  }
  EXPECT_LT((mean / n).abs().maxCoeff(), 5 * std::sqrt(1. / 3 / n));
  EXPECT_LT((second / n - 1. / 3).abs().maxCoeff(), 5 * std::sqrt(4. / 45 / n));
}

// The three potentials are computed side by side: the same bits as one after the other.
TEST(NoiseField, EqualsThreePotentialsToTheBit) {
  const Rng rng{21};
  const NoiseField field(rng);
  for (std::uint32_t n = 0; n < 2000; ++n) {
    const Array3d x = point(Rng{22}, n, n % 2 ? 3.0 : 3000.0);
    const VectorPotential together = field.vector_potential(x);
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto xy = rng.uniform2(Stream::noise_table, 1, k, 0);
      const Array3d offset = 256 * Array3d(xy[0], xy[1], rng.uniform(Stream::noise_table, 1, k, 1));
      const Potential alone = Perlin(Perlin::shuffled(rng, k))(x + offset);
      ASSERT_EQ(together.value[k], alone.value);
      ASSERT_TRUE((together.gradient.row(k).transpose() == alone.gradient).all());
    }
  }
}

}  // namespace
}  // namespace swarmfit
