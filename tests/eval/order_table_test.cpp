// SPDX-License-Identifier: MIT
// Order parameters: closed forms and exact limits.
#include "libeval/group/order_table.h"

#include <gmock/gmock.h>

#include <numbers>
#include <set>

#include "libeval/group/components.h"
#include "libeval/group/curves.h"
#include "libeval/group/series_mean.h"
#include "libeval/order.h"
#include "libtrack/error.h"
#include "tests/eval/build.h"

namespace swarmfit {
namespace {

using test::Row;
using test::tracks_of;
using testing::Each;
using testing::ElementsAre;
constexpr double kPi = std::numbers::pi;

std::vector<double> series(const Tracks& tracks, const char* key, double link = 0) {
  MomentOptions options = moment_options(tracks);
  options.link = link;
  return order_record(tracks, options, {find_order_parameter(key)}).values(0);
}
double first(const Tracks& tracks, const char* key, double link = 0) { return series(tracks, key, link).front(); }

// n individuals on a circle about (5, -2), every other one in the opposite sense if `undirected`, turning by `angle` per frame.
Tracks ring(std::uint32_t n, double angle, bool undirected, int dims = 2) {
  return tracks_of(test::rows_of(n, 3, 1,
                                 [&](std::uint32_t i, double t) {
                                   const double sense = undirected && i % 2 == 1 ? -1 : 1, phi = 2 * kPi * i / n + sense * angle * t;
                                   return std::array{5 + 3 * std::cos(phi), -2 + 3 * std::sin(phi), dims == 3 ? 1.0 : 0.0};
                                 }),
                   {.dt = 0.5, .dims = dims});
}

TEST(OrderTable, NamesEverythingOnceAndSaysWhatItIs) {
  std::set<std::string_view> keys;
  for (const OrderParameter& p : order_table()) {
    EXPECT_TRUE(keys.insert(p.key).second) << p.key;
    EXPECT_FALSE(p.name.empty() || p.symbol.empty() || p.meaning.empty()) << p.key;
    EXPECT_EQ(find_order_parameter(p.key), &p);
  }
  EXPECT_EQ(order_parameters_named({"all"}).size(), order_table().size());
  EXPECT_EQ(order_parameters_named({"extent", "usual", "extent"}).front()->key, "extent");
  EXPECT_THROW(order_parameters_named({"order"}), InputError);
}

// The mill of Strömbom 2011 with its long steps: with r at mid-points Ma is 1 for every step, with r at the start cos(phi/2).
TEST(OrderTable, AMillRotatesFullyWhateverItsSteps) {
  for (const double phi : {0.01, 0.5, 1.7}) {
    const Tracks directed = ring(12, phi, false), undirected = ring(12, phi, true);
    EXPECT_NEAR(first(directed, "net_rotation"), 1, 1e-12);
    EXPECT_NEAR(first(directed, "rotation"), 1, 1e-12);
    EXPECT_NEAR(first(directed, "milling"), std::cos(phi / 2), 1e-12);
    EXPECT_NEAR(first(undirected, "net_rotation"), 0, 1e-12);
    EXPECT_NEAR(first(undirected, "rotation"), 1, 1e-12);
    EXPECT_NEAR(first(undirected, "polarisation"), 0, 1e-12);
    EXPECT_NEAR(first(undirected, "angular_speed"), phi / 0.5, 1e-12);
    EXPECT_NEAR(first(undirected, "speed"), 2 * 3 * std::sin(phi / 2) / 0.5, 1e-12);
    EXPECT_NEAR(first(directed, "group_speed"), 0, 1e-12);
    EXPECT_NEAR(first(directed, "extent"), 3, 1e-12);
    EXPECT_NEAR(first(directed, "median_radius"), 3, 1e-12);
    EXPECT_NEAR(first(directed, "axis_ratio"), 1, 1e-12);
    EXPECT_EQ(first(directed, "core"), 0);
    // a = v²/r on the chord: 2 r (1 - cos phi) / dt² inwards
    EXPECT_NEAR(series(directed, "radial_force")[1], -2 * 3 * (1 - std::cos(phi)) / 0.25, 1e-11);
  }
  EXPECT_NEAR(first(ring(12, 0.4, false, 3), "net_rotation"), 1, 1e-12);
}

TEST(OrderTable, ALineIsThinAndItsTurnIsItsRate) {
  for (const double rate : {0.3, -0.2}) {
    const Tracks line = tracks_of(test::rows_of(7, 2, 0.5,
                                                [&](std::uint32_t i, double t) {
                                                  const double s = i - 3.0;
                                                  return std::array{s * std::cos(rate * t) + t, s * std::sin(rate * t), 0.0};
                                                }),
                                  {.dt = 0.5, .dims = 2});
    EXPECT_NEAR(first(line, "axis_ratio"), 0, 1e-12);
    EXPECT_NEAR(first(line, "axis_turn"), rate, 1e-9);
  }
  // Four abreast and two deep, flying along x: sd across over along is sqrt(5/4) / (1/2).
  std::vector<Row> rows;
  for (std::uint32_t i = 0; i < 8; ++i)
    for (std::int64_t k = 0; k < 2; ++k) rows.push_back({i, k, {1.0 * (i % 2) + 3.0 * static_cast<double>(k), 1.0 * (i / 2), 0}});
  EXPECT_NEAR(first(tracks_of(rows, {.dims = 2}), "elongation"), 0.5 / std::sqrt(1.25), 1e-12);
}

TEST(OrderTable, FigureOfEightRotatesInOppositeSenses) {
  const auto eight = [](double sense) {
    return tracks_of(test::rows_of(16, 2, 0.1,
                                   [&](std::uint32_t i, double t) {
                                     const bool right = i >= 8;
                                     const double phi = 2 * kPi * i / 8 + (right ? sense : 1) * t;
                                     return std::array{(right ? 3 : -3) + std::cos(phi), std::sin(phi), 0.0};
                                   }),
                     {.dims = 2});
  };
  EXPECT_NEAR(first(eight(-1), "halves"), -1, 1e-12);
  EXPECT_NEAR(first(eight(1), "halves"), 1, 1e-12);
}

TEST(OrderTable, NeighboursAheadAndAbreast) {
  // In file along x the last has its neighbour ahead, the first behind; those between see the lower number: behind.
  std::vector<Row> file, rank;
  for (std::uint32_t i = 0; i < 4; ++i)
    for (std::int64_t k = 0; k < 2; ++k) {
      file.push_back({i, k, {-1.0 * i + static_cast<double>(k), 0, 0}});
      rank.push_back({i, k, {static_cast<double>(k), 1.0 * i, 0}});
    }
  EXPECT_NEAR(first(tracks_of(file, {.dims = 2}), "ahead"), 0.5, 1e-12);  // three ahead, one behind
  EXPECT_NEAR(first(tracks_of(file, {.dims = 2}), "abreast"), 0, 1e-12);
  EXPECT_NEAR(first(tracks_of(rank, {.dims = 2}), "abreast"), 1, 1e-12);
  EXPECT_NEAR(first(tracks_of(rank, {.dims = 2}), "ahead"), 0, 1e-12);
}

TEST(OrderTable, LanesAndCheckerboard) {
  const auto crowd = [](bool lanes) {
    std::vector<Row> rows;
    for (std::uint32_t i = 0; i < 36; ++i)
      for (std::int64_t k = 0; k < 2; ++k) {
        const std::uint32_t x = i % 6, y = i / 6;
        const double sense = (lanes ? y / 3 : x + y) % 2 == 0 ? 1 : -1;
        rows.push_back({i, k, {x + 0.1 * sense * static_cast<double>(k), 1.0 * y + (y >= 3 && lanes ? 1 : 0), 0}});
      }
    return tracks_of(rows, {.dims = 2});
  };
  EXPECT_NEAR(first(crowd(true), "lanes"), 1, 1e-12);
  EXPECT_LT(first(crowd(false), "lanes"), 0.02);
}

TEST(OrderTable, MixingCountsChangesOfTheNearest) {
  // 0 and 1 are near; in the next frame 1 has gone over to 2, so that everybody but 0 has another nearest, and 0 still has 1.
  const std::vector<Row> rows = {{0, 0, {0, 0, 0}}, {1, 0, {1, 0, 0}}, {2, 0, {10, 0, 0}},
                                 {0, 1, {0, 0, 0}}, {1, 1, {9, 0, 0}}, {2, 1, {10, 0, 0}}};
  EXPECT_NEAR(first(tracks_of(rows, {.dt = 0.5, .dims = 2}), "mixing"), 1 / 3.0 / 0.5, 1e-12);
}

TEST(OrderTable, PartsAndTheLargest) {
  std::vector<Row> rows;
  for (std::uint32_t i = 0; i < 10; ++i) rows.push_back({i, 0, {1.0 * i + (i >= 6 ? 5 : 0) + (i == 9 ? 5 : 0), 0, 0}});
  const Tracks tracks = tracks_of(rows, {.dims = 2});
  EXPECT_EQ(first(tracks, "parts", 1.5), 2);  // six, three, and one alone, who is no part
  EXPECT_EQ(first(tracks, "largest", 1.5), 0.6);
  EXPECT_EQ(first(tracks, "parts", 7), 1);
  EXPECT_EQ(first(tracks, "largest", 7), 1);
}

TEST(Components, TreeAndAllPairsAgreeAndCountTheBruteWay) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Rows p(600, 3);
    for (Index i = 0; i < p.rows(); ++i)
      for (Index a = 0; a < 3; ++a)
        p(i, a) = a == 2 && seed % 2 == 0 ? 0 : test::uniform(seed, 0, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(a));
    const double link = seed % 2 == 0 ? 0.045 : 0.1;
    const auto tree = connected(p, link, Eigen::Array3d::Zero(), LinkMethod::tree),
               pairs = connected(p, link, Eigen::Array3d::Zero(), LinkMethod::all_pairs);
    EXPECT_EQ(tree.of, pairs.of);
    EXPECT_EQ(tree.size, pairs.size);
    EXPECT_GT(tree.size.size(), 2U);
    EXPECT_GT(tree.size.front(), 10);
    // Twin: spread the lowest number along links until nothing changes.
    std::vector<int> label(600);
    for (int i = 0; i < 600; ++i) label[static_cast<std::size_t>(i)] = i;
    for (bool changed = true; changed;) {
      changed = false;
      for (Index i = 0; i < 600; ++i)
        for (Index j = 0; j < 600; ++j) {
          int &a = label[static_cast<std::size_t>(i)], b = label[static_cast<std::size_t>(j)];
          if (b < a && (p.row(i) - p.row(j)).matrix().norm() < link) a = b, changed = true;
        }
    }
    for (std::size_t i = 0; i < 600; ++i)
      for (std::size_t j = 0; j < 600; ++j) ASSERT_EQ(label[i] == label[j], pairs.of[i] == pairs.of[j]);
  }
}

