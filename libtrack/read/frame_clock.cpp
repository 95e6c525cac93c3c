// SPDX-License-Identifier: MIT
#include "libtrack/read/frame_clock.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace swarmfit {
namespace {

using Times = std::vector<double>;  // of one individual, ascending

// Enough of the recording to know its interval: at most this many rows are looked at.
constexpr std::size_t kSampleRows = 50'000;

std::vector<Times> sample(std::span<const double> time, std::span<const std::size_t> first) {
  const std::size_t tracks = first.size() - 1;
  const std::size_t stride = std::max<std::size_t>(1, time.size() / kSampleRows);
  std::vector<Times> groups;
  for (std::size_t k = 0; k < tracks; k += std::min(stride, std::max<std::size_t>(1, tracks / 16))) {
    const auto rows = time.subspan(first[k], std::min(first[k + 1] - first[k], kSampleRows));
    if (!rows.empty()) groups.emplace_back(rows.begin(), rows.end());
  }
  return groups;
}

// Every individual cut into pieces of at most this duration.
std::vector<Times> pieces(const std::vector<Times>& groups, double duration) {
  std::vector<Times> out;
  for (const auto& group : groups) {
    for (std::size_t i = 0; i < group.size(); ++i) {
      if (i == 0 || group[i] - out.back().front() > duration) out.emplace_back();
      out.back().push_back(group[i]);
    }
  }
  return out;
}

// Times from all over the recording, ascending.
Times overview(std::span<const double> time) {
  const std::size_t stride = std::max<std::size_t>(1, time.size() / kSampleRows);
  Times all;
  for (std::size_t i = 0; i < time.size(); i += stride) all.push_back(time[i]);
  std::sort(all.begin(), all.end());
  return all;
}

Times differences(const std::vector<Times>& groups) {
  Times out;
  for (const auto& group : groups)
    for (std::size_t i = 1; i < group.size(); ++i)
      if (group[i] > group[i - 1]) out.push_back(group[i] - group[i - 1]);
  return out;
}

double lower_median(Times values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The phase against the lattice origin + k * dt that fits the times best, in (-dt/2, dt/2]: the circular mean.
double phase(std::span<const double> times, double origin, double dt) {
  std::complex<double> sum = 0;
  for (const double t : times) sum += std::polar(1.0, 2 * std::numbers::pi * std::remainder(t - origin, dt) / dt);
  return std::arg(sum) / (2 * std::numbers::pi) * dt;
}

// One step of refinement: every group gets its own phase, all share the slope of time on frame number.
double refined(const std::vector<Times>& groups, double dt) {
  double numerator = 0, denominator = 0;
  for (const auto& times : groups) {
    if (times.size() < 2) continue;
    const double origin = times[0] + phase(times, times[0], dt);
    double mean_k = 0, mean_t = 0;
    for (const double t : times) {
      mean_k += std::round((t - origin) / dt);
      mean_t += t - origin;
    }
    mean_k /= static_cast<double>(times.size());
    mean_t /= static_cast<double>(times.size());
    for (const double t : times) {
      const double k = std::round((t - origin) / dt) - mean_k;
      numerator += k * (t - origin - mean_t);
      denominator += k * k;
    }
  }
  return denominator > 0 ? numerator / denominator : dt;
}

// Root-mean-square deviation in frames, every group against its own phase; 1 (hopeless) when two rows fall on one frame.
double jitter(const std::vector<Times>& groups, double dt) {
  double sum = 0;
  std::size_t n = 0;
  for (const auto& times : groups) {
    const double origin = times[0] + phase(times, times[0], dt);
    double last = -1;
    for (std::size_t i = 0; i < times.size(); ++i) {
      const double k = std::round((times[i] - origin) / dt);
      if (i > 0 && k == last && times[i] != times[i - 1]) return 1;
      last = k;
      const double r = (times[i] - origin) / dt - k;
      sum += r * r;
      ++n;
    }
  }
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, n)));
}

