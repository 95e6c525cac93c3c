// SPDX-License-Identifier: MIT
// From time stamps to frame numbers.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace swarmfit {

// Times seen as multiples of a constant frame interval: time = t0 + frame * dt + deviation.
struct FrameClock {
  double dt = 0;                    // frame interval [s]
  double t0 = 0;                    // time of frame 0 [s], |t0| <= dt / 2: frame numbers are times rounded to the interval
  double deviation = 0;             // largest |deviation| [s]
  std::vector<std::int64_t> frame;  // one per time
  std::string problem;              // why there is no constant interval; empty: there is
};

// Time stamps that deviate from a constant interval by more than this fraction of it (root mean square, each individual
// against its own clock phase) have no constant interval.
inline constexpr double kLargestJitter = 0.2;

// Finds the frame interval of time stamps that may be rounded, jittered, have holes, and come from clocks with different phases.
// `time` is grouped by individual and ascends within each; individual k has [first[k], first[k + 1]).
//
// The median difference is the first guess; its half, third, ..., compete with it, for recordings where most frames were missed. It is
// refined by least squares of time on frame number over ever longer horizons – four frames, sixteen, ..., the whole recording – so that
// no rounding to a frame number has to bridge more time than the precision reached so far allows.
FrameClock fit_frame_clock(std::span<const double> time, std::span<const std::size_t> first);

// Least squares for the case that frame numbers are known.
FrameClock fit_known_frames(std::span<const double> time, std::span<const double> frame);

// Whether all times are whole numbers of frames that doubles count exactly.
bool countable(std::span<const double> time, double dt);

}  // namespace swarmfit
