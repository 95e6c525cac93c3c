// SPDX-License-Identifier: MIT
#include "libeval/independent.h"

#include <algorithm>
#include <cmath>

#include "libeval/energy.h"
#include "libtrack/nan.h"

namespace swarmfit {
namespace {

using Series = std::vector<std::vector<double>>;

Series series_of(const Tracks& tracks, const std::vector<double>& values, const std::vector<Index>& rows, double mean) {
  std::vector<double> at(static_cast<std::size_t>(tracks.rows()), kNaN);
  for (std::size_t k = 0; k < values.size(); ++k) at[static_cast<std::size_t>(rows[k])] = values[k] - mean;
  Series out;
  for_each_segment(tracks, 1, [&](std::span<const Index> run) {
    out.emplace_back();
    for (const Index row : run) out.back().push_back(at[static_cast<std::size_t>(row)]);
  });
  return out;
}

// Mean product of values so many frames apart; 0 where there are none.
double autocovariance(const Series& series, std::size_t lag) {
  double sum = 0, n = 0;
  for (const auto& run : series)
    for (std::size_t k = 0; k + lag < run.size(); ++k)
      if (const double product = run[k] * run[k + lag]; std::isfinite(product)) sum += product, ++n;
  return n > 0 ? sum / n : 0;
}

double effective(const Tracks& tracks, const std::vector<double>& values, const std::vector<Index>& rows) {
  Moments moments;
  for (const double value : values) moments.add(value);
  const auto n = static_cast<double>(values.size());
  const double variance = n > 0 ? moments.m2 / n : 0;
  if (!(variance > 0)) return kNaN;
  const auto most = static_cast<std::size_t>((tracks.frames().back().number - tracks.frames().front().number) / 3);
  return effective_size(series_of(tracks, values, rows, moments.mean), n, variance, most);
}

}  // namespace

double effective_size(const std::vector<std::vector<double>>& runs, double n, double variance, std::size_t longest) {
  double time = -1;  // 1 + 2 (rho_1 + rho_2 + ...) = -1 + 2 (rho_0 + rho_1) + 2 (rho_2 + rho_3) + ...
  for (std::size_t lag = 0; lag <= longest; lag += 2) {
    const double pair = (autocovariance(runs, lag) + autocovariance(runs, lag + 1)) / variance;
    if (pair <= 0) break;
    time += 2 * pair;
  }
  return std::clamp(n / std::max(time, 1.0), 1.0, n);
}

PerColumn<double> independent_samples(const Tracks& tracks, const MetricOptions& options) {
  MetricOptions with_rows = options;
  with_rows.keep_rows = true;
  const MetricSamples samples = metric_samples(tracks, with_rows);
  PerColumn<double> out(samples.columns.size(), kNaN);
  for (std::size_t j = 0; j < out.size(); ++j) out[j] = effective(tracks, samples.values[j], samples.rows[j]);
  return out;
}

}  // namespace swarmfit
