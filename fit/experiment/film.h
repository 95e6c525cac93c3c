// SPDX-License-Identifier: MIT
// What a page plays: the first frames of a recording, and the same frames of one simulation of every model.
#pragma once

#include <tuple>
#include <vector>

#include "libtrack/tracks.h"

namespace swarmfit {

// Frame numbers [first, last), in the recording's numbering.
struct FilmSpan {
  std::int64_t first = 0, last = 0;
};

inline constexpr std::size_t kFilmFrames = 600;  // at most
inline constexpr Index kFilmPoints = 500000;     // at most, in all films of a page together; some 6 bytes each in the page

// The longest span from the recording's first frame on that keeps both limits, `films` tracks of the recording's size being shown; one
// frame at least; cut() then makes a film. Every frame is in it: who judges motion by eye wants to see it at its own frame interval, not a
// quick run through all of it. Empty for tracks without rows.
FilmSpan film_span(const Tracks& recording, std::size_t films);

// The frames of a span, as bytes can hold them: x, y and z one after the other.
struct FilmStrip {
  std::vector<std::uint32_t> track;
  std::vector<std::int64_t> frame;
  std::vector<double> pos, vel;
  std::vector<std::uint8_t> kind;
};
inline auto fields(FilmStrip& f) { return std::tie(f.track, f.frame, f.pos, f.vel, f.kind); }

FilmStrip strip_of(const Tracks& tracks, const FilmSpan& span);
// As tracks of a simulation of this recording.
Tracks film_of(FilmStrip strip, const Tracks& recording);

}  // namespace swarmfit