// A round number (1/60 for 0.016666667) that explains the times as well: over the whole recording it drifts by no more than their jitter,
// and never by more than a hundredth of a frame.
double rounded_interval(double dt, double span, double jitter_rms) {
  const double frames = std::max(1.0, span / dt), allowed = std::clamp(jitter_rms, 1e-9, 0.01);
  const auto close = [&](double candidate) {
    return candidate > 0 && std::isfinite(candidate) && std::abs(candidate / dt - 1) * frames <= allowed;
  };
  for (const double candidate : {1 / std::round(1 / dt), std::round(dt * 1e6) / 1e6, 1000 / std::round(1000 / dt)})
    if (close(candidate)) return candidate;
  return dt;
}

// time = t0 + dt * frame by least squares.
struct Line {
  double dt = 0, t0 = 0;
  double deviation = 0;  // root mean square, in frames
};

Line fit_line(std::span<const double> time, std::span<const double> frame) {
  const double n = static_cast<double>(time.size());
  double mean_k = 0, mean_t = 0, numerator = 0, denominator = 0, squares = 0;
  for (std::size_t i = 0; i < time.size(); ++i) {
    mean_k += (frame[i] - frame[0]) / n;
    mean_t += (time[i] - time[0]) / n;
  }
  for (std::size_t i = 0; i < time.size(); ++i) {
    const double k = frame[i] - frame[0] - mean_k;
    numerator += k * (time[i] - time[0] - mean_t);
    denominator += k * k;
  }
  Line line;
  if (denominator == 0) return line;
  line.dt = numerator / denominator;
  line.t0 = time[0] + mean_t - line.dt * (frame[0] + mean_k);
  for (std::size_t i = 0; i < time.size(); ++i) {
    const double r = time[i] - line.t0 - line.dt * frame[i];
    squares += r * r;
  }
  line.deviation = std::sqrt(squares / n) / std::abs(line.dt);
  return line;
}

struct Guess {
  double dt, jitter;
};

Guess refine(const std::vector<Times>& groups, const Times& steps, double dt) {
  double sum = 0, count = 0;
  for (const double d : steps) {
    if (d < 0.5 * dt || d > 1.5 * dt) continue;
    sum += d;
    ++count;
  }
  if (count > 0) dt = sum / count;
  double longest = 0;
  for (const auto& group : groups) longest = std::max(longest, group.back() - group.front());
  for (double horizon = 4; horizon * dt < longest; horizon *= 4) dt = refined(pieces(groups, horizon * dt), dt);
  dt = refined(groups, dt);
  return {dt, jitter(groups, dt)};
}

// Share of the steps that are one frame long.
double share_of_single_steps(const Times& steps, double dt) {
  const auto single = std::count_if(steps.begin(), steps.end(), [&](double d) { return std::round(d / dt) == 1; });
  return static_cast<double>(single) / static_cast<double>(steps.size());
}

// The median step and its fractions compete by jitter. A fraction needs steps that are one frame long: times written with two decimals are
// exact multiples of 0.01 s at any frame rate.
Guess best_guess(const std::vector<Times>& groups, const Times& steps) {
  constexpr int most_missed = 8;
  constexpr double least_share = 0.05, clean = 0.01;
  const double middle = lower_median(steps);
  Guess best = refine(groups, steps, middle);
  for (int m = 2; m <= most_missed && best.jitter > clean; ++m) {
    const Guess guess = refine(groups, steps, middle / m);
    if (guess.jitter < best.jitter && share_of_single_steps(steps, guess.dt) >= least_share) best = guess;
  }
  return best;
}

