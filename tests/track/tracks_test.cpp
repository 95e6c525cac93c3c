// SPDX-License-Identifier: MIT
#include "libtrack/tracks.h"

#include <gmock/gmock.h>

#include <map>

#include "libtrack/counting_sort.h"
#include "libtrack/rng.h"

namespace swarmfit {
namespace {

using testing::ElementsAre;

TrackMeta meta() { return {.dims = 3, .dt = 0.5, .t0 = 1, .unit = "m", .from = {}}; }

// Random rows in random order, frames possibly far apart so that both ways of sorting are used.
TrackColumns scattered(std::uint32_t tracks, std::int64_t frames, std::int64_t stride, std::uint64_t seed) {
  const Rng rng{seed};
  std::vector<std::pair<double, std::pair<std::int64_t, std::uint32_t>>> rows;
  for (std::int64_t f = 0; f < frames; ++f)
    for (std::uint32_t t = 0; t < tracks; ++t) {
      const auto u = rng.uniform2(Stream::probe, static_cast<std::uint64_t>(f), t);
      if (u[0] < 0.8) rows.push_back({u[1], {(f - 3) * stride, t}});
    }
  std::sort(rows.begin(), rows.end());
  TrackColumns c;
  for (std::uint32_t t = 0; t < tracks; ++t) c.names.push_back(std::to_string(t));
  c.pos.resize(static_cast<Index>(rows.size()), 3);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto [frame, track] = rows[i].second;
    c.frame.push_back(frame);
    c.track.push_back(track);
    c.pos.row(static_cast<Index>(i)) << static_cast<double>(frame), static_cast<double>(track), rows[i].first;
  }
  return c;
}

TEST(Tracks, EveryViewAgreesWithATableOfTheRows) {
  for (const std::int64_t stride : {std::int64_t{1}, std::int64_t{1'000'000'000'000}}) {
    auto columns = scattered(7, 60, stride, 5);
    columns.episodes = {20 * stride, 10 * stride};
    std::map<std::pair<std::int64_t, std::uint32_t>, double> table;
    for (std::size_t i = 0; i < columns.frame.size(); ++i)
      table[{columns.frame[i], columns.track[i]}] = columns.pos(static_cast<Index>(i), 2);
    const Tracks tracks(columns, meta());

    ASSERT_EQ(tracks.rows(), static_cast<Index>(table.size()));
    Index row = 0;
    for (const auto& [key, value] : table) {  // a map is sorted by (frame, track)
      const auto i = static_cast<std::size_t>(row);
      EXPECT_EQ(tracks.frame()[i], key.first);
      EXPECT_EQ(tracks.track()[i], key.second);
      EXPECT_EQ(tracks.pos()(row, 2), value);
      const auto next = table.find({key.first + 1, key.second});
      const bool cut = key.first + 1 == 10 * stride || key.first + 1 == 20 * stride;
      if (next == table.end() || cut) {
        EXPECT_EQ(tracks.next()[i], -1);
      } else {
        ASSERT_GE(tracks.next()[i], 0);
        EXPECT_EQ(tracks.pos()(tracks.next()[i], 2), next->second);
      }
      ++row;
    }
    Index seen = 0;
    for (const auto& frame : tracks.frames()) {
      EXPECT_EQ(frame.first, seen);
      for (Index i = frame.first; i < frame.first + frame.count; ++i) EXPECT_EQ(tracks.frame()[static_cast<std::size_t>(i)], frame.number);
      seen += frame.count;
    }
    EXPECT_EQ(seen, tracks.rows());
  }
}

TEST(Tracks, Faults) {
  const auto fails = [](auto change) {
    TrackColumns c = scattered(2, 5, 1, 1);
    TrackMeta m = meta();
    change(c, m);
    EXPECT_THROW(Tracks(c, m), std::invalid_argument);
  };
  fails([](auto& c, auto&) { c.frame.pop_back(); });
  fails([](auto& c, auto&) { c.kind.push_back(1); });
  fails([](auto& c, auto&) { c.vel = Rows::Zero(1, 3); });
  fails([](auto& c, auto&) { c.names.pop_back(); });
  fails([](auto& c, auto&) { c.pos(0, 1) = std::numeric_limits<double>::quiet_NaN(); });
  fails([](auto& c, auto&) { c.frame[1] = c.frame[0], c.track[1] = c.track[0]; });
  fails([](auto&, auto& m) { m.dims = 4; });
  fails([](auto&, auto& m) { m.dt = 0; });
}

TEST(Tracks, TimesAndEmptiness) {
  const Tracks tracks(scattered(2, 5, 1, 1), meta());
  EXPECT_EQ(tracks.time(4), 3);
  EXPECT_EQ(Tracks(TrackColumns{}, meta()).rows(), 0);
}

TEST(TrackCollector, CollectsWhatStreamsBy) {
  TrackCollector collector({"a"}, true);
  const std::vector<std::uint32_t> id = {2, 0};
  const std::vector<std::uint8_t> kind = {1, 0};
  Rows pos(2, 3), vel(2, 3);
  pos << 1, 2, 3, 4, 5, 6;
  vel << 7, 8, 9, 10, 11, 12;
  collector.frame({.frame = 5, .id = id, .kind = kind, .pos = pos, .vel = vel});
  const auto tracks = collector.take(meta());
  EXPECT_THAT(tracks.names(), ElementsAre("a", "1", "2"));
  EXPECT_EQ(tracks.pos()(0, 0), 4) << "sorted by individual";
  EXPECT_EQ(tracks.vel()(1, 2), 9);
  EXPECT_EQ(tracks.kind(1), 1);
  EXPECT_EQ(collector.take(meta()).rows(), 0) << "the collector is empty afterwards";
}

TEST(CountingSort, AgreesWithStableSort) {
  const Rng rng{9};
  for (const double range : {10.0, 3000.0, 1e15}) {
    std::vector<std::int64_t> key;
    for (std::uint32_t i = 0; i < 500; ++i) key.push_back(static_cast<std::int64_t>(range * (rng.uniform(Stream::probe, i, 0) - 0.5)));
    auto expected = identity_order<std::uint32_t>(key.size());
    std::stable_sort(expected.begin(), expected.end(), [&](auto a, auto b) { return key[a] < key[b]; });
    EXPECT_EQ(sorted_by(key, identity_order<std::uint32_t>(key.size())), expected);
  }
  const std::vector<std::int64_t> extremes = {std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int64_t>::min(), 0};
  EXPECT_THAT(sorted_by(extremes, identity_order<std::uint32_t>(3)), ElementsAre(1, 2, 0));
}

}  // namespace
}  // namespace swarmfit
