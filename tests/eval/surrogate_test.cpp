// SPDX-License-Identifier: MIT
#include "libeval/surrogate.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <set>

#include "libeval/centre.h"
#include "libtrack/kinematics.h"
#include "tests/eval/build.h"

namespace swarmfit {
namespace {

using test::Row;
using test::tracks_of;

// Lengths of all steps, sorted: what neither surrogate may change but at seams.
std::vector<double> step_lengths(const Tracks& t) {
  const Rows v = forward_velocity(t);
  std::vector<double> out;
  for (Index k = 0; k < v.rows(); ++k)
    if (std::isfinite(v(k, 0))) out.push_back(v.row(k).matrix().norm());
  std::sort(out.begin(), out.end());
  return out;
}

std::map<std::int64_t, Index> per_frame(const Tracks& t) {
  std::map<std::int64_t, Index> out;
  for (const FrameRange& f : t.frames()) out[f.number] = f.count;
  return out;
}

// They come and go, with gaps; every position tells its track and frame, and the group is too wide to count as travelling.
Tracks visitors(std::uint32_t individuals, std::int64_t frames) {
  std::vector<Row> rows;
  for (std::uint32_t i = 0; i < individuals; ++i) {
    const auto enter = static_cast<std::int64_t>(test::uniform(1, 0, i) * 0.6 * static_cast<double>(frames));
    const auto leave = enter + static_cast<std::int64_t>((0.2 + 0.2 * test::uniform(1, 1, i)) * static_cast<double>(frames));
    for (std::int64_t k = enter; k < leave; ++k)
      if (k != enter + 7) rows.push_back({i, k, {1000.0 * i, std::sin(0.1 * static_cast<double>(k)), static_cast<double>(k)}});
  }
  return tracks_of(rows);
}

TEST(Timeshift, EveryObservationOnceAndNothingAcrossTheSeam) {
  const Tracks tracks = visitors(20, 200);
  const Tracks shifted = timeshift(tracks, {5});
  ASSERT_EQ(shifted.rows(), tracks.rows());
  std::multiset<std::array<double, 3>> before, after;
  for (Index k = 0; k < tracks.rows(); ++k) {
    before.insert({tracks.pos()(k, 0), tracks.pos()(k, 1), tracks.pos()(k, 2)});
    after.insert({shifted.pos()(k, 0), shifted.pos()(k, 1), shifted.pos()(k, 2)});
  }
  EXPECT_EQ(before, after);
  // z is the recorded frame: a step that is not 1 would lead across a gap or the seam.
  for (Index k = 0; k < shifted.rows(); ++k) {
    const Index next = shifted.next()[static_cast<std::size_t>(k)];
    ASSERT_TRUE(next < 0 || shifted.pos()(next, 2) - shifted.pos()(k, 2) == 1) << k;
  }
  EXPECT_GE(shifted.frames().front().number, tracks.frames().front().number);
  EXPECT_LE(shifted.frames().back().number, tracks.frames().back().number);
}

TEST(Timeshift, OneShiftPerTrackAndDifferentOnes) {
  const Tracks tracks = visitors(20, 200);
  const Tracks shifted = timeshift(tracks, {5});
  const auto length = tracks.frames().back().number - tracks.frames().front().number + 1;
  std::map<double, std::set<std::int64_t>> shifts;  // x tells the track, z the recorded frame
  for (Index k = 0; k < shifted.rows(); ++k) {
    const auto by = shifted.frame()[static_cast<std::size_t>(k)] - static_cast<std::int64_t>(shifted.pos()(k, 2));
    shifts[shifted.pos()(k, 0)].insert((by + length) % length);
  }
  std::set<std::int64_t> different;
  for (const auto& [track, by] : shifts) {
    EXPECT_EQ(by.size(), 1u) << track;
    different.insert(by.begin(), by.end());
  }
  EXPECT_GT(different.size(), 15u);
}

// 60 tracks: with shifts by chance alone the numbers per frame would be off by about 3.5 (binomial); chosen ones stay nearer.
TEST(Timeshift, KeepsTheNumberPerFrame) {
  const Tracks tracks = visitors(60, 300);
  const auto before = per_frame(tracks);
  double squares = 0, frames = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    auto after = per_frame(timeshift(tracks, {seed}));
    for (const auto& [number, count] : before) squares += std::pow(static_cast<double>(after[number] - count), 2), ++frames;
  }
  EXPECT_LT(std::sqrt(squares / frames), 2.5);
}

TEST(Timeshift, StaysWithinItsEpisode) {
  std::vector<Row> rows;
  for (std::int64_t k = 0; k < 100; ++k)
    for (std::uint32_t i = 0; i < 3; ++i) rows.push_back({i, k, {k < 40 ? 0.0 : 1.0, static_cast<double>(k % 7), static_cast<double>(i)}});
  const Tracks shifted = timeshift(tracks_of(rows, {.episodes = {40}}), {3});
  for (Index k = 0; k < shifted.rows(); ++k) EXPECT_EQ(shifted.pos()(k, 0), shifted.frame()[static_cast<std::size_t>(k)] < 40 ? 0 : 1);
}

// A group that flies by: shifted in its own frame it stays together and as fast.
TEST(Timeshift, TravellingGroupStaysTogether) {
  const auto rows = test::rows_of(12, 200, 0.1, [](std::uint32_t i, double t) {
    auto p = test::orbit(4, 5, 0.3, i, t);
    p[0] += 30 * t;
    return p;
  });
  const Tracks tracks = tracks_of(rows), shifted = timeshift(tracks, {2});
  const auto before = centroids(tracks), after = centroids(shifted);
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t f = 0; f < before.size(); ++f) EXPECT_LT((before[f] - after[f]).matrix().norm(), 6) << f;
  const auto speeds = step_lengths(shifted);
  EXPECT_GT(speeds.front(), 15);
  EXPECT_LT(speeds.back(), 45);
}

