// SPDX-License-Identifier: MIT
// Cleaning of whole recordings: each step is one function, leaves a note in meta().from.notes, and changes nothing else.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "libtrack/tracks.h"

namespace swarmfit {

// What lengths are multiplied by: "0.05", "0.05,0.06" (x, y), "0.05mm/px" (from px to mm).
struct Scale {
  std::array<double, 3> factor = {1, 1, 1};
  std::string from{}, to{};  // units; empty: the unit stays what it is
};
Scale parse_scale(const std::string& text);  // throws InputError "'text' is ...; expected ..."

// "10", or "10,20" and "10,20,30" per axis: edges of a periodic box, each > 0. Throws as parse_scale().
std::array<double, 3> parse_box(const std::string& text);

// Periodic boundaries undone: from one row of an individual to its next, no coordinate changes by more than half an edge.
Tracks unwrap(const Tracks& tracks, const std::array<double, 3>& box);

// Where an individual moves faster than `speed` [unit/s] between two rows, gaps included, its track ends, and another begins: 7, then
// 7-2, 7-3, ... speed > 0.
Tracks cut_jumps(const Tracks& tracks, double speed);

// Positions, recorded velocities and accelerations times the factors. Throws InputError when the recording is not in scale.from.
Tracks scaled(const Tracks& tracks, const Scale& scale);

// y becomes -y, as it takes for images, whose y points down.
Tracks flip_y(const Tracks& tracks);

// Frames whose number is a multiple of `stride` away from the first one; the frame interval is so much longer, and frame numbers count in
// it, from 0 at the first frame. stride >= 1.
Tracks thin(const Tracks& tracks, int stride);

// The individuals of these names only. Throws InputError naming those that are there.
Tracks only(const Tracks& tracks, const std::vector<std::string>& names);

// Those with more than so many rows. Throws InputError when nobody is left.
Tracks longer_than(const Tracks& tracks, std::int64_t rows);

// Steps of cleaning, in the order in which clean() does them; the defaults do nothing.
struct Cleaning {
  std::array<double, 3> box{};  // 0: not periodic
  double fastest = 0;           // [unit/s] cut_jumps
  Scale scale{};
  bool flip = false;
  int stride = 1;
  std::vector<std::string> individuals{};
  std::int64_t longer_than = 0;
};
Tracks clean(Tracks tracks, const Cleaning& how);

}  // namespace swarmfit
