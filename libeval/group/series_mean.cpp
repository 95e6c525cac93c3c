// SPDX-License-Identifier: MIT
#include "libeval/group/series_mean.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "libeval/independent.h"
#include "libtrack/distributions.h"
#include "libtrack/nan.h"

namespace swarmfit {
namespace {

constexpr double kMostBlocks = 20, kFewestBlocks = 4;
constexpr double kTimesPerBlock = 2;
constexpr double kSame = 1e-12;  // standard deviations, relative to the mean, that are rounding

// Runs of neighbouring frames, about the mean; NaN for what is undefined.
std::vector<std::vector<double>> runs_of(std::span<const std::int64_t> frame, std::span<const double> values, double mean) {
  std::vector<std::vector<double>> runs;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (k == 0 || frame[k] != frame[k - 1] + 1) runs.emplace_back();
    runs.back().push_back(values[k] - mean);
  }
  return runs;
}

void add_interval(std::span<const std::int64_t> frame, std::span<const double> values, SeriesMean& out) {
  const auto n = static_cast<double>(out.count);
  const double blocks = std::min(kMostBlocks, std::floor(n / (kTimesPerBlock * out.correlation_time)));
  if (!(blocks >= kFewestBlocks)) return;
  const auto count = static_cast<std::size_t>(blocks);
  std::vector<double> sum(count, 0), number(count, 0);
  const auto length = static_cast<double>(frame.back() - frame.front() + 1);
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!std::isfinite(values[k])) continue;
    const auto block = static_cast<std::size_t>(static_cast<double>(frame[k] - frame.front()) * blocks / length);
    sum[block] += values[k], ++number[block];
  }
  double squares = 0, filled = 0;
  for (std::size_t b = 0; b < count; ++b) {
    if (number[b] == 0) continue;
    const double off = sum[b] / number[b] - out.mean;
    squares += off * off, ++filled;
  }
  if (filled < kFewestBlocks) return;
  const double half = student_t_above(0.025, filled - 1) * std::sqrt(squares / (filled - 1) / filled);
  out.lower = out.mean - half, out.upper = out.mean + half;
  out.blocks = static_cast<std::size_t>(filled);
}

}  // namespace

SeriesMean series_mean(std::span<const std::int64_t> frame, std::span<const double> values) {
  SeriesMean out{kNaN, kNaN, 0, kNaN, kNaN, kNaN, 0};
  double sum = 0, squares = 0;
  for (const double x : values)
    if (std::isfinite(x)) sum += x, ++out.count;
  if (out.count == 0) return out;
  const auto n = static_cast<double>(out.count);
  out.mean = sum / n;
  for (const double x : values)
    if (std::isfinite(x)) squares += (x - out.mean) * (x - out.mean);
  out.sd = std::sqrt(squares / n);
  if (!(out.sd > kSame * std::abs(out.mean))) return out;
  const auto longest = static_cast<std::size_t>((frame.back() - frame.front()) / 3);
  out.correlation_time = n / effective_size(runs_of(frame, values, out.mean), n, out.sd * out.sd, longest);
  add_interval(frame, values, out);
  return out;
}

}  // namespace swarmfit
