// SPDX-License-Identifier: MIT
#include "libeval/rounding.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "libtrack/quantile.h"
#include "libtrack/rng.h"

namespace swarmfit {
namespace {

constexpr int kMostDecimals = 9;
constexpr double kNearlyAll = 0.95;      // the rest may have been filled in
constexpr std::size_t kEnough = 20;      // steps along an axis: chance makes a few values multiples of anything
constexpr double kWhole = 1e-6;          // a number this near to a whole one is one, but for the rounding of doubles
constexpr double kMostCells = 1e6;       // between the outermost positions: gaps of a finer grid cannot be counted
constexpr double kNormalShare = 0.6827;  // of a normal law within one standard deviation

bool whole(double x) { return std::abs(x - std::round(x)) < kWhole; }

// How many decimals a number is written with; kMostDecimals + 1: more than can be told.
int decimals(double x) {
  double power = 1;
  for (int k = 0; k <= kMostDecimals; ++k, power *= 10)
    if (whole(x * power)) return k;
  return kMostDecimals + 1;
}

// Of the numbers with no more decimals than nearly all have, the greatest common divisor of their distances; 0 if they have too many.
double decimal_step(const std::vector<double>& values) {
  std::vector<int> count;
  for (const double x : values) count.push_back(decimals(x));
  const auto most = count.begin() + static_cast<std::ptrdiff_t>(kNearlyAll * static_cast<double>(count.size()));
  std::nth_element(count.begin(), most, count.end());
  if (*most > kMostDecimals) return 0;
  const double power = std::pow(10.0, *most);
  std::int64_t divisor = 0, first = 0;
  bool any = false;
  for (const double x : values) {
    if (!whole(x * power) || !(std::abs(x) * power < 1e15)) continue;
    const auto number = static_cast<std::int64_t>(std::llround(x * power));
    if (!any) first = number;
    any = true;
    divisor = std::gcd(divisor, number - first);
  }
  return static_cast<double>(divisor) / power;
}

// The smallest gap between two values, if every other is a multiple of it.
double gap_step(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const double range = values.back() - values.front(), least = range / kMostCells;
  double step = INFINITY;
  for (std::size_t k = 1; k < values.size(); ++k)
    if (const double gap = values[k] - values[k - 1]; gap > least) step = std::min(step, gap);
  if (!std::isfinite(step)) return 0;
  constexpr double tolerance = 0.02;
  for (std::size_t k = 1; k < values.size(); ++k)
    if (const double cells = (values[k] - values[k - 1]) / step; std::abs(cells - std::round(cells)) > tolerance) return 0;
  // The step, as exactly as the whole range tells it.
  return range / std::round(range / step);
}

// Do individuals move along this axis, and not all by the same from frame to frame? Coordinates of those who rest, or keep their speed, lie
// on grids of their own.
bool moves(const Tracks& tracks, Index axis) {
  std::vector<double> steps;
  for (Index row = 0; row < tracks.rows(); ++row)
    if (const Index next = tracks.next()[static_cast<std::size_t>(row)]; next >= 0)
      if (const double step = tracks.pos()(next, axis) - tracks.pos()(row, axis); step != 0) steps.push_back(step);
  if (steps.size() < kEnough) return false;
  std::sort(steps.begin(), steps.end());
  const double same = kWhole * std::max(std::abs(steps.front()), std::abs(steps.back()));
  std::size_t kinds = 1;
  for (std::size_t k = 1; k < steps.size(); ++k) kinds += steps[k] - steps[k - 1] > same;
  return kinds > 1;
}

Tracks dithered(const Tracks& tracks, const Grid& grid) {
  constexpr Rng rng{1};
  TrackColumns c = tracks.columns();
  c.vel = c.acc = Rows(0, 3);
  for (Index row = 0; row < tracks.rows(); ++row) {
    const auto tick = static_cast<std::uint64_t>(row);
    const auto u = rng.uniform2(Stream::dither, tick, 0, 0);
    const double within[] = {u[0], u[1], rng.uniform(Stream::dither, tick, 0, 1)};
    for (Index axis = 0; axis < tracks.dims(); ++axis) c.pos(row, axis) += grid.step[axis] * (within[axis] - 0.5);
  }
  return Tracks(std::move(c), tracks.meta());
}

// Of the differences between values that belong to the same rows, what would be the standard deviation of a normal law with their bulk.
double change(const std::vector<double>& a, const std::vector<Index>& rows_a, const std::vector<double>& b,
              const std::vector<Index>& rows_b) {
  std::vector<double> apart;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (rows_a[i] == rows_b[j])
      apart.push_back(std::abs(a[i++] - b[j++]));
    else if (rows_a[i] < rows_b[j])
      ++i;
    else
      ++j;
  }
  return apart.empty() ? 0 : quantile(std::move(apart), kNormalShare);
}

}  // namespace

Eigen::Array3d Grid::rounded(const Eigen::Array3d& position) const {
  Eigen::Array3d out = position;
  for (Index axis = 0; axis < 3; ++axis)
    if (step[axis] > 0) out[axis] = origin[axis] + step[axis] * std::round((position[axis] - origin[axis]) / step[axis]);
  return out;
}

Grid rounding_grid(const Tracks& tracks) {
  Grid grid;
  for (Index axis = 0; axis < tracks.dims(); ++axis) {
    if (!moves(tracks, axis)) continue;
    const auto column = tracks.pos().col(axis);
    const std::vector<double> values(column.begin(), column.end());
    grid.step[axis] = decimal_step(values);
    if (grid.step[axis] == 0) grid.step[axis] = gap_step(values);
    if (grid.step[axis] > 0) grid.origin[axis] = values.front();
  }
  return grid;
}

MetricSamples recorded_samples(const Tracks& recording, const MetricOptions& options) {
  const Grid grid = rounding_grid(recording);
  MetricOptions with_rows = options;
  with_rows.keep_rows = true;
  MetricSamples samples = metric_samples(recording, grid.any() ? with_rows : options);
  if (!grid.any() || options.velocity == VelocitySource::recorded) return samples;
  const MetricSamples moved = metric_samples(dithered(recording, grid), with_rows);
  for (std::size_t m = 0; m < samples.columns.size(); ++m) {
    samples.rounding[m] = change(samples.values[m], samples.rows[m], moved.values[m], moved.rows[m]);
    if (!options.keep_rows) samples.rows[m].clear();
  }
  return samples;
}

}  // namespace swarmfit
