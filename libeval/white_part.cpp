// SPDX-License-Identifier: MIT
#include "libeval/white_part.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <utility>
#include <vector>

#include "libeval/robust.h"
#include "libtrack/quantile.h"

namespace swarmfit {
namespace {

constexpr std::size_t kLags = 7;
constexpr std::array<double, kLags> kAny = {0, 0, 1, -1, -0.5, 0, 0.5}, kMuch = {1.0 / 27, -4.0 / 27, 5.0 / 27, -2.0 / 27, 0, 0, 0};
constexpr double kWild = 4;  // robust standard deviations

using Stretches = std::vector<std::vector<double>>;

Stretches second_differences(const Tracks& tracks, Index axis) {
  const auto x = tracks.pos().col(axis);
  Stretches out;
  for_each_segment(tracks, static_cast<Index>(kLags) + 2, [&](std::span<const Index> rows) {
    auto& stretch = out.emplace_back();
    for (std::size_t k = 0; k + 2 < rows.size(); ++k) stretch.push_back(x(rows[k]) - 2 * x(rows[k + 1]) + x(rows[k + 2]));
  });
  return out;
}

void tame(Stretches& stretches) {
  std::vector<double> size;
  for (const auto& stretch : stretches)
    for (const double value : stretch) size.push_back(std::abs(value));
  if (size.empty()) return;
  const double most = kWild * kMadToSd * median(std::move(size));
  for (auto& stretch : stretches)
    for (double& value : stretch) value = std::clamp(value, -most, most);
}

struct Autocovariances {
  std::array<double, kLags> at{};
  std::size_t samples = 0;

  double sum(const std::array<double, kLags>& weights) const { return std::inner_product(at.begin(), at.end(), weights.begin(), 0.0); }
  // Variance of such a sum (Bartlett 1946), but for what lags have in common with their negatives.
  double variance(const std::array<double, kLags>& weights) const {
    const auto last = static_cast<std::ptrdiff_t>(kLags) - 1;
    const auto at_lag = [&](std::ptrdiff_t lag) { return std::abs(lag) > last ? 0.0 : at[static_cast<std::size_t>(std::abs(lag))]; };
    double out = 0;
    for (std::ptrdiff_t i = 0; i <= last; ++i)
      for (std::ptrdiff_t j = 0; j <= last; ++j) {
        double common = 0;
        for (std::ptrdiff_t m = -last; m <= last; ++m) common += at_lag(m) * at_lag(m + i - j);
        out += weights[static_cast<std::size_t>(i)] * weights[static_cast<std::size_t>(j)] * common;
      }
    return std::max(0.0, out) / static_cast<double>(samples);
  }
};

Autocovariances autocovariances(const Stretches& stretches) {
  Autocovariances out;
  for (std::size_t lag = 0; lag < kLags; ++lag) {
    double sum = 0;
    std::size_t count = 0;
    for (const auto& stretch : stretches)
      for (std::size_t k = 0; k + lag < stretch.size(); ++k) sum += stretch[k] * stretch[k + lag], ++count;
    if (count > 0) out.at[lag] = sum / static_cast<double>(count);
    if (lag == 0) out.samples = count;
  }
  return out;
}

}  // namespace

WhitePart white_part(const Tracks& tracks) {
  WhitePart out;
  double any = 0, apart = 0, variance = 0;  // in units of the second differences' variance
  for (Index axis = 0; axis < tracks.dims(); ++axis) {
    Stretches stretches = second_differences(tracks, axis);
    tame(stretches);
    const Autocovariances g = autocovariances(stretches);
    const double whole = g.at[0];
    if (!(whole > 0)) continue;
    out.variance[axis] = std::max(0.0, g.sum(kMuch));
    any += g.sum(kAny) / whole;
    apart += (g.sum(kMuch) - g.sum(kAny)) / whole;
    variance += g.variance(kAny) / (whole * whole);
  }
  if (variance > 0) {
    out.significance = any / std::sqrt(variance);
    out.apart = std::abs(apart) / std::sqrt(variance);
  }
  return out;
}

}  // namespace swarmfit
