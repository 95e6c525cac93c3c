// SPDX-License-Identifier: MIT
// Tracks in a form that a page can carry and its player unpack (assets/film.js).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "libtrack/tracks.h"

namespace swarmfit {

// Positions in 65 536 steps per axis of their own bounding box: no coordinate is off by more than half a step.
struct PackedFilm {
  int dims = 3;
  std::size_t rows = 0, runs = 0;         // a run: an individual over consecutive frames without a gap
  std::array<double, 3> lower{}, step{};  // coordinate = lower + step * code [unit]
  // Compressed by zlib; little-endian. First, per run, three 32-bit numbers: track, index of its first frame in the clock, length.
  // Then, per axis, the codes of all runs one after the other, each as its difference from the one before (a run starts at 0) modulo 2^16:
  // first the low bytes of all of them, then the high bytes, which compress better apart.
  // Last, where there are several kinds of individuals, one byte per point: its kind, in the order of the runs.
  std::string bytes;
};

// The frame numbers at which any of the films shows somebody, ascending: the clock that they are played by.
std::vector<std::int64_t> film_clock(const std::vector<const Tracks*>& films);

// Throws std::invalid_argument if a frame of the tracks is not in the clock, RunError if zlib fails.
PackedFilm pack(const Tracks& tracks, const std::vector<std::int64_t>& clock);

}  // namespace swarmfit