TEST(Timeshift, SameSeedSameBitsOtherSeedOthers) {
  const Tracks tracks = visitors(10, 100);
  const Tracks a = timeshift(tracks, {1}), b = timeshift(tracks, {1}), c = timeshift(tracks, {2});
  EXPECT_TRUE((a.pos() == b.pos()).all());
  EXPECT_FALSE((a.pos() == c.pos()).all());
}

TEST(ShuffledWalker, KeepsStepLengthsAndDestroysMemoryOfDirection) {
  const auto rows = test::rows_of(20, 200, 0.02, [](std::uint32_t i, double t) { return test::orbit(6, 50, 0.4, i, t); });
  const Tracks tracks = tracks_of(rows, {.dt = 0.02}), walker = shuffled_walker(tracks, {1});
  EXPECT_THAT(step_lengths(walker), testing::Pointwise(testing::DoubleNear(1e-9), step_lengths(tracks)));
  // On smooth orbits the direction turns by hundredths of a radian per frame; without memory the mean angle is pi/2. 19 800 angles with a
  // standard deviation of 0.68 put the mean within 0.015 (3 standard errors).
  const auto turn = [](const Tracks& t) { return metric_samples(t).values[kAngularVelocity]; };
  double mean = 0;
  const auto omega = turn(walker);
  for (const double w : omega) mean += 0.02 * w / static_cast<double>(omega.size());
  EXPECT_NEAR(mean, 1.5708, 0.1);
  const auto smooth = turn(tracks);
  EXPECT_LT(0.02 * *std::max_element(smooth.begin(), smooth.end()), 1.0);
}

TEST(ShuffledWalker, StartsRunsWhereTheyStartedAndKeepsGaps) {
  const Tracks tracks = visitors(6, 100), walker = shuffled_walker(tracks, {1});
  ASSERT_EQ(walker.rows(), tracks.rows());
  EXPECT_TRUE(std::equal(walker.next().begin(), walker.next().end(), tracks.next().begin()));
  for_each_segment(
      tracks, 1, [&](std::span<const Index> run) { EXPECT_TRUE((walker.pos().row(run.front()) == tracks.pos().row(run.front())).all()); });
}

