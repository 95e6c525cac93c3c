// SPDX-License-Identifier: MIT
#include "reports/motion/film.h"

#include <gmock/gmock.h>
#include <zlib.h>

#include <cmath>
#include <map>

#include "libtrack/rng.h"

namespace swarmfit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TrackMeta meta_of(int dims) {
  TrackMeta meta;
  meta.dims = dims;
  meta.dt = 0.1;
  meta.unit = "m";
  return meta;
}

// (track, frame) of every row.
using Places = std::vector<std::pair<std::uint32_t, std::int64_t>>;

Tracks tracks_at(const Places& places, int dims, double size = 1, double offset = 0, std::vector<std::int64_t> episodes = {}) {
  TrackColumns c;
  c.names.resize(8);
  c.pos.setZero(static_cast<Index>(places.size()), 3);
  const Rng rng{7};
  for (std::size_t i = 0; i < places.size(); ++i) {
    c.track.push_back(places[i].first);
    c.frame.push_back(places[i].second);
    for (int axis = 0; axis < dims; ++axis)
      c.pos(static_cast<Index>(i), axis) = offset + size * rng.uniform(Stream::start, i, static_cast<std::uint32_t>(axis), 0);
  }
  c.episodes = std::move(episodes);
  return {std::move(c), meta_of(dims)};
}

// The player's own way back, written a second time and in another language.
struct Unpacked {
  struct Point {
    std::uint32_t track, at;
    std::array<double, 3> place;
  };
  std::vector<std::vector<Point>> runs;
};

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t out = 0;
  for (std::size_t k = 0; k < 4; ++k) out |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + k])) << (8 * k);
  return out;
}

std::string inflated(const PackedFilm& film) {
  const auto axes = static_cast<std::size_t>(film.dims);
  uLongf size = 12 * film.runs + 2 * axes * film.rows;
  std::string out(size, '\0');
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(film.bytes.data()), film.bytes.size()),
            Z_OK);
  EXPECT_EQ(size, out.size());
  return out;
}

Unpacked unpacked(const PackedFilm& film) {
  const std::string bytes = inflated(film);
  Unpacked out;
  for (std::size_t k = 0; k < film.runs; ++k) {
    out.runs.emplace_back();
    for (std::uint32_t j = 0; j < number_at(bytes, 12 * k + 8); ++j)
      out.runs.back().push_back({number_at(bytes, 12 * k), number_at(bytes, 12 * k + 4) + j, {}});
  }
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(film.dims); ++axis) {
    std::size_t low = 12 * film.runs + 2 * film.rows * axis;
    for (auto& run : out.runs) {
      std::uint16_t code = 0;
      for (auto& point : run) {
        code = static_cast<std::uint16_t>(code + static_cast<unsigned char>(bytes[low]) +
                                          256 * static_cast<unsigned char>(bytes[low + film.rows]));
        point.place[axis] = film.lower[axis] + film.step[axis] * code;
        ++low;
      }
    }
  }
  return out;
}

// Everybody where they were, to half a step, and nobody besides.
void expect_same(const Tracks& tracks, const std::vector<std::int64_t>& clock) {
  const PackedFilm film = pack(tracks, clock);
  std::map<std::pair<std::uint32_t, std::int64_t>, std::array<double, 3>> there;
  for (const auto& run : unpacked(film).runs)
    for (const auto& point : run) there[{point.track, clock.at(point.at)}] = point.place;
  ASSERT_EQ(there.size(), static_cast<std::size_t>(tracks.rows()));
  for (Index row = 0; row < tracks.rows(); ++row) {
    const auto at = static_cast<std::size_t>(row);
    const auto& place = there.at({tracks.track()[at], tracks.frame()[at]});
    for (int axis = 0; axis < tracks.dims(); ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const double rounding = 4e-16 * std::abs(tracks.pos()(row, axis));
      EXPECT_NEAR(place[a], tracks.pos()(row, axis), 0.5001 * film.step[a] + rounding) << row << ' ' << axis;
      EXPECT_LE(film.step[a], (tracks.pos().col(axis).maxCoeff() - tracks.pos().col(axis).minCoeff()) / 65535 * 1.0000001);
    }
  }
}

const Places kGappy = {{0, 3}, {1, 3}, {0, 4}, {1, 4}, {2, 4}, {0, 5}, {2, 5}, {0, 8}, {1, 8}, {2, 8}, {7, 9}, {1, 9}};

TEST(Film, ComesBackToHalfAStep) {
  for (const int dims : {2, 3})
    for (const double size : {1e-3, 1.0, 1e6})
      for (const double offset : {0.0, -5.0, 1e7}) {
        const Tracks tracks = tracks_at(kGappy, dims, size, offset);
        expect_same(tracks, film_clock({&tracks}));
      }
}

TEST(Film, RunsEndAtGapsAndTakes) {
  const auto lengths = [](const Tracks& tracks) {
    std::vector<std::size_t> out;
    for (const auto& run : unpacked(pack(tracks, film_clock({&tracks}))).runs) out.push_back(run.size());
    return out;
  };
  EXPECT_THAT(lengths(tracks_at(kGappy, 2)), ElementsAre(3, 1, 2, 2, 2, 1, 1));
  EXPECT_THAT(lengths(tracks_at({{0, 1}, {0, 2}, {0, 3}, {0, 4}}, 2, 1, 0, {3})), ElementsAre(2, 2));
}

TEST(Film, ClockHoldsTheFramesOfAllOnce) {
  const Tracks a = tracks_at({{0, 1}, {0, 2}, {0, 9}}, 2), b = tracks_at({{0, 2}, {0, 3}}, 2), nobody;
  EXPECT_THAT(film_clock({&a, &b, &nobody}), ElementsAre(1, 2, 3, 9));
  EXPECT_THAT(film_clock({&nobody}), IsEmpty());
  expect_same(b, film_clock({&a, &b}));
  EXPECT_THROW(pack(b, film_clock({&a})), std::invalid_argument);
}

TEST(Film, NobodyAndNoExtentAreFilmsToo) {
  const PackedFilm none = pack(Tracks(), {});
  EXPECT_EQ(none.rows, 0u);
  EXPECT_THAT(unpacked(none).runs, IsEmpty());
  const Tracks still = tracks_at({{0, 1}, {0, 2}}, 3, 0, 4);  // all in one place
  expect_same(still, film_clock({&still}));
}

// Smooth motion costs well under the two bytes of a coordinate.
TEST(Film, SmoothMotionIsSmall) {
  TrackColumns c;
  c.names.resize(50);
  c.pos.resize(50 * 400, 3);
  for (Index i = 0; i < c.pos.rows(); ++i) {
    const auto track = static_cast<std::uint32_t>(i / 400);
    const double t = static_cast<double>(i % 400);
    c.track.push_back(track);
    c.frame.push_back(i % 400);
    c.pos.row(i) << 100 * std::sin(0.02 * t + track), 100 * std::cos(0.03 * t), 50 * std::sin(0.01 * t * (1 + 0.1 * track));
  }
  const Tracks tracks(std::move(c), meta_of(3));
  EXPECT_LT(pack(tracks, film_clock({&tracks})).bytes.size(), static_cast<std::size_t>(tracks.rows()) * 5);
}

TEST(Film, EqualTracksGiveEqualBytes) {
  const Tracks tracks = tracks_at(kGappy, 3);
  EXPECT_EQ(pack(tracks, film_clock({&tracks})).bytes, pack(tracks, film_clock({&tracks})).bytes);
}

}  // namespace
}  // namespace swarmfit