// Numbers the frames of each individual by its own clock phase, so that an individual on the edge between two frames stays on one side.
void number_frames(FrameClock& clock, std::span<const double> time, std::span<const std::size_t> first, double origin) {
  const double offset = std::round(origin / clock.dt);
  clock.frame.resize(time.size());
  for (std::size_t k = 0; k + 1 < first.size(); ++k) {
    const auto times = time.subspan(first[k], first[k + 1] - first[k]);
    double worst = 0;
    for (const double t : times) {
      const double u = (t - origin) / clock.dt;
      worst = std::max(worst, std::abs(u - std::round(u)));
    }
    const double own = worst > 0.25 ? phase(times, origin, clock.dt) : 0;
    for (std::size_t i = 0; i < times.size(); ++i)
      clock.frame[first[k] + i] = static_cast<std::int64_t>(std::round((times[i] - origin - own) / clock.dt) + offset);
  }
  clock.t0 = origin - offset * clock.dt;
}

// The largest deviation. A time of frame 0 that is smaller than it, and small beside a frame, is not known to differ from 0.
void measure_deviation(FrameClock& clock, std::span<const double> time) {
  const auto largest = [&] {
    double out = 0;
    for (std::size_t i = 0; i < time.size(); ++i)
      out = std::max(out, std::abs(time[i] - clock.t0 - static_cast<double>(clock.frame[i]) * clock.dt));
    return out;
  };
  clock.deviation = largest();
  if (clock.t0 == 0 || std::abs(clock.t0) > std::min(clock.deviation + 1e-9 * clock.dt, 0.01 * clock.dt)) return;
  clock.t0 = 0;
  clock.deviation = largest();
}

}  // namespace

bool countable(std::span<const double> time, double dt) {
  constexpr double most = 9e15;
  return std::all_of(time.begin(), time.end(), [&](double t) { return std::abs(t) / dt <= most; });
}

FrameClock fit_frame_clock(std::span<const double> time, std::span<const std::size_t> first) {
  FrameClock clock;
  auto groups = sample(time, first);
  auto steps = differences(groups);
  if (steps.empty()) {  // nobody is seen twice: only the recording as a whole has differences
    groups = {overview(time)};
    steps = differences(groups);
  }
  if (steps.empty()) {
    clock.problem = "all rows have the same time";
    return clock;
  }
  const Guess guess = best_guess(groups, steps);
  if (guess.jitter > kLargestJitter) {
    clock.problem = guess.jitter >= 1
                        ? fmt::format("the times have no constant interval: several rows fall into one step of {:.6g} s", guess.dt)
                        : fmt::format("the times have no constant interval: they deviate from steps of {:.6g} s by {:.2g} steps (rms)",
                                      guess.dt, guess.jitter);
    return clock;
  }
  const Times all = overview(time);
  const double joint = refined({all}, guess.dt);
  const bool one_clock = jitter({all}, joint) <= guess.jitter + 0.01;
  clock.dt = rounded_interval(one_clock ? joint : guess.dt, all.back() - all.front(), guess.jitter);
  if (!countable(time, clock.dt)) {
    clock.problem = fmt::format("times up to {:.6g} s in steps of {:.6g} s are more frames than can be counted", all.back(), clock.dt);
    return clock;
  }
  number_frames(clock, time, first, all[0] + phase(all, all[0], clock.dt));
  measure_deviation(clock, time);
  return clock;
}

FrameClock fit_known_frames(std::span<const double> time, std::span<const double> frame) {
  FrameClock clock;
  for (const double f : frame) clock.frame.push_back(static_cast<std::int64_t>(f));
  const auto [low, high] = std::minmax_element(frame.begin(), frame.end());
  if (*low == *high) {
    clock.problem = "all rows are in one frame";
    return clock;
  }
  Line line = fit_line(time, frame);
  const double rounded = rounded_interval(line.dt, line.dt * (*high - *low), line.deviation);
  line.t0 += (line.dt - rounded) * (*low + *high) / 2;
  clock.dt = rounded;
  clock.t0 = line.t0;
  if (!(line.dt > 0))
    clock.problem = "the time does not grow with the frame number";
  else if (line.deviation > kLargestJitter)
    clock.problem = fmt::format("time and frame number disagree: by {:.2g} frames (rms) at {:.6g} s per frame", line.deviation, line.dt);
  else
    measure_deviation(clock, time);
  return clock;
}

}  // namespace swarmfit