TEST(ShuffledWalker, RecordedVelocitiesAreTreatedAlike) {
  const Tracks tracks = tracks_of(test::trapped(1, 5, 50, {}), {.velocity = true}), walker = shuffled_walker(tracks, {1});
  Index moved = 0;
  for (Index k = 0; k < tracks.rows(); ++k) {
    EXPECT_NEAR(walker.vel().row(k).matrix().norm(), tracks.vel().row(k).matrix().norm(), 1e-9);
    moved += (walker.vel().row(k) - tracks.vel().row(k)).matrix().norm() > 1e-6;
  }
  EXPECT_GT(moved, tracks.rows() * 9 / 10);
}

TEST(ShuffledWalker, WhoRestsRests) {
  const Tracks still = tracks_of(test::rows_of(2, 5, 0.1, [](std::uint32_t i, double) { return std::array{1.0 * i, 0.0, 0.0}; }));
  EXPECT_TRUE((shuffled_walker(still, {1}).pos() == still.pos()).all());
}

TEST(ShuffledPlaces, EverybodyIsWhereItWasAtOtherTimes) {
  const Tracks tracks = visitors(10, 100), shuffled = shuffled_places(tracks, {1});
  ASSERT_EQ(shuffled.rows(), tracks.rows());
  EXPECT_TRUE(std::equal(shuffled.next().begin(), shuffled.next().end(), tracks.next().begin()));
  Index elsewhere = 0;
  for (std::uint32_t t = 0; t < tracks.track_count(); ++t) {
    std::multiset<std::array<double, 3>> before, after;
    for (const Index row : tracks.rows_of(t)) before.insert({tracks.pos()(row, 0), tracks.pos()(row, 1), tracks.pos()(row, 2)});
    for (const Index row : shuffled.rows_of(t)) {
      after.insert({shuffled.pos()(row, 0), shuffled.pos()(row, 1), shuffled.pos()(row, 2)});
      elsewhere += shuffled.pos()(row, 2) != tracks.pos()(row, 2);
    }
    EXPECT_EQ(before, after) << t;
  }
  EXPECT_GT(elsewhere, tracks.rows() * 9 / 10);
  EXPECT_TRUE((shuffled_places(tracks, {1}).pos() == shuffled.pos()).all());
  EXPECT_FALSE((shuffled_places(tracks, {2}).pos() == shuffled.pos()).all());
}

TEST(ShuffledPlaces, TravellingGroupStaysTogetherAndEpisodesApart) {
  const auto flight = test::rows_of(12, 200, 0.1, [](std::uint32_t i, double t) {
    auto p = test::orbit(4, 5, 0.3, i, t);
    p[0] += 30 * t;
    return p;
  });
  const Tracks tracks = tracks_of(flight), shuffled = shuffled_places(tracks, {2});
  const auto before = centroids(tracks), after = centroids(shuffled);
  for (std::size_t f = 0; f < before.size(); ++f) EXPECT_LT((before[f] - after[f]).matrix().norm(), 6) << f;
  std::vector<Row> takes;
  for (std::int64_t k = 0; k < 80; ++k) takes.push_back({0, k, {k < 40 ? 0.0 : 1.0, static_cast<double>(k), 0}});
  const Tracks apart = shuffled_places(tracks_of(takes, {.episodes = {40}}), {3});
  for (Index k = 0; k < apart.rows(); ++k) EXPECT_EQ(apart.pos()(k, 0), k < 40 ? 0 : 1);
}

TEST(ShuffledPlaces, RecordedVelocitiesGoWithTheirPlaces) {
  const Tracks tracks = tracks_of(test::trapped(1, 3, 50, {}), {.velocity = true}), shuffled = shuffled_places(tracks, {1});
  for (std::uint32_t t = 0; t < tracks.track_count(); ++t)
    for (const Index row : shuffled.rows_of(t)) {
      const auto rows = tracks.rows_of(t);
      const auto from =
          std::find_if(rows.begin(), rows.end(), [&](Index other) { return tracks.pos()(other, 0) == shuffled.pos()(row, 0); });
      ASSERT_NE(from, rows.end());
      EXPECT_TRUE((shuffled.vel().row(row) == tracks.vel().row(*from)).all());
    }
}

Histogram of(std::vector<std::uint64_t> counts) {
  Histogram h{std::move(counts), 0, 0};
  for (const auto n : h.counts) h.samples += n;
  return h;
}

