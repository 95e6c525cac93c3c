// SPDX-License-Identifier: MIT
// Small recordings for the tests of libeval.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "libtrack/rng.h"
#include "libtrack/tracks.h"

namespace swarmfit::test {

struct Row {
  std::uint32_t track;
  std::int64_t frame;
  std::array<double, 3> p;
  std::array<double, 3> v = {0, 0, 0};
};

struct Settings {
  double dt = 0.1;
  int dims = 3;
  bool velocity = false;  // keep the rows' v as recorded velocities
  std::vector<std::int64_t> episodes = {};
};

inline Tracks tracks_of(const std::vector<Row>& rows, const Settings& settings = {}) {
  TrackColumns c;
  const auto n = static_cast<Index>(rows.size());
  c.pos.resize(n, 3);
  if (settings.velocity) c.vel.resize(n, 3);
  c.episodes = settings.episodes;
  for (Index i = 0; i < n; ++i) {
    const Row& row = rows[static_cast<std::size_t>(i)];
    while (c.names.size() <= row.track) c.names.push_back(std::to_string(c.names.size()));
    c.track.push_back(row.track);
    c.frame.push_back(row.frame);
    for (Index axis = 0; axis < 3; ++axis) {
      c.pos(i, axis) = row.p[static_cast<std::size_t>(axis)];
      if (settings.velocity) c.vel(i, axis) = row.v[static_cast<std::size_t>(axis)];
    }
  }
  TrackMeta meta;
  meta.dims = settings.dims;
  meta.dt = settings.dt;
  meta.unit = "mm";
  return Tracks(std::move(c), std::move(meta));
}

// `individuals` paths of `frames` frames; path(individual, time) is a position.
using Path = std::function<std::array<double, 3>(std::uint32_t, double)>;
inline std::vector<Row> rows_of(std::uint32_t individuals, std::int64_t frames, double dt, const Path& path) {
  std::vector<Row> rows;
  for (std::int64_t k = 0; k < frames; ++k)
    for (std::uint32_t i = 0; i < individuals; ++i) rows.push_back({i, k, path(i, static_cast<double>(k) * dt)});
  return rows;
}

// Standard normal numbers by number.
inline double normal(std::uint64_t seed, std::uint64_t tick, std::uint32_t id, std::uint32_t draw = 0) {
  return Rng{seed}.normal2(Stream::probe, tick, id, draw)[0];
}

inline double uniform(std::uint64_t seed, std::uint64_t tick, std::uint32_t id, std::uint32_t draw = 0) {
  return Rng{seed}.uniform(Stream::probe, tick, id, draw);
}

// Insects that orbit on smooth Lissajous curves, each with its own frequencies (below `highest` [1/s]) and phases.
inline std::array<double, 3> orbit(std::uint64_t seed, double radius, double highest, std::uint32_t i, double t) {
  std::array<double, 3> p{};
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const double f = highest * (0.4 + 0.6 * uniform(seed, 0, i, axis)), phase = 6.28 * uniform(seed, 1, i, axis);
    p[axis] = radius * std::sin(6.283185307179586 * f * t + phase);
  }
  return p;
}

// Particles with random accelerations in a harmonic trap: motion that is rough from frame to frame.
inline std::vector<Row> trapped(std::uint64_t seed, std::uint32_t individuals, std::int64_t frames, const Settings& settings,
                                double noise = 400) {
  std::vector<Row> rows;
  std::vector<std::array<double, 6>> state(individuals);
  for (std::uint32_t i = 0; i < individuals; ++i)
    for (std::uint32_t a = 0; a < 6; ++a) state[i][a] = (a < 3 ? 60 : 150) * normal(seed, 0, i, a);
  for (std::int64_t k = 0; k < frames; ++k)
    for (std::uint32_t i = 0; i < individuals; ++i) {
      auto& s = state[i];
      for (std::uint32_t a = 0; a < 3; ++a) {
        if (settings.dims == 2 && a == 2) s[2] = 0, s[5] = 0;
        s[a + 3] += (-6 * s[a] - 0.5 * s[a + 3]) * settings.dt;
        if (a < static_cast<std::uint32_t>(settings.dims))
          s[a + 3] += noise * std::sqrt(settings.dt) * normal(seed, static_cast<std::uint64_t>(k) + 1, i, a);
        s[a] += s[a + 3] * settings.dt;
      }
      rows.push_back({i, k, {s[0], s[1], s[2]}, {s[3], s[4], s[5]}});
    }
  return rows;
}

}  // namespace swarmfit::test
