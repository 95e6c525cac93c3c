// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include "libeval/metrics.h"
#include "tests/eval/build.h"

namespace swarmfit {
namespace {

using test::Row;
using testing::ElementsAre;

// Straight from the definition.
Nearest brute_force(const Tracks& tracks) {
  const auto n = static_cast<std::size_t>(tracks.rows());
  Nearest out{std::vector<Index>(n, -1), std::vector<double>(n, std::numeric_limits<double>::infinity())};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      if (i == j || tracks.frame()[i] != tracks.frame()[j]) continue;
      const auto a = static_cast<Index>(i), b = static_cast<Index>(j);
      const double d = (tracks.pos().row(a) - tracks.pos().row(b)).matrix().norm();
      if (d < out.distance[i]) out.distance[i] = d, out.row[i] = b;
    }
  return out;
}

void expect_equal_to_brute_force(const Tracks& tracks) {
  const Nearest want = brute_force(tracks);
  for (const auto method : {NearestMethod::automatic, NearestMethod::all_pairs, NearestMethod::tree}) {
    const Nearest got = nearest_neighbours(tracks, method);
    EXPECT_EQ(got.row, want.row);
    EXPECT_THAT(got.distance, testing::Pointwise(testing::DoubleEq(), want.distance));
  }
}

TEST(Nearest, RandomClouds) {
  std::vector<Row> rows;
  const std::array<std::uint32_t, 5> sizes = {1, 2, 3, 40, 700};
  for (std::uint32_t k = 0; k < sizes.size(); ++k)
    for (std::uint32_t i = 0; i < sizes[k]; ++i)
      rows.push_back({i, k, {test::normal(1, k, i, 0), test::normal(1, k, i, 1), test::normal(1, k, i, 2)}});
  expect_equal_to_brute_force(test::tracks_of(rows));
}

// Every point has many neighbours at exactly the same distance, and some points coincide.
TEST(Nearest, TiesGoToTheLowestTrack) {
  std::vector<Row> rows;
  std::uint32_t id = 0;
  for (int x = 0; x < 9; ++x)
    for (int y = 0; y < 9; ++y)
      for (int z = 0; z < 6; ++z) rows.push_back({id++, 0, {1.0 * x, 1.0 * y, 1.0 * z}});
  for (int x = 0; x < 5; ++x) rows.push_back({id++, 0, {1.0 * x, 2, 3}});
  expect_equal_to_brute_force(test::tracks_of(rows));
}

TEST(Nearest, TieByHand) {
  const auto tracks = test::tracks_of({{3, 0, {1, 0, 0}}, {2, 0, {0, 0, 0}}, {7, 0, {-1, 0, 0}}});  // rows sorted by track: 2, 3, 7
  for (const auto method : {NearestMethod::all_pairs, NearestMethod::tree}) {
    const Nearest n = nearest_neighbours(tracks, method);
    EXPECT_THAT(n.row, ElementsAre(1, 0, 0));
    EXPECT_THAT(n.distance, ElementsAre(1, 1, 1));
  }
}

TEST(Nearest, EverybodyInOnePlace) {
  std::vector<Row> rows;
  for (std::uint32_t i = 0; i < 300; ++i) rows.push_back({i, 0, {1, 2, 3}});
  expect_equal_to_brute_force(test::tracks_of(rows));
}

// Clumps of many, pairs, and individuals alone; also places so near that the square of their distance is 0.
TEST(Nearest, ManyInAFewPlaces) {
  std::vector<Row> rows;
  for (std::uint32_t i = 0; i < 900; ++i)
    rows.push_back({i, 0, {i % 3 == 0 ? 1.0 : i % 3 == 1 ? std::floor(i / 6.0) : test::normal(3, 0, i, 0), i % 2 ? 2.0 : 0.5, 3}});
  for (std::uint32_t i = 0; i < 300; ++i) rows.push_back({i, 1, {i * 1e-200, 0, 0}});
  expect_equal_to_brute_force(test::tracks_of(rows));
}

TEST(Nearest, PlanarAndFarFromTheOrigin) {
  std::vector<Row> rows;
  for (std::uint32_t i = 0; i < 500; ++i) rows.push_back({i, 0, {1e6 + test::uniform(2, 0, i, 0), -1e6 + test::uniform(2, 0, i, 1), 0}});
  expect_equal_to_brute_force(test::tracks_of(rows, {.dims = 2}));
}

TEST(Nearest, NobodyElse) {
  const Nearest n = nearest_neighbours(test::tracks_of({{0, 0, {0, 0, 0}}, {0, 1, {0, 0, 0}}, {1, 2, {0, 0, 0}}}));
  EXPECT_THAT(n.row, ElementsAre(-1, -1, -1));
  EXPECT_THAT(n.distance, testing::Each(std::numeric_limits<double>::infinity()));
}

}  // namespace
}  // namespace swarmfit