TEST(Moment, GoesTheShortWayRoundAPeriodicBox) {
  MomentOptions options;
  options.dims = 2;
  options.period = {10, 10, 0};
  options.link = 1.5;
  OrderRecord record(order_parameters_named({"extent", "speed", "nearest", "largest", "polarisation"}));
  MomentStream stream(options, [&](const Moment& m) { record.add(m); });
  const std::vector<std::uint32_t> id{0, 1};
  const std::vector<std::uint8_t> kind{0, 0};
  Rows a(2, 3), b(2, 3);
  a << 9.5, 5, 0, 0.5, 5, 0;
  b << 0.0, 5, 0, 1.0, 5, 0;
  stream.frame({0, id, kind, a, a});
  stream.frame({1, id, kind, b, b});
  stream.finish();
  EXPECT_NEAR(record.values("extent")[0], 0.5, 1e-9);
  EXPECT_NEAR(record.values("speed")[0], 0.5, 1e-9);
  EXPECT_NEAR(record.values("nearest")[0], 1, 1e-9);
  EXPECT_EQ(record.values("largest")[0], 1);
  EXPECT_NEAR(record.values("polarisation")[0], 1, 1e-12);
}

// A stream whose rows change places, and lose and gain individuals, gives what the recording gives.
TEST(Moment, FollowsIdsNotRows) {
  const auto rows = test::rows_of(5, 4, 0.1, [](std::uint32_t i, double t) { return test::orbit(3, 10, 1, i, t); });
  const Tracks tracks = tracks_of(rows);
  OrderRecord turned(order_parameters_named({"all"}));
  MomentStream stream(moment_options(tracks), [&](const Moment& m) { turned.add(m); });
  for (std::int64_t k = 0; k < 4; ++k) {
    Rows pos(5, 3);
    std::vector<std::uint32_t> id;
    for (std::uint32_t i = 0; i < 5; ++i) {
      const std::uint32_t who = (i + static_cast<std::uint32_t>(k)) % 5;
      id.push_back(who);
      for (Index a = 0; a < 3; ++a) pos(i, a) = rows[static_cast<std::size_t>(k) * 5 + who].p[static_cast<std::size_t>(a)];
    }
    stream.frame({k, id, {}, pos, pos});
  }
  stream.finish();
  const OrderRecord straight = order_record(tracks, moment_options(tracks), order_parameters_named({"all"}));
  for (std::size_t p = 0; p < straight.what().size(); ++p)
    for (std::size_t f = 0; f < 4; ++f) {
      const double x = straight.values(p)[f], y = turned.values(p)[f];
      EXPECT_TRUE(std::abs(x - y) < 1e-9 * (1 + std::abs(x)) || (std::isnan(x) && std::isnan(y)))
          << straight.what()[p]->key << x << ' ' << y;
    }
}

