// SPDX-License-Identifier: MIT
#include "libeval/localisation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "libeval/rounding.h"
#include "libeval/white_part.h"
#include "libtrack/nan.h"
#include "libtrack/normals.h"
#include "libtrack/quantile.h"

namespace swarmfit {
namespace {

constexpr double kNormalQuartile = 0.6744897501960817;  // median |z| of a standard normal
constexpr int kLowest = 2, kHighest = 8;                // orders of difference looked at
constexpr double kVisible = 0.1;                        // of a standard deviation: a bin of the standard histograms
constexpr Index kFewest = 100;                          // differences that a level must rest on
constexpr double kLevelled = 0.9;  // next order's level over this one's; motion slower than 1/6 of the frame rate then adds less than 5 %
constexpr double kFlat = 1.6;      // largest ratio of levels within the upper third of the spectrum (white: 1, rough acceleration: 2.7)
constexpr double kDigit = 1.5;     // times the rounding error of the last digit
constexpr double kSlow = 3;        // errors per step: along faster motion they show in the speed as they are
constexpr double kSignificant = 3.5;  // standard errors
constexpr double kConsistent = 3;     // likewise
constexpr double kStraight = 0.5;     // of the error's variance that speeds must show at least

// Taps of (1 - B)^differences (1 + B)^sums, B being the step back by one frame.
std::vector<double> taps(int differences, int sums) {
  std::vector<double> c{1};
  for (int k = 0; k < differences + sums; ++k) {
    const double sign = k < differences ? -1 : 1;
    c.push_back(0);
    for (std::size_t i = c.size() - 1; i > 0; --i) c[i] += sign * c[i - 1];
  }
  return c;
}

// What variance per frame white error must have to explain the filtered positions.
struct Level {
  double variance = 0;
  Index samples = 0;
};

std::vector<double> filtered(const Tracks& tracks, Index axis, const std::vector<double>& c) {
  const auto x = tracks.pos().col(axis);
  std::vector<double> out, path;
  for_each_segment(tracks, static_cast<Index>(c.size()), [&](std::span<const Index> rows) {
    path.clear();
    for (const Index row : rows) path.push_back(x(row));
    for (std::size_t k = 0; k + c.size() <= rows.size(); ++k) {
      double sum = 0;
      for (std::size_t i = 0; i < c.size(); ++i) sum += c[i] * path[k + i];
      out.push_back(sum);
    }
  });
  return out;
}

Level level(const Tracks& tracks, Index axis, int differences, int sums = 0) {
  const auto c = taps(differences, sums);
  std::vector<double> size = filtered(tracks, axis, c);
  if (static_cast<Index>(size.size()) < kFewest) return {};
  for (double& value : size) value = std::abs(value);
  const auto middle = size.begin() + static_cast<std::ptrdiff_t>(size.size() / 2);
  std::nth_element(size.begin(), middle, size.end());
  double norm = 0;
  for (const double tap : c) norm += tap * tap;
  const double sd = *middle / kNormalQuartile;
  return {sd * sd / norm, static_cast<Index>(size.size())};
}

// Filters with most of their response at 0.5, 0.38 and 0.33 cycles per frame: white error has the same level through each.
bool flat_spectrum(const Tracks& tracks, Index axis) {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (int sums = 0; sums <= 2; ++sums) {
    const Level band = level(tracks, axis, 6, sums);
    if (band.samples == 0) return false;
    low = std::min(low, band.variance);
    high = std::max(high, band.variance);
  }
  return high <= kFlat * low;
}

// What a red spectrum does to the levels: it raises those that see lower frequencies, and lets levels fall on with the order. 0 for white
// error; `of_walk` for a random walk, whose steps are the animal's own. From the order on at which motion leaves next to nothing.
struct Tilt {
  double seen = 0, of_walk = 0;
};
Tilt tilt(const Tracks& tracks, Index axis, int order) {
  // A random walk's differences of order m are white noise's of order m - 1, so its level is C(2m - 2, m - 1) / C(2m, m).
  const auto walk = [](double m) { return m / (2 * (2 * m - 1)); };
  const Level high = level(tracks, axis, 6), low = level(tracks, axis, 6, 2);
  const Level early = level(tracks, axis, order), late = level(tracks, axis, kHighest);
  return {std::log(low.variance / high.variance) + 2 * std::log(early.variance / late.variance),
          std::log(4.0 / 3) + 2 * std::log(walk(order) / walk(kHighest))};
}

struct AxisError {
  Level error;
  double acceleration, jerk;  // levels of the second and third differences
  Tilt tilt;
  bool white, rounding;
};

// The level that speeds have, from one frame to the next, at one order less: white error along the way shows in them as it does in
// positions, and somebody who flies at a constant speed on a rough path has none. Infinite where steps are hardly longer than errors:
// speeds then say less.
double level_of_speeds(const Tracks& tracks, double error) {
  constexpr int order = 6;
  const auto c = taps(order - 1, 0);
  std::vector<double> size, steps;
  for_each_segment(tracks, order + 1, [&](std::span<const Index> rows) {
    const std::size_t first = steps.size();
    for (std::size_t k = 0; k + 1 < rows.size(); ++k)
      steps.push_back(std::sqrt((tracks.pos().row(rows[k + 1]) - tracks.pos().row(rows[k])).square().sum()));
    for (std::size_t k = first; k + c.size() <= steps.size(); ++k) {
      double sum = 0;
      for (std::size_t i = 0; i < c.size(); ++i) sum += c[i] * steps[k + i];
      size.push_back(std::abs(sum));
    }
  });
  if (static_cast<Index>(size.size()) < kFewest || quantile(steps, 0.5) < kSlow * std::sqrt(error)) return INFINITY;
  double norm = 0;
  for (const double tap : taps(order, 0)) norm += tap * tap;
  const double sd = quantile(std::move(size), 0.5) / kNormalQuartile;
  return sd * sd / norm;
}

std::optional<AxisError> axis_error(const Tracks& tracks, Index axis, double grid) {
  Level now = level(tracks, axis, kLowest);
  const Level jerk = level(tracks, axis, 3);
  if (now.samples == 0 || jerk.samples == 0) return std::nullopt;
  AxisError out{now, now.variance, jerk.variance, {}, false, false};
  bool levelled = false;
  int order = kLowest;
  while (order < kHighest && !levelled) {
    ++order;
    const Level next = level(tracks, axis, order);
    if (next.samples == 0) break;
    levelled = next.variance >= kLevelled * now.variance;
    now = next;
  }
  out.error = now;
  const double rounding = grid * grid / 12;
  out.rounding = now.variance < kDigit * kDigit * rounding;
  out.white = levelled && flat_spectrum(tracks, axis);
  out.tilt = tilt(tracks, axis, order);
  // Rounding is white, too, and simulated by itself.
  if (!out.rounding) out.error.variance -= rounding;
  return out;
}

double squared_iqr(const std::vector<double>& values) {
  const double range = quantile(values, 0.75) - quantile(values, 0.25);
  return range * range;
}

// The standard deviation that a normal distribution with these percentiles has: counts what happens in a few cases of a hundred, but not
// what happens in a few of a thousand.
double deviation(const std::vector<double>& values) {
  constexpr double kNormal = 2 * 2.3263478740408408;  // its 1 % to 99 % range
  return (quantile(values, 0.99) - quantile(values, 0.01)) / kNormal;
}

double share(double part, double whole) { return whole > 0 ? std::clamp(part / whole, 0.0, 1.0) : 0; }

}  // namespace

Localisation estimate_localisation(const Tracks& tracks) {
  Localisation out;
  double error = 0, acceleration = 0, jerk = 0, least = INFINITY;
  Tilt tilt;
  int axes = 0, white = 0, rounding = 0;
  const Grid grid = rounding_grid(tracks);
  for (Index axis = 0; axis < tracks.dims(); ++axis) {
    const auto found = axis_error(tracks, axis, grid.step[axis]);
    if (!found) continue;
    out.sigma[axis] = std::sqrt(found->error.variance);
    out.samples += found->error.samples;
    error += found->error.variance;
    acceleration += found->acceleration;
    jerk += found->jerk;
    tilt.seen += found->tilt.seen;
    tilt.of_walk += found->tilt.of_walk;
    least = std::min(least, found->error.variance);
    ++axes;
    white += found->white;
    rounding += found->rounding;
  }
  out.rounding = axes > 0 && rounding == axes;
  const bool told_from_walk = tilt.seen < 0.5 * tilt.of_walk;  // nearer to the one than to the other
  const auto in_speeds = [&] { return level_of_speeds(tracks, least) >= kStraight * least; };
  out.white = axes > 0 && white == axes && !out.rounding && told_from_walk && in_speeds();
  if (axes > 0 && !out.white && !out.rounding) {
    const WhitePart part = white_part(tracks);
    Eigen::Array3d variance = part.variance - grid.step.square() / 12;
    least = variance.head(tracks.dims()).minCoeff();
    if (part.significance > kSignificant && part.apart < kConsistent && least > 0 && in_speeds()) {
      out.white = true;
      out.sigma = variance.max(0.0).sqrt();
      error = variance.head(tracks.dims()).sum();
    }
  }
  out.acceleration_share = share(error, acceleration);
  out.jerk_share = share(error, jerk);
  return out;
}

Tracks with_error(const Tracks& tracks, const Eigen::Array3d& sigma, std::uint64_t seed) {
  if (tracks.rows() == 0) return tracks;
  const Rng rng{seed};
  TrackColumns c = tracks.columns();
  c.vel = c.acc = Rows(0, 3);
  for (Index row = 0; row < tracks.rows(); ++row) {
    const auto k = static_cast<std::size_t>(row);
    const auto tick = static_cast<std::uint64_t>(c.frame[k]) & 0xFFFFFFFFFFFFu;
    const Eigen::Array3d normal = three_normals(rng, Stream::localisation, tick, c.track[k]);
    for (Index axis = 0; axis < tracks.dims(); ++axis) c.pos(row, axis) += sigma[axis] * normal[axis];
  }
  return Tracks(std::move(c), tracks.meta());
}

PerColumn<double> error_share(const Tracks& tracks, const Eigen::Array3d& sigma, std::uint64_t seed, const std::vector<int>& lags) {
  const MetricOptions options{VelocitySource::difference, lags};
  const MetricSamples once = metric_samples(tracks, options), twice = metric_samples(with_error(tracks, sigma, seed), options);
  PerColumn<double> out(once.columns.size());
  for (std::size_t m = 0; m < out.size(); ++m) {
    const double before = squared_iqr(once.values[m]), after = squared_iqr(twice.values[m]);
    const bool defined = before > 0 && std::isfinite(after);
    const bool visible = std::sqrt(after) >= kVisible * deviation(once.values[m]);
    out[m] = !defined ? kNaN : visible ? std::clamp(after / before - 1, 0.0, 1.0) : 0;
  }
  return out;
}

}  // namespace swarmfit
