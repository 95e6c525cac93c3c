// SPDX-License-Identifier: MIT
#include "libswarm/neighbours.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "libswarm/noise.h"
#include "libswarm/zones.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

// ---- clouds -------------------------------------------------------------------------------------------------------------------

Rows uniform_cloud(Index n, const Array3d& width, std::uint64_t seed) {
  Rows pos(n, 3);
  for (Index i = 0; i < n; ++i) {
    const auto xy = Rng{seed}.uniform2(Stream::probe, 0, static_cast<std::uint32_t>(i), 0);
    const double z = Rng{seed}.uniform(Stream::probe, 0, static_cast<std::uint32_t>(i), 1);
    pos.row(i) << xy[0] * width[0], xy[1] * width[1], z * width[2];
  }
  return pos;
}

// Nearly everybody in a tight clump, a few strays very far away, and two pairs at the same place.
Rows clumped_cloud(Index n) {
  Rows pos = uniform_cloud(n, {1, 1, 1}, 2);
  pos.row(1) << 5000, 0, 0;
  pos.row(2) << -300, 200, 1000;
  pos.row(4) = pos.row(3);
  pos.row(6) = pos.row(5);
  return pos;
}

struct Cloud {
  const char* name;
  Rows pos;
  Bounds bounds;
};

std::vector<Cloud> clouds() {
  Bounds open, periodic;
  periodic.kind = Bounds::Kind::periodic;
  periodic.upper = {10, 8, 6};
  Bounds flat = periodic;
  flat.upper[2] = 0;
  Rows line = uniform_cloud(200, {10, 0, 0}, 3);
  return {{"box", uniform_cloud(450, {10, 8, 6}, 1), open},
          {"clump", clumped_cloud(300), open},
          {"plane", uniform_cloud(300, {10, 10, 0}, 4), open},
          {"line", line, open},
          {"one place", Rows::Zero(20, 3), open},
          {"one agent", Rows::Zero(1, 3), open},
          {"periodic", uniform_cloud(450, {10, 8, 6}, 5), periodic},
          {"periodic, from outside", uniform_cloud(300, {30, 30, 30}, 6) - 12, periodic},
          {"periodic plane", uniform_cloud(400, {10, 8, 0}, 7), flat}};
}

struct Met {
  Index row;
  Array3d offset;
  double distance;
};

std::vector<Met> met(const Neighbours& near, Index i) {
  std::vector<Met> all;
  near.visit(i, [&](Index j, const Array3d& offset, double distance) { all.push_back({j, offset, distance}); });
  std::sort(all.begin(), all.end(), [](const Met& a, const Met& b) { return a.row < b.row; });
  return all;
}

std::vector<Met> brute_force(const Cloud& cloud, Index i, double radius) {
  std::vector<Met> all;
  for (Index j = 0; j < cloud.pos.rows(); ++j) {
    const Array3d offset = cloud.bounds.separation(cloud.pos.row(i).transpose(), cloud.pos.row(j).transpose());
    const double distance = std::sqrt(offset.square().sum());
    if (j != i && distance < radius) all.push_back({j, offset, distance});
  }
  return all;
}

// ---- tests --------------------------------------------------------------------------------------------------------------------

TEST(Neighbours, EqualsBruteForce) {
  for (const Cloud& cloud : clouds())
    for (const auto method : {Neighbours::Method::all_pairs, Neighbours::Method::grid})
      for (const double radius : {0.0, 0.05, 0.7, 2.9, 4.5, 1e5}) {
        Neighbours near;
        near.build(cloud.pos, cloud.bounds, radius, method);
        for (Index i = 0; i < cloud.pos.rows(); ++i) {
          const auto found = met(near, i), expected = brute_force(cloud, i, radius);
          ASSERT_EQ(found.size(), expected.size()) << cloud.name << ", radius " << radius << ", agent " << i;
          for (std::size_t k = 0; k < found.size(); ++k) {
            ASSERT_EQ(found[k].row, expected[k].row);
            ASSERT_NEAR(found[k].distance, expected[k].distance, 1e-9);
            ASSERT_LT((found[k].offset - expected[k].offset).abs().maxCoeff(), 1e-9);
          }
        }
      }
}