TEST(Moment, TakesNoStepIntoAnotherEpisodeOrAcrossAGap) {
  std::vector<Row> rows;
  for (const std::int64_t k : {0, 1, 2, 4, 5})
    for (std::uint32_t i = 0; i < 3; ++i) rows.push_back({i, k, {1.0 * static_cast<double>(k), 1.0 * i, 0}});
  const auto p = series(tracks_of(rows, {.dims = 2, .episodes = {2}}), "polarisation");
  EXPECT_THAT(
      p, ElementsAre(testing::DoubleNear(1, 1e-12), testing::IsNan(), testing::IsNan(), testing::DoubleNear(1, 1e-12), testing::IsNan()));
}

// A Poisson cloud in a large disc or ball. Nearest neighbours: mean 1/(2 sqrt(rho)) and 0.554 rho^(-1/3), Clark and Evans 1954; those near
// the edge have neighbours on one side only, which adds some per cent for 1 000 points. The tolerance is that and three standard errors.
TEST(OrderTable, PoissonCloudsAreAsFarApartAsTheyShouldBe) {
  for (const int dims : {2, 3}) {
    std::vector<Row> rows;
    for (std::int64_t k = 0; k < 20; ++k)
      for (std::uint32_t i = 0; i < 1000; ++i) {
        const auto t = static_cast<std::uint64_t>(k);
        const double r = std::pow(test::uniform(7, t, i, 0), 1.0 / dims), phi = 2 * kPi * test::uniform(7, t, i, 1),
                     z = dims == 3 ? 2 * test::uniform(7, t, i, 2) - 1 : 0, rho = std::sqrt(1 - z * z);
        rows.push_back({i, k, {10 * r * rho * std::cos(phi), 10 * r * rho * std::sin(phi), 10 * r * z}});
      }
    const Tracks cloud = tracks_of(rows, {.dims = dims});
    EXPECT_NEAR(mean_defined(series(cloud, "nearest_ratio")), dims == 2 ? 1.02 : 1.05, 0.03) << dims;
    EXPECT_NEAR(mean_defined(series(cloud, "nearest_cv")), dims == 2 ? 0.523 : 0.363, 0.02) << dims;
    EXPECT_NEAR(mean_defined(series(cloud, "core")), dims == 2 ? 0.125 : 0.0625, 0.006) << dims;
    EXPECT_THAT(series(cloud, "largest"), Each(testing::Ge(0.98))) << dims;  // by the automatic link a uniform cloud is one group
    for (const GroupCurve& c : group_curves(cloud, moment_options(cloud)).curves) {
      if (c.key != "g_r") continue;
      for (std::size_t b = 1; b < 25; ++b) EXPECT_NEAR(c.y[b], 1, 0.06) << dims << ' ' << c.x[b];
    }
  }
}

