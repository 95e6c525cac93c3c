// SPDX-License-Identifier: MIT
// The published time step of a model as a clock of its own. Rules that are stated per step ("turn by a random angle") mean something else
// when the step changes; here decisions fall at the multiples of an interval however finely a simulation steps between them.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "libswarm/model.h"

namespace swarmfit {

// How many of the times 0, interval, 2 interval, ... lie before t; a millionth of an interval is forgiven, since times are rounded.
inline std::int64_t decisions_before(double t, double interval) { return static_cast<std::int64_t>(std::ceil(t / interval - 1e-6)); }

// Random numbers that stay the same until the next decision: their tick in the step [t, t + dt), which may begin before 0.
inline std::uint64_t decision_tick(const StepContext& c, double interval) {
  constexpr std::uint64_t ticks = (std::uint64_t{1} << 48) - 1;  // what Rng takes
  return static_cast<std::uint64_t>(decisions_before(c.t + c.dt, interval)) & ticks;
}

// Number of the decision that falls into the step [t, t + dt), if any: the tick of its random numbers, so that these do not depend on the
// step either. With several in one step only the last is made. interval <= 0: one decision in every step.
inline std::optional<std::uint64_t> decision_due(const StepContext& c, double interval) {
  if (!(interval > 0)) return c.tick;
  constexpr std::uint64_t ticks = (std::uint64_t{1} << 48) - 1;  // what Rng takes
  const std::int64_t end = decisions_before(c.t + c.dt, interval);
  if (end <= decisions_before(c.t, interval)) return {};
  return static_cast<std::uint64_t>(end - 1) & ticks;
}

// Does the step end where the next decision is due?
inline bool interval_ends(const StepContext& c, double interval) {
  const auto reached = [&](double t) { return std::floor(t / interval + 1e-6); };
  return !(interval > 0) || reached(c.t + c.dt) > reached(c.t);
}

}  // namespace swarmfit