TEST(Neighbours, NearestEqualsBruteForce) {
  for (const Cloud& cloud : clouds())
    for (const auto method : {Neighbours::Method::all_pairs, Neighbours::Method::grid})
      for (const double radius : {0.05, 2.9})
        for (const std::size_t k : {1u, 10u}) {
          Neighbours near;
          Neighbours::Scratch scratch;
          near.build(cloud.pos, cloud.bounds, radius, method);
          for (Index i = 0; i < cloud.pos.rows(); ++i) {
            auto expected = brute_force(cloud, i, radius);
            std::stable_sort(expected.begin(), expected.end(), [](const Met& a, const Met& b) { return a.distance < b.distance; });
            expected.resize(std::min(k, expected.size()));
            for (double hint : {0.0, 0.1, 1e9}) {  // a wrong hint must not matter
              const auto found = near.nearest(i, k, radius, hint, scratch);
              ASSERT_EQ(found.size(), expected.size()) << cloud.name << ", radius " << radius << ", agent " << i;
              for (std::size_t m = 0; m < found.size(); ++m)
                ASSERT_NEAR(std::sqrt(found[m].distance2), expected[m].distance, 1e-9) << cloud.name;
            }
          }
        }
}

TEST(Neighbours, NearestBreaksTiesByRow) {
  Rows pos(5, 3);
  pos << 0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0;
  for (const auto method : {Neighbours::Method::all_pairs, Neighbours::Method::grid}) {
    Neighbours near;
    Neighbours::Scratch scratch;
    near.build(pos, {}, 3, method);
    double hint = 0;
    const auto found = near.nearest(0, 3, 3, hint, scratch);
    ASSERT_EQ(found.size(), 3u);
    for (std::size_t m = 0; m < 3; ++m) EXPECT_EQ(near.row(found[m].slot), static_cast<Index>(m) + 1);
    EXPECT_DOUBLE_EQ(hint, 1);
  }
}

// The sums of zonal models, with the lanes and the blocks that are filled up, against one neighbour after the other.
TEST(ZoneSums, EqualOneByOne) {
  for (const Cloud& cloud : clouds())
    for (const auto method : {Neighbours::Method::all_pairs, Neighbours::Method::grid}) {
      const double inner = 0.4, from = 0.9, to = 2.5;
      Neighbours near;
      near.build(cloud.pos, cloud.bounds, to, method);
      for (Index i = 0; i < cloud.pos.rows(); ++i) {
        ZoneSums expected;
        for (const Met& m : brute_force(cloud, i, to)) {
          if (m.distance < kCoincident) {
            ++expected.coincident;
          } else if (m.distance < inner) {
            expected.near += m.offset / m.distance;
            ++expected.near_count;
          } else if (m.distance >= from) {
            expected.far += m.offset / m.distance;
            ++expected.far_count;
          }
        }
        const ZoneSums sums = zone_sums(near, i, inner, from, to);
        ASSERT_EQ(sums.near_count, expected.near_count) << cloud.name << ", agent " << i;
        ASSERT_EQ(sums.far_count, expected.far_count);
        ASSERT_EQ(sums.coincident, expected.coincident);
        ASSERT_LT((sums.near - expected.near).abs().maxCoeff(), 1e-9);
        ASSERT_LT((sums.far - expected.far).abs().maxCoeff(), 1e-9);
      }
    }
}

TEST(ZoneSums, EdgesBelongWhereEq5PutsThem) {
  Rows pos(3, 3);
  pos << 0, 0, 0, 1, 0, 0, 2, 0, 0;
  Neighbours near;
  near.build(pos, {}, 2);
  EXPECT_EQ(zone_sums(near, 0, 1, 1, 2).near_count, 0);  // r < r_rep
  EXPECT_EQ(zone_sums(near, 0, 1, 1, 2).far_count, 2);   // r_ali <= r <= r_att
}

}  // namespace
}  // namespace swarmfit