// Directions at random: Ma is 2/π in the plane and π/4 in space, and so is the mean sine of the nearest neighbour's bearing.
TEST(OrderTable, IsotropicHeadings) {
  for (const int dims : {2, 3}) {
    std::vector<Row> rows;
    for (std::int64_t k = 0; k < 200; ++k)
      for (std::uint32_t i = 0; i < 100; ++i) {
        std::array<double, 3> p{}, q{};
        for (std::uint32_t a = 0; a < static_cast<std::uint32_t>(dims); ++a) {
          p[a] = test::normal(1, static_cast<std::uint64_t>(k), i, a);
          q[a] = p[a] + 1e-3 * test::normal(2, static_cast<std::uint64_t>(k), i, a);
        }
        rows.push_back({i, 3 * k, p});
        rows.push_back({i, 3 * k + 1, q});
      }
    const Tracks tracks = tracks_of(rows, {.dims = dims});
    const double random = dims == 2 ? 2 / kPi : kPi / 4;
    EXPECT_NEAR(mean_defined(series(tracks, "rotation")), random, 0.006) << dims;  // sd 0.31 and 0.22 over sqrt(20 000), and a margin
    EXPECT_NEAR(mean_defined(series(tracks, "abreast")), random, 0.01) << dims;
    EXPECT_NEAR(mean_defined(series(tracks, "ahead")), 0, 0.02) << dims;
    EXPECT_NEAR(mean_defined(series(tracks, "net_rotation")), dims == 2 ? std::sqrt(0.5 * kPi / 4 / 100) : 0.0775, 0.008) << dims;
  }
}

