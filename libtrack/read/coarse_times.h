// SPDX-License-Identifier: MIT
// Time stamps that are written more coarsely than the frames follow each other.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "libtrack/read/frame_clock.h"

namespace swarmfit {

// The step in which the times are written [s]: 60, 1, 0.1, 0.01 or 0.001; 0 when it is finer or none.
double written_step(std::span<const double> time);

// Whether rounding to `step` explains every difference between the times and frame * dt.
bool only_rounded(std::span<const double> time, std::span<const double> frame, double dt, double step);

// The clock behind times rounded to `step`, when the moments of the recording in their order – 60 Hz with two decimals is 0, 0.02, 0.03,
// 0.05 – lie on a constant interval but for rounding. Needs 20 moments, and an interval that is no multiple of the step.
std::optional<FrameClock> clock_behind_rounding(std::span<const double> time, double step);

// The same for a known interval, where moments may be missing.
std::optional<FrameClock> clock_behind_rounding(std::span<const double> time, std::span<const std::size_t> first, double step, double dt);

// Whether a fitted clock ticks in the step in which the times are written, although tracks mostly advance by other steps: what it calls
// gaps may be rounding.
bool ticks_like_rounding(const FrameClock& clock, std::span<const std::size_t> first, double step);

}  // namespace swarmfit
