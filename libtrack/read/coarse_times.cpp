// SPDX-License-Identifier: MIT
#include "libtrack/read/coarse_times.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace swarmfit {
namespace {

// Rounding puts a time at most half a step to either side; a little more where the interval is only estimated.
constexpr double kSlack = 1.1;

double spread(std::span<const double> time, std::span<const double> frame, double dt) {
  double low = time[0] - frame[0] * dt, high = low;
  for (std::size_t i = 1; i < time.size(); ++i) {
    const double rest = time[i] - frame[i] * dt;
    low = std::min(low, rest);
    high = std::max(high, rest);
  }
  return high - low;
}

}  // namespace

double written_step(std::span<const double> time) {
  for (const double per : {1.0 / 60, 1.0, 10.0, 100.0, 1000.0}) {
    const bool all = std::all_of(time.begin(), time.end(),
                                 [&](double t) { return std::abs(t * per - std::round(t * per)) <= 1e-6 + 4e-16 * std::abs(t * per); });
    if (all) return 1 / per;
  }
  return 0;
}

bool only_rounded(std::span<const double> time, std::span<const double> frame, double dt, double step) {
  return spread(time, frame, dt) <= step * (1 + 1e-6);
}

std::optional<FrameClock> clock_behind_rounding(std::span<const double> time, double step) {
  constexpr std::size_t least = 20;
  std::vector<double> moment(time.begin(), time.end());
  std::sort(moment.begin(), moment.end());
  moment.erase(std::unique(moment.begin(), moment.end()), moment.end());
  if (moment.size() < least) return std::nullopt;
  std::vector<double> index(moment.size());
  for (std::size_t i = 0; i < index.size(); ++i) index[i] = static_cast<double>(i);
  FrameClock clock = fit_known_frames(moment, index);
  if (!(clock.dt > 0) || spread(moment, index, clock.dt) > kSlack * step) return std::nullopt;
  const double ratio = clock.dt / step;
  if (std::abs(ratio - std::round(ratio)) * index.back() < 1) return std::nullopt;  // the steps are written as they are
  if (const double round = 1 / std::round(1 / clock.dt); only_rounded(moment, index, round, step)) {
    clock.t0 += (clock.dt - round) * index.back() / 2;
    clock.dt = round;
  }
  if (!countable(time, clock.dt)) return std::nullopt;
  clock.problem.clear();
  const double offset = std::round(clock.t0 / clock.dt);
  clock.t0 -= offset * clock.dt;
  clock.frame.clear();
  for (const double t : time)
    clock.frame.push_back(std::lower_bound(moment.begin(), moment.end(), t) - moment.begin() + static_cast<std::int64_t>(offset));
  clock.deviation = 0;
  for (std::size_t i = 0; i < time.size(); ++i)
    clock.deviation = std::max(clock.deviation, std::abs(time[i] - clock.t0 - static_cast<double>(clock.frame[i]) * clock.dt));
  return clock;
}

std::optional<FrameClock> clock_behind_rounding(std::span<const double> time, std::span<const std::size_t> first, double step, double dt) {
  if (!countable(time, dt)) return std::nullopt;
  FrameClock clock;
  clock.dt = dt;
  const double start = *std::min_element(time.begin(), time.end());
  std::vector<double> frame;
  for (const double t : time) frame.push_back(std::round((t - start) / dt));
  if (spread(time, frame, dt) > kSlack * std::max(step, dt / 2)) return std::nullopt;
  for (std::size_t k = 0; k + 1 < first.size(); ++k)
    for (std::size_t i = first[k] + 1; i < first[k + 1]; ++i)
      if (frame[i] == frame[i - 1] && time[i] != time[i - 1]) return std::nullopt;
  const double offset = std::round(start / dt);
  clock.t0 = start - offset * dt;
  for (std::size_t i = 0; i < time.size(); ++i) {
    clock.frame.push_back(static_cast<std::int64_t>(frame[i] + offset));
    clock.deviation = std::max(clock.deviation, std::abs(time[i] - start - frame[i] * dt));
  }
  return clock;
}

bool ticks_like_rounding(const FrameClock& clock, std::span<const std::size_t> first, double step) {
  if (step == 0 || std::abs(clock.dt / step - 1) > 1e-6) return false;
  std::size_t single = 0, few = 0, all = 0;
  for (std::size_t k = 0; k + 1 < first.size(); ++k)
    for (std::size_t i = first[k] + 1; i < first[k + 1]; ++i) {
      const auto advance = clock.frame[i] - clock.frame[i - 1];
      if (advance == 0) continue;
      ++all;
      if (advance == 1) ++single;
      if (advance <= 2) ++few;
    }
  return all >= 20 && 4 * single < 3 * all && 10 * few > 9 * all;
}

}  // namespace swarmfit