TEST(SurrogateP, RankAmongAll) {
  const std::vector<Histogram> alike(19, of({50, 50}));
  EXPECT_DOUBLE_EQ(surrogate_p(of({90, 10}), alike), 0.05);
  EXPECT_DOUBLE_EQ(surrogate_p(of({50, 50}), alike), 1);
  EXPECT_THAT(surrogate_p(of({1, 1}), {}), testing::IsNan());
}

PerColumn<Histogram> columns(std::initializer_list<Histogram> of) { return of; }

// Out in one column and in between in the other: the sum decides.
TEST(SurrogateP, OfSeveralColumnsTogether) {
  const std::vector<PerColumn<Histogram>> alike(19, columns({of({50, 50}), of({50, 50}), of({0, 0})}));
  const auto odd = columns({of({90, 10}), of({50, 50}), of({0, 0})});
  EXPECT_DOUBLE_EQ(surrogate_p(odd, alike, {true, true, false}), 0.05);
  EXPECT_DOUBLE_EQ(surrogate_p(odd, alike, {false, true, false}), 1);
  EXPECT_DOUBLE_EQ(surrogate_p(odd, alike, {true, false, false}), surrogate_p(of({90, 10}), std::vector<Histogram>(19, of({50, 50}))));
  EXPECT_THAT(surrogate_p(odd, alike, {true, true, true}), testing::IsNan()) << "no samples in the third";
  EXPECT_THAT(surrogate_p(odd, alike, {false, false, false}), testing::IsNan());
  EXPECT_THAT(surrogate_p(odd, {}, {true, true, false}), testing::IsNan());
}

// Independent particles have nothing to lose by a shift: p is uniform on {1/20, ..., 1}. Of 60 recordings 12 are expected at p <= 0.2; the
// binomial probability of more than 22 is 0.001. Particles that keep a distance are found every time.
TEST(SurrogateP, HoldsItsLevelAndFindsRepulsion) {
  const auto p_of = [](const Tracks& tracks, std::uint64_t seed) {
    const Target target(metric_samples(tracks), Binning::standard(Normalisation::reference));
    std::vector<Histogram> surrogates;
    for (std::uint64_t k = 0; k < 19; ++k)
      surrogates.push_back(
          target.distributions(metric_samples(timeshift(tracks, Rng{seed}.derive(Stream::surrogate, k))))[kDistance].histogram);
    return surrogate_p(target.recording()[kDistance].histogram, surrogates);
  };
  int rejected = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const auto rows = test::rows_of(6, 60, 0.1, [&](std::uint32_t i, double t) { return test::orbit(100 + seed, 50, 1, i, t); });
    rejected += p_of(tracks_of(rows), seed) <= 0.2;
  }
  EXPECT_LE(rejected, 22);
  EXPECT_GE(rejected, 2);
  // On one orbit, evenly spaced in phase.
  const auto apart = test::rows_of(6, 60, 0.1, [](std::uint32_t i, double t) {
    const double phase = 6.283185307179586 * (i / 6.0 + 0.4 * t);
    return std::array{50 * std::cos(phase), 50 * std::sin(phase), 3.0 * std::sin(5 * phase)};
  });
  EXPECT_DOUBLE_EQ(p_of(tracks_of(apart), 1), 0.05);
}

TEST(GroupPath, FollowsTheGroupAndIgnoresWhoComesAndGoes) {
  std::vector<Row> rows;
  for (std::int64_t k = 0; k < 10; ++k) {
    for (std::uint32_t i = 0; i < 3; ++i) rows.push_back({i, k, {2.0 * static_cast<double>(k), 1.0 * i, 0}});
    if (k > 4) rows.push_back({3, k, {1000 + 2.0 * static_cast<double>(k), 0, 0}});
  }
  const auto path = group_path(tracks_of(rows));
  for (std::size_t k = 0; k < path.size(); ++k) EXPECT_NEAR(path[k][0], 2.0 * static_cast<double>(k), 1e-9);
  EXPECT_NEAR(centroids(tracks_of(rows))[5][0], 10 + 250, 1e-9);
}

}  // namespace
}  // namespace swarmfit