// Particles in a harmonic trap dv = (-k r - v/τ) dt + noise: the mean acceleration at a distance r from the middle is -k r.
TEST(GroupCurves, HarmonicLangevinPullsInProportion) {
  const test::Settings settings{.dt = 0.02, .dims = 2};
  const Tracks tracks = tracks_of(test::trapped(5, 60, 3000, settings), settings);
  int seen = 0;
  for (const GroupCurve& c : group_curves(tracks, moment_options(tracks)).curves) {
    if (c.key == "radial_force") {
      for (std::size_t b = 3; b < 16; ++b) EXPECT_NEAR(c.y[b], -6 * c.x[b], 4 * c.se[b] + 0.06 * 6 * c.x[b]) << c.x[b];
    }
    if (c.key == "vacf") {
      EXPECT_NEAR(c.y.front(), 1, 1e-12);
    }
    if (c.key == "fluctuation_corr") {
      for (std::size_t b = 2; b < 16; ++b) EXPECT_NEAR(c.y[b], -1.0 / 59, 4 * c.se[b] + 0.005) << c.x[b];  // their mean is taken off
    }
    ++seen;
  }
  EXPECT_EQ(seen, 5);
}

// Two halves of a disc that fly in opposite directions: fluctuations agree nearby and disagree far off; half a radius apart they cross.
TEST(GroupCurves, CorrelationLengthOfTwoDomains) {
  std::vector<Row> rows;
  for (std::int64_t k = 0; k < 16; ++k)
    for (std::uint32_t i = 0; i < 200; ++i) {
      const double r = 10 * std::sqrt(test::uniform(9, 0, i, 0)), phi = 2 * kPi * test::uniform(9, 0, i, 1), x = r * std::cos(phi);
      rows.push_back({i, k, {x, r * std::sin(phi) + (x > 0 ? 1 : -1) * 1e-4 * static_cast<double>(k), 0}});
    }
  const Tracks tracks = tracks_of(rows, {.dims = 2});
  const GroupCurves curves = group_curves(tracks, moment_options(tracks));
  // Twin: the same sums over the first frame alone, pair by pair.
  std::vector<double> sum(30, 0), count(30, 0);
  double square = 0, mean = 0;
  std::vector<double> u;
  for (std::uint32_t i = 0; i < 200; ++i) u.push_back(rows[i].p[0] > 0 ? 1 : -1), mean += u.back() / 200;
  for (double& x : u) x -= mean, square += x * x / 200;
  double width = 0;
  for (const GroupCurve& c : curves.curves)
    if (c.key == "fluctuation_corr") {
      width = 2 * c.x.front();
    }
  for (std::size_t i = 0; i < 200; ++i)
    for (std::size_t j = i + 1; j < 200; ++j) {
      const auto b = static_cast<std::size_t>(std::hypot(rows[i].p[0] - rows[j].p[0], rows[i].p[1] - rows[j].p[1]) / width);
      if (b < 30) sum[b] += u[i] * u[j], ++count[b];
    }
  for (const GroupCurve& c : curves.curves)
    if (c.key == "fluctuation_corr") {
      for (std::size_t b = 1; b < 20; ++b) EXPECT_NEAR(c.y[b], sum[b] / count[b] / square, 0.02) << b;
    }
  EXPECT_GT(curves.correlation_length, 6);
  EXPECT_LT(curves.correlation_length, 11);
}

// The map: everybody flies along +y and has the neighbour one to the right or to the left of it, never ahead.
TEST(GroupCurves, NeighbourMapSeesWhoIsAbreast) {
  std::vector<Row> rows;
  for (std::int64_t k = 0; k < 4; ++k)
    for (std::uint32_t i = 0; i < 2; ++i) rows.push_back({i, k, {1.0 * i, static_cast<double>(k), 0}});
  const Tracks tracks = tracks_of(rows, {.dims = 2});
  const NeighbourMap map = group_curves(tracks, moment_options(tracks)).map;
  EXPECT_EQ(map.counted, 6);
  EXPECT_NEAR(map.left, 0.5, 1e-12);
  const auto at = [&](int x, int y) { return map.density[static_cast<std::size_t>(y * map.side + x)]; };
  EXPECT_NEAR(at(13, 10) + at(14, 10), 0.5 * 441, 1e-9);  // a third of the reach to the right: between two squares
  EXPECT_NEAR(at(6, 10) + at(7, 10), 0.5 * 441, 1e-9);
}

// First-order autoregressive series: correlation time (1 + a)/(1 - a), and intervals that cover the true mean about 95 times in 100.
TEST(SeriesMean, CoversTheMeanOfACorrelatedSeries) {
  for (const double a : {0.0, 0.8}) {
    int covered = 0;
    double time = 0;
    constexpr int kSeries = 400;
    for (int s = 0; s < kSeries; ++s) {
      std::vector<std::int64_t> frame;
      std::vector<double> x;
      double now = test::normal(11, static_cast<std::uint64_t>(s), 0) / std::sqrt(1 - a * a);
      for (int k = 0; k < 2000; ++k) {
        frame.push_back(k);
        x.push_back(3 + now);
        now = a * now + test::normal(12, static_cast<std::uint64_t>(k), static_cast<std::uint32_t>(s));
      }
      const SeriesMean m = series_mean(frame, x);
      covered += m.lower < 3 && 3 < m.upper;
      time += m.correlation_time / kSeries;
    }
    EXPECT_NEAR(time, (1 + a) / (1 - a), 0.1 * (1 + a) / (1 - a)) << a;
    EXPECT_GE(covered, 368) << a;  // 92 %: 95 % less three standard errors, but for the blocks' own correlation
    EXPECT_LE(covered, 394) << a;
  }
}

TEST(SeriesMean, SaysNothingOfTooShortASeries) {
  const std::vector<std::int64_t> frame{0, 1, 2, 3, 4};
  EXPECT_TRUE(std::isnan(series_mean(frame, std::vector<double>{1, 2, 3, 4, 5}).lower));
  EXPECT_EQ(series_mean(frame, std::vector<double>{1, 2, 3, 4, 5}).mean, 3);
  const SeriesMean same = series_mean(frame, std::vector<double>{2, 2, 2, 2, 2});
  EXPECT_EQ(same.sd, 0);
  EXPECT_TRUE(std::isnan(same.correlation_time));
  EXPECT_TRUE(std::isnan(series_mean({}, {}).mean));
}

}  // namespace
}  // namespace swarmfit
